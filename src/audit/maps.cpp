#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "audit/asking.hpp"
#include "audit/recipes.hpp"
#include "barycert/audit_pictures.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mesh.hpp"
#include "barycert/oracle.hpp"
#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "core/base/random.hpp"
#include "core/base/range.hpp"
#include "mesh/consistency.hpp"

namespace barycert {

using namespace audit;

namespace {

/// The centres of a grid of pixels: coordinates of its columns, and of its rows from the top.
struct Centres {
    Centres(const PreparedMesh& m, const MeshFrame& f) {
        const auto fill = [&](std::vector<double>& to, std::size_t axis, std::size_t count) {
            for (std::size_t i = 0; i < count; ++i) {
                const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
                to.push_back((1 - t) * m.box[axis].low + t * m.box[axis].high);
            }
        };
        fill(columns, f.shown[0], f.width);
        fill(rows, f.shown[1], f.height);
        std::ranges::reverse(rows);
    }

    std::vector<double> columns, rows;
};

/// Places of the first of the centres within a range, and behind the last one; equal if none is.
std::pair<std::size_t, std::size_t> between(const std::vector<double>& centres, const base::Range& range) {
    const auto is_in = [&](double x) { return range.low <= x && x <= range.high; };
    const auto first = std::ranges::find_if(centres, is_in);
    const auto end = std::find_if(centres.rbegin(), std::make_reverse_iterator(first), is_in).base();
    return {static_cast<std::size_t>(first - centres.begin()), static_cast<std::size_t>(end - centres.begin())};
}

/// The lowest cell that has each centre of a grid of pixels, row by row from the top; -1: none has.
std::vector<Mesh::Index> owners_in(const PreparedMesh& m, const MeshFrame& f) {
    const Mesh& mesh = m.mesh;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const Simplex simplex = d == 2 ? Simplex::triangle : Simplex::tetrahedron;
    const Centres centres(m, f);
    std::vector<Mesh::Index> owners(f.width * f.height, -1);
    std::array<double, 12> vertices{};
    std::array<double, 3> point{};
    if (f.axis >= 0) point[static_cast<std::size_t>(f.axis)] = f.at;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        std::array<base::Range, 3> box;
        double* to = vertices.data();
        for (const Mesh::Index node : mesh.corners_of(cell)) {
            for (std::size_t k = 0; k < d; ++k) box[k].add(*to++ = mesh.point(node)[k]);
        }
        if (f.axis >= 0) {
            const base::Range& across = box[static_cast<std::size_t>(f.axis)];
            if (f.at < across.low || f.at > across.high) continue;
        }
        const auto [left, right] = between(centres.columns, box[f.shown[0]]);
        const auto [top, bottom] = between(centres.rows, box[f.shown[1]]);
        for (std::size_t row = top; row < bottom; ++row) {
            for (std::size_t column = left; column < right; ++column) {
                Mesh::Index& owner = owners[row * f.width + column];
                if (owner >= 0) continue;
                point[f.shown[0]] = centres.columns[column];
                point[f.shown[1]] = centres.rows[row];
                const Region region = weight_signs(simplex, vertices.data(), point.data()).region();
                if (region == Region::interior || region == Region::boundary) owner = static_cast<Mesh::Index>(cell);
            }
        }
    }
    return owners;
}

/// The first plane, from the middle outwards, that cuts at least half as much out of the mesh as any other; seen
/// coarsely. Sections near the ends are for plates.
MeshFrame best_frame(const PreparedMesh& m) {
    if (m.mesh.dimension == 2) return MeshFrame();
    const std::array<double, 3> extent{m.box[0].half(), m.box[1].half(), m.box[2].half()};  // the whole may overflow
    const double largest = std::max({extent[0], extent[1], extent[2]});
    std::vector<std::pair<double, MeshFrame>> planes;
    for (const double t : {0.5, 0.375, 0.625, 0.25, 0.75, 0.125, 0.875, 0.0625, 0.9375, 0.03125, 0.96875}) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double at = (1 - t) * m.box[k].low + t * m.box[k].high;
            const MeshFrame f{static_cast<int>(k), at, {k == 0 ? 1U : 0U, k == 2 ? 1U : 2U}, 24, 24};
            const auto owners = owners_in(m, f);
            const auto inside = std::ranges::count_if(owners, [](Mesh::Index c) { return c >= 0; });
            const double sides = (extent[f.shown[0]] / largest) * (extent[f.shown[1]] / largest);
            planes.emplace_back(static_cast<double>(inside) * sides, f);
        }
    }
    const double most = std::ranges::max_element(planes, {}, &std::pair<double, MeshFrame>::first)->first;
    return std::ranges::find_if(planes, [&](const auto& p) { return !(p.first < most / 2); })->second;
}

/// As long and as high as the mesh, but so that something is seen of thin ones.
void set_size(MeshFrame& f, const PreparedMesh& m) {
    const double across = m.box[f.shown[0]].half(), up = m.box[f.shown[1]].half(), larger = std::max(across, up);
    const auto pixels = [&](double size) {
        const double n = larger > 0 ? std::round(static_cast<double>(MeshMap::longer_side) * (size / larger)) : 0;
        return std::max(static_cast<std::size_t>(n), MeshMap::shortest_side);
    };
    f.width = pixels(across);
    f.height = pixels(up);
}

