#include "tests/fuzz/drawn.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "tests/mesh/check/meshes.hpp"

namespace barycert::fuzz {
namespace {

constexpr std::size_t max_nodes = 12;

Mesh draw_soup(Draws& draws, int dimension, Numbers numbers, std::size_t max_cells) {
    Mesh mesh;
    mesh.dimension = dimension;
    const std::size_t nodes = 1 + draws.below(max_nodes), cells = draws.below(static_cast<unsigned>(max_cells) + 1);
    for (std::size_t i = 0; i < nodes * static_cast<std::size_t>(dimension); ++i)
        mesh.points.push_back(draw_number(draws, numbers));
    for (std::size_t i = 0; i < cells * mesh.corners(); ++i)
        mesh.cells.push_back(static_cast<Mesh::Index>(draws.below(static_cast<unsigned>(nodes))));
    return mesh;
}

/// A box of up to twelve cells.
Mesh draw_box(Draws& draws, int dimension) {
    const int x = 1 + static_cast<int>(draws.below(2));
    return testing::box(dimension, {x, dimension == 2 ? 1 + static_cast<int>(draws.below(3)) : 1, 1});
}

void change(Mesh& mesh, Draws& draws, Numbers numbers, std::size_t max_cells) {
    const auto nodes = static_cast<unsigned>(mesh.point_count()), cells = static_cast<unsigned>(mesh.cell_count());
    const std::size_t n = mesh.corners();
    const auto cell = [&] { return mesh.cells.begin() + static_cast<std::ptrdiff_t>(draws.below(cells) * n); };
    switch (draws.below(8)) {
        case 0:
            if (cells == 0) break;
            {
                const auto gone = cell();
                mesh.cells.erase(gone, gone + static_cast<std::ptrdiff_t>(n));
            }
            break;
        case 1:
            if (cells == 0 || cells >= max_cells) break;
            for (std::size_t i = 0, from = draws.below(cells) * n; i < n; ++i)
                mesh.cells.push_back(mesh.cells[from + i]);
            break;
        case 2:
            if (cells == 0) break;
            std::iter_swap(cell(), cell() + 1);
            break;
        case 3:
            if (cells >= max_cells) break;
            for (std::size_t i = 0; i < n; ++i) mesh.cells.push_back(static_cast<Mesh::Index>(draws.below(nodes)));
            break;
        case 4:
            if (cells != 0)
                *(cell() + draws.below(static_cast<unsigned>(n))) = static_cast<Mesh::Index>(draws.below(nodes));
            break;
        default:
            mesh.points[draws.below(static_cast<unsigned>(mesh.points.size()))] = draw_number(draws, numbers);
    }
}

void draw_point(const Mesh& mesh, Draws& draws, Numbers numbers, std::vector<double>& points) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const auto coordinate = [&](std::size_t node, std::size_t k) { return mesh.points[d * node + k]; };
    const unsigned way = draws.below(4);
    if (way == 0) {
        for (std::size_t k = 0; k < d; ++k) points.push_back(draw_number(draws, numbers));
        return;
    }
    // A mean of nodes: of one, of two, of the corners of a cell.
    std::array<std::size_t, 4> nodes{};
    std::size_t count = way == 1 ? 1 : way == 2 || mesh.cells.empty() ? 2 : d + 1;
    const std::size_t cell = mesh.cells.empty() ? 0 : draws.below(static_cast<unsigned>(mesh.cell_count()));
    for (std::size_t i = 0; i < count; ++i)
        nodes[i] = count == d + 1 && !mesh.cells.empty() ? static_cast<std::size_t>(mesh.cells[cell * (d + 1) + i])
                                                         : draws.below(static_cast<unsigned>(mesh.point_count()));
    for (std::size_t k = 0; k < d; ++k) {
        double x = 0;
        for (std::size_t i = 0; i < count; ++i) x += coordinate(nodes[i], k) / static_cast<double>(count);
        points.push_back(std::isfinite(x) ? x : coordinate(nodes[0], k));
    }
}

}  // namespace

unsigned Draws::byte() {
    if (bytes_.empty()) return 0;
    const auto b = static_cast<unsigned char>(bytes_.front());
    bytes_.remove_prefix(1);
    return b;
}

double Draws::any() {
    std::array<unsigned char, 8> raw{};
    for (unsigned char& b : raw) b = static_cast<unsigned char>(byte());
    double x = 0;
    std::memcpy(&x, raw.data(), sizeof x);
    return std::isfinite(x) ? x : 0;
}

double draw_number(Draws& draws, Numbers numbers) {
    static constexpr std::array<int, 8> exponents{-1074, -1060, -1022, -540, -60, 0, 500, 1000};
    switch (numbers) {
        case Numbers::lattice:
            return static_cast<double>(draws.below(4));
        case Numbers::fine:
            return static_cast<double>(draws.byte()) / 32;
        case Numbers::nudged: {
            const unsigned b = draws.byte();
            double x = static_cast<double>(b % 4);
            for (unsigned i = b / 32; i > 4; --i) x = std::nextafter(x, 10);
            for (unsigned i = b / 32; i < 4; ++i) x = std::nextafter(x, -10);
            return x;
        }
        case Numbers::scaled: {
            const unsigned b = draws.byte();
            return std::ldexp(static_cast<double>(b % 8) - 3, exponents[b / 8 % exponents.size()]);
        }
        default:
            return draws.any();
    }
}

Drawn draw_mesh(Draws& draws, std::size_t max_cells, std::size_t max_points) {
    Drawn drawn;
    const unsigned how = draws.byte();
    const int dimension = how % 2 == 0 ? 3 : 2;
    drawn.numbers = static_cast<Numbers>(draws.below(5));
    drawn.mesh = (how & 2) != 0 ? draw_box(draws, dimension) : draw_soup(draws, dimension, drawn.numbers, max_cells);
    for (unsigned i = draws.below(8); i > 0; --i) change(drawn.mesh, draws, drawn.numbers, max_cells);
    const std::size_t points = draws.below(static_cast<unsigned>(max_points) + 1);
    for (std::size_t i = 0; i < points; ++i) draw_point(drawn.mesh, draws, drawn.numbers, drawn.points);
    return drawn;
}

}  // namespace barycert::fuzz
