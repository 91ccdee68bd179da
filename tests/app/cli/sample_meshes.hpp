/// A small mesh whose values are known, for the tests of sampling.
#pragma once

#include <string>

#include "process.hpp"

namespace barycert::cli_test {

/// Five nodes, two cells that share the face 1 2 3 in the plane x + y + z = 1. attribute0 of nodes is
/// 1 + 2x + 4y + 8z, that of cells 7 and 9.
inline std::string put_two_cells(const Scratch& scratch, const std::string& stem = "two") {
    scratch.put(stem + ".node", "5 3 1 0\n0 0 0 0 1\n1 1 0 0 3\n2 0 1 0 5\n3 0 0 1 9\n4 1 1 1 15\n");
    scratch.put(stem + ".ele", "2 4 1\n0 0 1 2 3 7\n1 1 2 3 4 9\n");
    return scratch.path(stem);
}

/// In the cell 0, in the cell 1, on the face, on an edge of it, at a vertex of it, outside.
inline const std::string six_points = "x,y,z\n.25,.25,.25\n.5,.5,.5\n.25,.25,.5\n.5,.5,0\n1,0,0\n2,2,2\n";

/// The rows of these for attribute0.
inline const std::string six_rows =
    "x,y,z,cell,feature,attribute0\n0.25,0.25,0.25,0,interior,4.5\n0.5,0.5,0.5,1,interior,8\n"
    "0.25,0.25,0.5,0,face,6.5\n0.5,0.5,0,0,edge,4\n1,0,0,0,vertex,3\n2,2,2,-1,outside,nan\n";

inline Words plus(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Exit code 2, nothing on stdout, and that said.
inline void expect_error(const Words& arguments, const std::string& says, const How& how = {}) {
    const Ended r = run(arguments, how);
    EXPECT_EQ(r.code, 2) << ::testing::PrintToString(arguments) << r.err;
    EXPECT_EQ(r.out, "") << ::testing::PrintToString(arguments);
    EXPECT_TRUE(contains(r.err, says)) << ::testing::PrintToString(arguments) << " says " << r.err;
}

}  // namespace barycert::cli_test