/// The cases of one cell.
void add_cases(const PreparedMesh& m, Mesh::Index cell, std::uint64_t seed, std::vector<Case>& cases) {
    base::Random random = base::Random::stream(seed, base::hash64("maps"), static_cast<std::uint64_t>(cell));
    const auto n = m.mesh.corners();
    Case c = draw_of_cell(m, cell, random).simplex;
    const int count = static_cast<int>(n);
    c.point = random_point(c, random, count);
    cases.push_back(c);
    for (std::size_t facet = 0; facet < n; ++facet) {
        std::array<double, 4> w = random_weights(random, count - 1);
        std::rotate(&w[facet], &w[n - 1], &w[n - 1] + 1);  // the last one, 0, to the vertex off the facet
        c.point = combination(c, w, count);
        cases.push_back(c);
        const auto axis = static_cast<std::size_t>(random.below(static_cast<std::uint64_t>(m.mesh.dimension)));
        move_by_ulp(c, c.point[axis], static_cast<int>(axis), random);
        cases.push_back(c);
    }
}

void fill_errors(MeshMap& map, const PreparedMesh& m, const std::vector<Mesh::Index>& cells,
                 const std::vector<Kernel>& kernels, std::uint64_t seed, int threads) {
    const std::size_t cases_a_cell = 1 + 2 * m.mesh.corners(), cells_a_piece = 256 / cases_a_cell;
    const std::size_t count = (cells.size() + cells_a_piece - 1) / cells_a_piece;
    for (const Kernel& k : kernels)
        map.kernels.push_back(
            {.kernel = k.name, .errors = std::vector<double>(cells.size(), -1), .cases = 0, .wrong = 0});
    on_threads(threads, count, [&](std::size_t piece) {
        const std::size_t first = piece * cells_a_piece, last = std::min(first + cells_a_piece, cells.size());
        std::vector<Case> cases;
        for (std::size_t i = first; i < last; ++i) add_cases(m, cells[i], seed, cases);
        std::vector<OracleAnswer> answers;
        std::ranges::transform(cases, std::back_inserter(answers), ask_oracle);
        std::vector<Statement> said(cases.size());
        for (std::size_t k = 0; k < kernels.size(); ++k) {
            ask_kernel(kernels[k], cases, said, false);
            std::uint64_t asked = 0, wrong = 0;
            for (std::size_t i = 0; i < cases.size(); ++i) {
                if (!said[i].ran) continue;
                const Comparison r = compare(kernels[k], cases[i], answers[i], said[i]);
                double& error = map.kernels[k].errors[first + i / cases_a_cell];
                error = std::max(error, r.relative_error);
                ++asked;
                wrong += r.wrong() ? 1 : 0;
            }
            std::atomic_ref(map.kernels[k].cases) += asked;
            std::atomic_ref(map.kernels[k].wrong) += wrong;
        }
    });
}

void fill_map(MeshMap& map, const PreparedMesh& m, const std::vector<Kernel>& kernels, std::uint64_t seed,
              int threads) {
    if (const char* const wrong = mesh::inconsistency_of_cells(m.mesh, mesh::FieldValues::any))
        throw Exception({.code = "mesh.inconsistent", .what = std::string("the mesh is inconsistent: ") + wrong});
    MeshFrame frame = best_frame(m);
    set_size(frame, m);
    const std::vector<Mesh::Index> owners = owners_in(m, frame);
    const std::set<Mesh::Index> seen(owners.begin(), owners.end());
    const std::vector<Mesh::Index> cells(seen.lower_bound(0), seen.end());
    if (cells.empty()) throw Exception({.code = "picture.empty", .what = "no cell is large enough to be seen"});
    static_cast<MeshFrame&>(map) = frame;
    map.low = {m.box[frame.shown[0]].low, m.box[frame.shown[1]].low};
    map.high = {m.box[frame.shown[0]].high, m.box[frame.shown[1]].high};
    for (const Mesh::Index owner : owners)
        map.pixels.push_back(
            owner < 0 ? -1 : static_cast<std::int32_t>(std::ranges::lower_bound(cells, owner) - cells.begin()));
    fill_errors(map, m, cells, kernels, seed, threads);
    for (const Mesh::Index cell : cells) map.cells.push_back(m.mesh.cell_number(cell));
}

}  // namespace

std::vector<MeshMap> mesh_maps(const std::vector<Kernel>& kernels, const MeshSource& meshes, std::uint64_t seed,
                               int threads) {
    const ExactEnvironment environment;
    std::vector<MeshMap> maps;
    for (const auto& m : meshes.meshes()) {
        if (maps.size() == MeshMap::max_meshes) break;
        const Simplex simplex = m->mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron;
        std::vector<Kernel> fit = kernels;
        std::erase_if(fit, [&](const Kernel& k) { return k.simplex != simplex || k.perspective; });
        if (fit.empty()) continue;
        const std::size_t all = fit.size();
        if (all > MeshMap::max_kernels) std::erase_if(fit, is_variant);
        fit.resize(std::min(fit.size(), MeshMap::max_kernels));
        MeshMap map;
        map.mesh = m->name;
        map.dimension = m->mesh.dimension;
        map.left_out = all - fit.size();
        try {
            fill_map(map, *m, fit, seed, threads);
        } catch (const Exception& e) {
            map.why_not = e.error().message();
        }
        maps.push_back(std::move(map));
    }
    return maps;
}

}  // namespace barycert
