// Families, and the meshes that some of them draw simplices from.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/recipes.hpp"
#include "barycert/certificate.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "barycert/witness.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "mesh/adjacency.hpp"

namespace barycert::audit {
namespace {

bool serves(const PreparedMesh& m, Simplex s) {
    return m.mesh.dimension == space_dimension(s);
}

/// A mesh that serves; each has the same chance, however large: small ones are the nasty ones. Requires:
/// source.supplies(s).
const PreparedMesh& pick(const MeshSource& source, Simplex s, base::Random& random) {
    const auto& meshes = source.meshes();
    const auto count = std::ranges::count_if(meshes, [s](const auto& m) { return serves(*m, s); });
    auto skip = random.below(static_cast<std::uint64_t>(count));
    return **std::ranges::find_if(meshes, [&](const auto& m) { return serves(*m, s) && skip-- == 0; });
}

std::array<Mesh::Index, 4> nodes_of(const Mesh& mesh, std::size_t cell) {
    std::array<Mesh::Index, 4> nodes{};
    std::copy_n(&mesh.cells[cell * mesh.corners()], mesh.corners(), nodes.begin());
    return nodes;
}

}  // namespace

Draw draw_of_nodes(const PreparedMesh& from, Mesh::Index cell, std::array<Mesh::Index, 4> nodes, Simplex s,
                   base::Random& random) {
    Draw draw{&from, cell, nodes, {.simplex = s}};
    const Mesh& mesh = from.mesh;
    const Field* const field =
        mesh.point_fields.empty() ? nullptr : &mesh.point_fields[random.below(mesh.point_fields.size())];
    const std::size_t components = field == nullptr ? 1 : static_cast<std::size_t>(field->components);
    const std::size_t component = random.below(components);
    for (int i = 0; i < vertex_count(s); ++i) {
        const Mesh::Index node = nodes[static_cast<std::size_t>(i)];
        std::copy_n(mesh.point(node), mesh.dimension, &draw.simplex.vertex(i, 0));
        double& value = draw.simplex.values[static_cast<std::size_t>(i)];
        if (field != nullptr) value = field->data[static_cast<std::size_t>(node) * components + component];
        if (field == nullptr || !std::isfinite(value)) value = random.uniform(-1, 1);
    }
    return draw;
}

Draw draw_of_cell(const PreparedMesh& from, Mesh::Index cell, base::Random& random) {
    const Simplex whole = from.mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron;
    return draw_of_nodes(from, cell, nodes_of(from.mesh, static_cast<std::size_t>(cell)), whole, random);
}

Draw draw_any(const MeshSource& meshes, Simplex s, base::Random& random) {
    const PreparedMesh& from = pick(meshes, s, random);
    const auto cell = random.below(from.mesh.cell_count());
    std::array<Mesh::Index, 4> nodes = nodes_of(from.mesh, cell);
    // A face leaves out one corner, an edge another one: rotate what is left out to the end.
    if (s == Simplex::triangle3d || s == Simplex::segment) std::swap(nodes[random.below(4)], nodes[3]);
    if (s == Simplex::segment) std::swap(nodes[random.below(3)], nodes[2]);
    return draw_of_nodes(from, static_cast<Mesh::Index>(cell), nodes, s, random);
}

Draw draw_at_hull(const MeshSource& meshes, Simplex s, base::Random& random) {
    const PreparedMesh& from = pick(meshes, s, random);
    const auto corners = from.mesh.corners();
    if (from.hull_facets.empty()) return draw_any(meshes, s, random);
    const auto facet = static_cast<std::size_t>(from.hull_facets[random.below(from.hull_facets.size())]);
    const auto cell = facet / corners;
    std::array<Mesh::Index, 4> nodes = nodes_of(from.mesh, cell);
    std::swap(nodes[facet % corners], nodes[corners - 1]);
    return draw_of_nodes(from, static_cast<Mesh::Index>(cell), nodes, s, random);
}

}  // namespace barycert::audit

namespace barycert {

using namespace audit;

void MeshSource::add(std::string name, Mesh mesh, const Certificate& certificate) {
    if (mesh.cell_count() == 0) return;
    PreparedMesh p{.name = std::move(name), .mesh = std::move(mesh), .certificate = certificate};
    p.neighbours = mesh::compute_neighbours(p.mesh);
    p.hull_facets = mesh::hull_facets(p.mesh, p.neighbours);
    const auto d = static_cast<std::size_t>(p.mesh.dimension);
    for (std::size_t i = 0; i < p.mesh.points.size(); ++i) p.box[i % d].add(p.mesh.points[i]);
    meshes_.push_back(std::make_shared<const PreparedMesh>(std::move(p)));
}

bool MeshSource::supplies(Simplex s) const {
    return std::any_of(meshes_.begin(), meshes_.end(), [s](const auto& m) { return audit::serves(*m, s); });
}

bool Family::applies_to(Simplex s) const {
    return std::ranges::find(simplices, s) != simplices.end();
}

const std::vector<Family>& all_families() {
    static const std::vector<Family> families = [] {
        std::vector<Family> all = mesh_families();
        for (Family& f : all) f.needs_mesh = true;
        for (auto* part : {plain_families, window_families}) {
            for (Family& f : part()) all.push_back(std::move(f));
        }
        for (Family& f : all) f.perspective = f.name.starts_with("perspective.");
        return all;
    }();
    return families;
}

std::vector<Family> families_matching(std::string_view glob) {
    std::vector<Family> matching = all_families();
    std::erase_if(matching, [&](const Family& f) { return !base::glob_match(glob, f.name); });
    return matching;
}

Case make_case(const Family& family, Simplex s, std::uint64_t seed, std::uint64_t index, const MeshSource& meshes,
               Witness* witness) {
    const ExactEnvironment environment;
    const std::uint64_t stream = base::hash64(family.name) + static_cast<std::uint64_t>(s);
    base::Random random = base::Random::stream(seed, stream, index);
    Case c{.simplex = s, .perspective = family.perspective};
    if (witness != nullptr) witness->family = family.name, witness->seed = seed, witness->index = index;
    if (family.needs_mesh) {
        const Draw draw = family.mesh_recipe(random, meshes, s);
        c = draw.simplex;
        keep_finite(c.point);
        if (witness != nullptr) witness->mesh = draw.from->name, witness->cell = draw.from->mesh.cell_number(draw.cell);
    } else {
        family.recipe(c, random, index);
    }
    if (witness != nullptr) witness->c = c;
    return c;
}

}  // namespace barycert
