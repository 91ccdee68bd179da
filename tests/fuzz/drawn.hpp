/// A small mesh, points and fields, drawn from the bytes of an input: any bytes make some.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::fuzz {

/// Numbers from bytes; zeros when they have run out.
class Draws {
public:
    explicit Draws(std::string_view bytes) : bytes_(bytes) {}

    unsigned byte();
    unsigned below(unsigned count) { return byte() % count; }
    bool done() const { return bytes_.empty(); }

    /// Finite, of eight bytes; others are 0.
    double any();

private:
    std::string_view bytes_;
};

/// Where coordinates come from.
enum class Numbers : std::uint8_t {
    lattice,  ///< small integers: degeneracies abound
    fine,     ///< 32nds
    nudged,   ///< small integers and some ulps
    scaled,   ///< small integers times a power of two, from the subnormals to 2^1000
    any,      ///< any finite doubles
};

double draw_number(Draws& draws, Numbers numbers);

struct Drawn {
    Mesh mesh;
    Numbers numbers = Numbers::lattice;
    std::vector<double> points;
};

/// Cells of any nodes, or a box of some cells (check/meshes.hpp), with nodes moved, cells gone, doubled, turned and
/// new. Indices are in range and coordinates finite; all else may be wrong with it. Points are nodes, lie midway
/// between nodes, in cells, or anywhere.
Drawn draw_mesh(Draws& draws, std::size_t max_cells, std::size_t max_points);

}  // namespace barycert::fuzz
