// The theorem of check.hpp, both ways: certified exactly where the judge finds a simplicial complex.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "tests/mesh/check/judge.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/random_complexes.hpp"

namespace barycert::testing {
namespace {

std::string defect_text(const Mesh& mesh) {
    std::string text = "points";
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        text += (i % static_cast<std::size_t>(mesh.dimension) == 0 ? " | " : " ");
        char number[40];
        std::snprintf(number, sizeof number, "%.17g", mesh.points[i]);
        text += number;
    }
    text += "\ncells";
    for (std::size_t i = 0; i < mesh.cells.size(); ++i)
        text += (i % mesh.corners() == 0 ? " | " : " ") + std::to_string(mesh.cells[i]);
    return text;
}

struct Tally {
    std::uint64_t meshes = 0, certified = 0;
    std::map<std::string, std::uint64_t> problems;
};

/// The verdict, the pairs that overlap, the cells that are flat: as the judge has them.
void compare(const Mesh& mesh, Tally& tally) {
    const Judgement j = judge(mesh);
    const CheckReport report = quick(mesh);
    ASSERT_EQ(report.certified(), j.complex) << words(found(report)) << "\n" << defect_text(mesh);
    ASSERT_EQ(report.degenerate, j.degenerate) << defect_text(mesh);
    const Defect* const overlaps = report.find(DefectKind::overlapping_cells);
    ASSERT_EQ(overlaps == nullptr ? 0 : overlaps->count, j.overlaps.size()) << words(found(report)) << "\n"
                                                                            << defect_text(mesh);
    for (std::size_t i = 0; overlaps != nullptr && i < overlaps->places.size(); ++i)
        ASSERT_EQ(overlaps->places[i].cells, j.overlaps[i]) << defect_text(mesh);
    ASSERT_TRUE(!j.complex || report.volume.equal) << defect_text(mesh);
    ++tally.meshes;
    tally.certified += j.complex ? 1 : 0;
    for (const Defect& f : report.defects) ++tally.problems[std::string(defect_text(f.kind).name)];
}

using Recipe = Mesh (*)(int, base::Random&);

Tally compare_many(const char* name, Recipe recipe, std::uint64_t count, bool nudged) {
    Tally tally;
    for (const int d : {2, 3}) {
        for (std::uint64_t i = 0; i < count && !::testing::Test::HasFatalFailure(); ++i) {
            base::Random random = base::Random::stream(11, base::hash64(name) + static_cast<std::uint64_t>(d), i);
            Mesh mesh = recipe(d, random);
            for (double& x : mesh.points) {
                if (!nudged || random.below(3) != 0) continue;
                x = std::nextafter(x, random.coin() ? 10 : -10);
            }
            compare(mesh, tally);
        }
    }
    ::testing::Test::RecordProperty("certified",
                                    std::to_string(tally.certified) + " of " + std::to_string(tally.meshes));
    return tally;
}

/// The share is asserted so that the comparison cannot become one of bad meshes, or good ones, alone.
void expect_share(const Tally& tally, double min, double max) {
    const double share = static_cast<double>(tally.certified) / static_cast<double>(tally.meshes);
    EXPECT_GT(share, min);
    EXPECT_LT(share, max);
}

TEST(Theorem, Soups) {
    const Tally tally = compare_many("soup", random_soup, 25000, false);
    expect_share(tally, 0.1, 0.5);
    for (const DefectKind p : {DefectKind::degenerate_cell, DefectKind::duplicate_cell, DefectKind::overfull_facet,
                               DefectKind::same_side, DefectKind::open_boundary, DefectKind::boundary_contact,
                               DefectKind::nested_part, DefectKind::overlapping_cells}) {
        EXPECT_GT(tally.problems.count(std::string(defect_text(p).name)), 0U) << defect_text(p).name;
    }
}

TEST(Theorem, GrownComplexes) {
    expect_share(compare_many("grown", grown_complex, 12500, false), 0.5, 0.9);
}

TEST(Theorem, DamagedBoxes) {
    expect_share(compare_many("damaged", damaged_box, 15000, false), 0.2, 0.8);
}

TEST(Theorem, OneUlpOff) {
    expect_share(compare_many("soup ulp", random_soup, 150, true), 0.05, 0.8);
    expect_share(compare_many("grown ulp", grown_complex, 80, true), 0.05, 0.9);
    expect_share(compare_many("damaged ulp", damaged_box, 25, true), 0.05, 0.9);
}

}  // namespace
}  // namespace barycert::testing
