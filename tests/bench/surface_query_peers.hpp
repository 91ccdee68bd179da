/// Other libraries' answers for points and a surface of triangles. Each answers all points, on one thread.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "barycert/surface.hpp"

namespace barycert::bench {

/// A way to answer: of each point a number, which is a triangle, or 1 inside and 0 outside; and the distance, if it is
/// asked for.
struct QueryPeer {
    std::string name;
    std::function<void(const std::vector<double>& points, std::vector<std::int64_t>& answers,
                       std::vector<double>& distances)>
        run;
};

struct QueryPeers {
    std::vector<QueryPeer> nearest, inside;
    std::function<std::size_t()> self_intersections = {};  ///< pairs
};

QueryPeers cgal_peers(const Surface& surface);
QueryPeers vtk_peers(const Surface& surface);
QueryPeers embree_peers(const Surface& surface);

}  // namespace barycert::bench
