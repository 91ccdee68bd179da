// verdict_only: the same verdict, and no search once it is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/check/meshes.hpp"
#include "tests/check/random_complexes.hpp"

namespace barycert::testing {
namespace {

struct Asked {
    CheckReport report;
    std::vector<std::string> stages;
};

Asked verdict_of(const Mesh& mesh) {
    Asked asked;
    asked.report = check_mesh(
        mesh, {.threads = 1, .examples = 0, .contacts = 0, .verdict_only = true, .progress = [&](const char* stage) {
                   asked.stages.emplace_back(stage);
               }});
    return asked;
}

TEST(VerdictOnly, IsTheVerdict) {
    std::size_t certified = 0, broken = 0;
    for (const int d : {2, 3}) {
        for (std::uint64_t i = 0; i < 600; ++i) {
            base::Random random = base::Random::stream(34, static_cast<std::uint64_t>(d), i);
            Mesh mesh = i % 3 == 0 ? random_soup(d, random) : damaged_box(d, random);
            if (i % 3 == 2) mesh = box(d, {1 + static_cast<int>(random.below(3)), 2, 1});
            const CheckReport whole = quick(mesh), verdict = verdict_of(mesh).report;
            ASSERT_EQ(verdict.certificate.verdict(), whole.certificate.verdict());
            ASSERT_EQ(verdict.measures.orientation, whole.measures.orientation);
            EXPECT_TRUE(verdict.measures.condition.empty() && verdict.contacts.empty());
            for (const Defect& f : verdict.defects) EXPECT_NE(whole.find(f.kind), nullptr);
            ++(whole.certified() ? certified : broken);
        }
    }
    EXPECT_GT(certified, 300U);
    EXPECT_GT(broken, 300U);
}

// A mesh with nodes snapped to a coarse lattice has degenerate cells: they are proof enough.
TEST(VerdictOnly, StopsAtTheFirstProof) {
    Mesh mesh = read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/torus")).value();
    double max = 0;
    for (const double x : mesh.points) max = std::max(max, std::abs(x));
    for (double& x : mesh.points) x = std::round(x * 8 / max);
    const Asked degenerate = verdict_of(mesh);
    EXPECT_NE(degenerate.report.find(DefectKind::degenerate_cell), nullptr);
    EXPECT_EQ(degenerate.stages.back(), "cells");

    // Cells upon each other: facets do not tell, contacts of the boundary do.
    const Asked twice = verdict_of(joined(box(3, {4, 4, 4}), mapped(box(3, {4, 4, 4}), {1, 1, 1}, {0.5, 0.25, 0.125})));
    EXPECT_NE(twice.report.find(DefectKind::boundary_contact), nullptr);
    EXPECT_LE(twice.report.find(DefectKind::boundary_contact)->count, 1U);
    EXPECT_EQ(twice.stages.back(), "contacts of the boundary");
    EXPECT_EQ(std::count(twice.stages.begin(), twice.stages.end(), "overlapping cells"), 0);
}

}  // namespace
}  // namespace barycert::testing
