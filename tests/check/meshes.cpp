#include "tests/check/meshes.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

namespace barycert::testing {

Mesh own_mesh(const std::string& stem) {
    return read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/") + stem).value();
}

Mesh box(int d, std::array<int, 3> cubes) {
    Mesh mesh;
    mesh.dimension = d;
    if (d == 2) cubes[2] = 0;
    const int nx = cubes[0] + 1, ny = cubes[1] + 1;
    const auto node = [&](const std::array<int, 3>& at) { return at[0] + nx * (at[1] + ny * at[2]); };
    for (int z = 0; z <= cubes[2]; ++z) {
        for (int y = 0; y <= cubes[1]; ++y) {
            for (int x = 0; x <= cubes[0]; ++x) {
                mesh.points.insert(mesh.points.end(), {double(x), double(y)});
                if (d == 3) mesh.points.push_back(z);
            }
        }
    }
    for (int z = 0; z < std::max(cubes[2], d == 2 ? 1 : 0); ++z) {
        for (int y = 0; y < cubes[1]; ++y) {
            for (int x = 0; x < cubes[0]; ++x) {
                std::array<std::size_t, 3> axes{0, 1, 2};
                do {  // the path of steps along the axes in this order
                    std::array<int, 3> at{x, y, z};
                    std::vector<Mesh::Index> cell{node(at)};
                    int inversions = 0;
                    for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
                        ++at[axes[i]];
                        cell.push_back(node(at));
                        for (std::size_t j = 0; j < i; ++j) inversions += axes[j] > axes[i] ? 1 : 0;
                    }
                    if (inversions % 2 != 0) std::swap(cell[0], cell[1]);
                    mesh.cells.insert(mesh.cells.end(), cell.begin(), cell.end());
                } while (std::next_permutation(axes.begin(), axes.begin() + d));
            }
        }
    }
    return mesh;
}

Mesh only(const Mesh& mesh, const std::vector<bool>& keep) {
    Mesh kept = mesh;
    kept.cells.clear();
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        const auto first = mesh.cells.begin() + static_cast<std::ptrdiff_t>(c * mesh.corners());
        if (keep[c]) kept.cells.insert(kept.cells.end(), first, first + mesh.dimension + 1);
    }
    return kept;
}

Mesh mapped(Mesh mesh, std::array<double, 3> factor, std::array<double, 3> shift) {
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const std::size_t k = i % static_cast<std::size_t>(mesh.dimension);
        mesh.points[i] = mesh.points[i] * factor[k] + shift[k];
    }
    return mesh;
}

Mesh joined(Mesh a, const Mesh& b) {
    const auto offset = static_cast<Mesh::Index>(a.point_count());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const Mesh::Index i : b.cells) a.cells.push_back(i + offset);
    return a;
}

Mesh renumbered(const Mesh& mesh, base::Random& random) {
    const auto shuffled = [&](std::size_t n) {
        std::vector<std::size_t> order(n);
        std::iota(order.begin(), order.end(), std::size_t{0});
        for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
        return order;
    };
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const auto nodes = shuffled(mesh.point_count()), cells = shuffled(mesh.cell_count());
    Mesh out;
    out.dimension = mesh.dimension;
    out.points.resize(mesh.points.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (std::size_t k = 0; k < d; ++k) out.points[nodes[i] * d + k] = mesh.points[i * d + k];
    }
    for (const std::size_t c : cells) {
        std::vector<Mesh::Index> corners;
        for (std::size_t i = 0; i <= d; ++i)
            corners.push_back(static_cast<Mesh::Index>(nodes[static_cast<std::size_t>(mesh.cells[c * (d + 1) + i])]));
        // Turning three corners is even, whichever they are.
        std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
                    corners.begin() + 3);
        std::rotate(corners.end() - 3, corners.end() - 3 + static_cast<std::ptrdiff_t>(random.below(3)), corners.end());
        out.cells.insert(out.cells.end(), corners.begin(), corners.end());
    }
    return out;
}

std::size_t flip_some(Mesh& mesh, base::Random& random) {
    std::size_t flipped = 0;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        if (random.coin()) continue;
        ++flipped;
        const std::size_t i = random.below(mesh.corners()),
                          j = (i + 1 + random.below(mesh.corners() - 1)) % mesh.corners();
        std::swap(mesh.cells[c * mesh.corners() + i], mesh.cells[c * mesh.corners() + j]);
    }
    return flipped;
}

Mesh::Index add_node(Mesh& mesh, const std::vector<double>& at) {
    mesh.points.insert(mesh.points.end(), at.begin(), at.end());
    return static_cast<Mesh::Index>(mesh.point_count()) - 1;
}

std::vector<double> node_at(const Mesh& mesh, Mesh::Index node) {
    const auto first = mesh.points.begin() + static_cast<std::ptrdiff_t>(node) * mesh.dimension;
    return {first, first + mesh.dimension};
}

std::vector<double> in_cell(const Mesh& mesh, std::size_t cell, const std::vector<double>& weights) {
    std::vector<double> at(static_cast<std::size_t>(mesh.dimension), 0);
    for (std::size_t i = 0; i < mesh.corners(); ++i) {
        const auto corner = node_at(mesh, mesh.cells[cell * mesh.corners() + i]);
        for (std::size_t k = 0; k < at.size(); ++k) at[k] += weights[i] * corner[k];
    }
    return at;
}

DefectSet found(const CheckReport& report) {
    DefectSet all = 0;
    for (const Defect& f : report.defects) all |= defect_bit(f.kind);
    return all;
}

std::string words(DefectSet problems) {
    std::string text;
    for (const auto& t : defect_texts) {
        if ((problems & defect_bit(t.kind)) != 0) text += (text.empty() ? "" : " ") + std::string(t.name);
    }
    return text.empty() ? "nothing" : text;
}

CheckReport quick(const Mesh& mesh, std::size_t contacts) {
    CheckOptions options;
    options.threads = 1;
    options.contacts = contacts;
    return check_mesh(mesh, options);
}

}  // namespace barycert::testing
