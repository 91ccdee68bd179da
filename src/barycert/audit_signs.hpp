/// Pictures of signs: what a kernel says of 256 x 256 neighbouring points beside a side of the simplex.
///
/// The experiment of Kettner, Mehlhorn, Pion, Schirra and Yap ("Classroom examples of robustness problems in geometric
/// computations", 2008): the point runs over a grid with steps of one ulp around (1/2, 1/2), the side lies on the
/// diagonal x = y from 12 to 24, and the sign of the weight of the vertex off that side tells on which side the kernel
/// sees the point. Exactly, the picture is a diagonal of zeros with one sign on either side of it. For a tetrahedron
/// the side is a face in the plane x = y; a triangle3d lies in the plane z = 1/2; in perspective the depths are 1,
/// 2, 3.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "barycert/kernels.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

struct SignPicture {
    static constexpr int side = 256;  ///< points along x and along y

    std::string kernel;  ///< empty: the exact one
    Simplex simplex = Simplex::triangle;
    bool perspective = false;
    /// Sign of the weight, 2: no finite weight, or declared degenerate. Row by row, by ascending y, then x.
    std::vector<std::int8_t> signs;
    std::uint64_t wrong = 0;  ///< points whose sign is not the exact one
};

/// The case of point (i, j) of the grid. Preconditions: not a segment; 0 <= i, j < side.
Case sign_case(Simplex s, bool perspective, int i, int j);

/// One picture a kernel that is not for segments, in the order of the kernels; before the first kernel of each kind of
/// case the exact picture.
std::vector<SignPicture> sign_pictures(const std::vector<Kernel>& kernels);

}  // namespace barycert
