// CGAL's exact kernel as an oracle: bit by bit what the integers say, in every family.

#include <gtest/gtest.h>

#include <cmath>

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/series.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/threshold.hpp"
#include "barycert/vtk_files.hpp"
#include "barycert/witness.hpp"

namespace barycert {
namespace {

const MeshSource& two_meshes() {
    static const MeshSource source = [] {
        MeshSource s;
        for (const char* name : {"bracket", "plate"})
            s.add(name, read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/") + name).value());
        return s;
    }();
    return source;
}

TEST(Epeck, SaysWhatTheIntegersSayInEveryFamily) {
    std::array<std::uint64_t, 4> regions{};
    for (const Family& family : all_families()) {
        for (const Simplex s : family.simplices) {
            if (family.needs_mesh && !two_meshes().supplies(s)) continue;
            for (std::uint64_t i = 0; i < 60; ++i) {
                const Case c = make_case(family, s, 11, i, two_meshes());
                const OracleAnswer integers = ask_oracle(c), cgal = ask_cgal(c);
                ++regions[static_cast<std::size_t>(cgal.region)];
                EXPECT_TRUE(same_answer(integers, cgal))
                    << family.name << ' ' << name(s) << ' ' << i << ": " << name(integers.region) << ' '
                    << name(cgal.region) << ", value " << integers.value << ' ' << cgal.value;
            }
        }
    }
    for (const std::uint64_t n : regions) EXPECT_GT(n, 100U);
}

/// A segment along x of that length from 0, a point at x, and values.
Case on_axis(double length, double x, double f0, double f1) {
    Case c;
    c.simplex = Simplex::segment;
    c.vertices[3] = length;
    c.point[0] = x;
    c.values = {f0, f1, 0, 0};
    return c;
}

TEST(Epeck, RoundsToNearestEvenAlsoWhereNumbersUnderflowOrOverflow) {
    // 1/2 of the smallest subnormal, 3/2 of it, a little more than 1/2 of it.
    EXPECT_EQ(ask_cgal(on_axis(2, 1, 0, 0x1p-1074)).value, 0);
    EXPECT_EQ(ask_cgal(on_axis(4, 3, 0, 0x1p-1073)).value, 0x1p-1073);
    EXPECT_EQ(ask_cgal(on_axis(2, 1 + 0x1p-52, 0, 0x1p-1074)).value, 0x1p-1074);
    // A subnormal that rounding to 53 bits first would get wrong: a tie there, and more than one in truth.
    EXPECT_EQ(ask_cgal(on_axis(2, 1 + 0x1p-30, 0, 0x1p-1022 * (1 + 0x1p-24 + 0x1p-52))).value,
              0x1p-1023 + 0x1p-1053 + 0x1p-1047 + 0x1p-1074);
    // -1/4 of it is -0, as the integers round.
    const double zero = ask_cgal(on_axis(4, 1, 0, -0x1p-1074)).value;
    EXPECT_EQ(zero, 0);
    EXPECT_TRUE(std::signbit(zero));
    EXPECT_EQ(ask_cgal(on_axis(1, 0x1p1023, 0, 4)).value, HUGE_VAL);
    EXPECT_EQ(ask_cgal(on_axis(0x1p-1074, 0x1p1023, 0, 0)).weights[1], HUGE_VAL);
    // Ties to even at 53 bits.
    EXPECT_EQ(ask_cgal(on_axis(2, 1, 1, 1 + 0x1p-52)).value, 1);
    EXPECT_EQ(ask_cgal(on_axis(2, 1, 1 + 0x1p-52, 1 + 0x1p-51)).value, 1 + 0x1p-51);
}

TEST(Epeck, SameAnswerSeesEveryDifference) {
    const Case c = on_axis(4, 1, 0, 1);
    const OracleAnswer a = ask_oracle(c);
    EXPECT_TRUE(same_answer(a, ask_cgal(c)));
    OracleAnswer b = a;
    b.value = std::nextafter(b.value, 2);
    EXPECT_FALSE(same_answer(a, b));
    b = a;
    b.signs[1] = 0;
    EXPECT_FALSE(same_answer(a, b));
    b = a;
    b.weights[3] = -0.0;
    EXPECT_FALSE(same_answer(a, b));
    b = a;
    b.region = Region::boundary;
    EXPECT_FALSE(same_answer(a, b));
}

}  // namespace
}  // namespace barycert
