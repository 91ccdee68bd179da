// Defects planted into good meshes at random places are found and named, alone and in pairs.
#include <gtest/gtest.h>

#include "tests/mesh/check/defects.hpp"
#include "tests/mesh/check/judge.hpp"

namespace barycert::testing {
namespace {

// Defects that follow where another defect changes, adds or takes away cells: the mesh's own neighbours and faces are
// wrong then.
constexpr DefectSet follows = set_of(DefectKind::wrong_neighbour, DefectKind::wrong_face);

void expect_named(const Mesh& mesh, DefectSet must, DefectSet may, bool good) {
    const CheckReport r = quick(mesh);
    const DefectSet all = found(r);
    // Nodes that hang are looked for at the facets that meet, and that search ends after so many.
    const Defect* const contacts = r.find(DefectKind::boundary_contact);
    const bool cut = contacts != nullptr && contacts->at_least;
    EXPECT_EQ(words(must & ~all & ~(cut ? set_of(DefectKind::hanging_node) : 0)), "nothing")
        << "was not found; found: " << words(all);
    EXPECT_EQ(words(all & ~(must | may)), "nothing") << "was found besides";
    EXPECT_EQ(r.certified(), good);
    EXPECT_EQ(r.certificate.covers(mesh), good);
}

TEST(Defects, None) {
    for (const int d : {2, 3}) expect_named(mesh_of_sites(d, 2), 0, 0, true);
}

TEST(Defects, Alone) {
    for (const int d : {2, 3}) {
        for (const PlantedDefect& defect : defects) {
            if (defect.only_3d && d == 2) continue;
            for (std::uint64_t i = 0; i < 15; ++i) {
                SCOPED_TRACE(std::string(defect.name) + ", " + std::to_string(d) + "D, " + std::to_string(i));
                base::Random random = base::Random::stream(5, base::hash64(defect.name), i);
                Mesh mesh = mesh_of_sites(d, 1);
                const bool p5 = (defect.must & follows) != 0;
                if (!p5) mesh.neighbours.clear(), mesh.faces.clear();
                const Site site = site_of(mesh, 1, 0);
                defect.plant(site, random);
                expect_named(mesh, defect.must, defect.may, harmless(defect));
            }
        }
    }
}

TEST(Defects, InPairs) {
    for (const int d : {2, 3}) {
        for (const PlantedDefect& a : defects) {
            for (const PlantedDefect& b : defects) {
                if ((a.only_3d || b.only_3d) && d == 2) continue;
                SCOPED_TRACE(std::string(a.name) + " and " + b.name + ", " + std::to_string(d) + "D");
                base::Random random = base::Random::stream(6, base::hash64(a.name), base::hash64(b.name));
                Mesh mesh = mesh_of_sites(d, 2);
                const Site at = site_of(mesh, 2, 0), other = site_of(mesh, 2, 1);
                if (((a.must | b.must) & follows) == 0) mesh.neighbours.clear(), mesh.faces.clear();
                a.plant(at, random);
                b.plant(other, random);
                expect_named(mesh, a.must | b.must, a.may | b.may | follows | set_of(DefectKind::mixed_orientation),
                             harmless(a) && harmless(b));
            }
        }
    }
}

// In the same box they may hide each other, or even make good: the judge decides.
TEST(Defects, InPairsInOnePlace) {
    std::size_t certified = 0;
    for (const PlantedDefect& a : defects) {
        for (const PlantedDefect& b : defects) {
            if (a.only_3d || b.only_3d) continue;
            SCOPED_TRACE(std::string(a.name) + " and " + b.name);
            base::Random random = base::Random::stream(7, base::hash64(a.name), base::hash64(b.name));
            Mesh mesh = mesh_of_sites(2, 1);
            const Site site = site_of(mesh, 1, 0);
            if (((a.must | b.must) & follows) == 0) mesh.neighbours.clear();
            if (&a == &b) continue;
            a.plant(site, random);
            b.plant(site, random);
            const CheckReport r = quick(mesh);
            EXPECT_FALSE(r.certified() && !judge(mesh).complex);
            if (!r.certified() && (found(r) & (follows | set_of(DefectKind::not_finite))) == 0) {
                EXPECT_FALSE(judge(mesh).complex);
            }
            certified += r.certified() ? 1 : 0;
        }
    }
    EXPECT_GT(certified, 0U);
}

// A cell taken out is no defect: it leaves a cavity, or a notch.
TEST(Defects, CellTakenOut) {
    for (const int d : {2, 3}) {
        for (std::uint64_t i = 0; i < 15; ++i) {
            base::Random random(i);
            Mesh mesh = mesh_of_sites(d, 1);
            mesh.neighbours.clear(), mesh.faces.clear();
            std::vector<bool> keep(mesh.cell_count(), true);
            keep[random.below(keep.size())] = false;
            mesh = only(mesh, keep);
            expect_named(mesh, 0,
                         set_of(DefectKind::unused_node, DefectKind::pinched_node, DefectKind::pinched_ridge,
                                DefectKind::missing_cell),
                         true);
        }
    }
}

// The kind of a degenerate cell, and its cells and nodes, are told rightly.
TEST(Defects, Places) {
    Mesh mesh = mesh_of_sites(3, 1);
    mesh.neighbours.clear(), mesh.faces.clear();
    const auto cells = static_cast<Mesh::Index>(mesh.cell_count());
    const Site site = site_of(mesh, 1, 0);
    base::Random random(1);
    for (const PlantedDefect& defect : defects) {
        const std::string name = defect.name;
        if (name == "flat cell" || name == "cell on a line" || name == "cell in a point") defect.plant(site, random);
    }
    mesh.cells.insert(mesh.cells.end(), {8, 9, 8, 3, 2, 1, 0, -1});
    const CheckReport r = quick(mesh);
    const Defect& degenerate = *r.find(DefectKind::degenerate_cell);
    ASSERT_EQ(degenerate.places.size(), 3U);
    const char* const kinds[] = {"coplanar", "collinear", "a point"};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_STREQ(degenerate.places[i].detail, kinds[i]);
        EXPECT_EQ(degenerate.places[i].cells[0], cells + static_cast<Mesh::Index>(i));
    }
    EXPECT_EQ(r.find(DefectKind::repeated_node)->places.at(0).cells[0], cells + 3);
    EXPECT_EQ(r.find(DefectKind::index_out_of_range)->places.at(0).cells[0], cells + 4);
    for (const Defect& f : r.defects) {
        for (const DefectPlace& place : f.places) {
            for (const Mesh::Index c : place.cells) {
                EXPECT_TRUE(c < 0 || (r.measures.defects[static_cast<std::size_t>(c)] & defect_bit(f.kind)) != 0 ||
                            f.kind == DefectKind::pinched_node || f.kind == DefectKind::pinched_ridge ||
                            f.kind == DefectKind::open_boundary)
                    << words(defect_bit(f.kind)) << " of cell " << c;
            }
        }
    }
}

}  // namespace
}  // namespace barycert::testing
