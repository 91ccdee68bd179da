/// Pictures of an audit: signs around a triangle, kernels over the cells of a mesh, drift along triangles, and rules
/// for texels.
///
/// Example:
///
///     const std::vector<SignPicture> pictures = sign_pictures(kernels_matching("triangle.*"));
///     const std::uint64_t wrong = pictures.back().wrong;  // points whose sign is not the exact one
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/family.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

// Pictures of signs: what a kernel says of 256 x 256 neighbouring points beside a side of the simplex.
//
// The experiment of Kettner, Mehlhorn, Pion, Schirra and Yap ("Classroom examples of robustness problems in geometric
// computations", 2008): the point runs over a grid with steps of one ulp around (1/2, 1/2), the side lies on the
// diagonal x = y from 12 to 24, and the sign of the weight of the vertex off that side tells on which side the kernel
// sees the point. Exactly, the picture is a diagonal of zeros with one sign on either side. The side of a tetrahedron
// is a face in the plane x = y; a triangle3d lies in the plane z = 1/2; in perspective the depths are 1, 2, 3.

struct SignPicture {
    static constexpr int side = 256;  ///< points along x and along y

    std::string kernel;  ///< empty: the exact one
    Simplex simplex = Simplex::triangle;
    bool perspective = false;
    /// Sign of the weight, 2: no finite weight, or declared degenerate. Row by row, by ascending y, then x.
    std::vector<std::int8_t> signs;
    std::uint64_t wrong = 0;  ///< points whose sign is not the exact one
};

/// The case of point (i, j) of the grid. Requires: not a segment; 0 <= i, j < side.
Case sign_case(Simplex s, bool perspective, int i, int j);

/// One picture a kernel that is not for segments, in the order of the kernels; before the first kernel of each kind of
/// case the exact picture.
std::vector<SignPicture> sign_pictures(const std::vector<Kernel>& kernels);

// Maps of a mesh: in which of its cells a kernel errs, and by how much. A mesh in the plane is seen whole, of one in
// space a section normal to an axis. Each of the cells seen is asked for the same few points: one inside, one computed
// on each of its facets and, beside each of these, one that is an ulp off in one coordinate.

/// The plane of a picture.
struct MeshFrame {
    int axis = -1;  ///< of a section: coordinate `axis` is `at`; -1: the mesh lies in the plane
    double at = 0;
    std::array<std::size_t, 2> shown{0, 1};  ///< the axes to the right and upwards
    std::size_t width = 0, height = 0;
};

struct MeshMap : MeshFrame {
    static constexpr std::size_t longer_side = 160, shortest_side = 32;  ///< pixels
    static constexpr std::size_t max_meshes = 4, max_kernels = 6;        ///< of mesh_maps()

    std::string mesh;
    std::string why_not;  ///< why there is no map; then all below is empty
    int dimension = 3;

    std::array<double, 2> low{}, high{};  ///< on the axes that are shown
    std::vector<std::int32_t> pixels;  ///< place in `cells` of the owner of the pixel's centre, -1: none; from the top

    std::vector<Mesh::Index> cells;  ///< those that are seen, ascending, by their numbers in the mesh's file

    struct OfKernel {
        std::string kernel;
        /// The largest Comparison::relative_error, a cell: infinite where there was no finite answer, -1 where the
        /// kernel had been given up.
        std::vector<double> errors;
        std::uint64_t cases = 0, wrong = 0;  ///< with a finding
    };
    /// The given kernels that are for cells of this kind. If they are more than max_kernels: the first of those that
    /// are no variants (names with a second dot).
    std::vector<OfKernel> kernels;
    std::size_t left_out = 0;  ///< how many more of these there are
};

/// Returns maps of the first meshes for whose cells there is a kernel. Points depend on the seed and the mesh alone.
std::vector<MeshMap> mesh_maps(const std::vector<Kernel>& kernels, const MeshSource& meshes, std::uint64_t seed,
                               int threads = 0);

// Drift: how far the value of an attribute moves away from the exact one as a triangle in a window grows. Cases are
// those of the family triangle.pixels: vertices on the grid of 1/256 pixel in boxes of 4, 8, ... 4096 pixels, pixel
// centres in the triangle; attributes are 1 to 2 at the vertices. The box lies at the origin and the triangle fills an
// eighth of it at least, so that the steps tell, not the shape or the place.

struct DriftOptions {
    std::vector<Kernel> kernels;  ///< on triangles, without perspective
    std::uint64_t count = 10000;  ///< cases per size
    std::uint64_t seed = 1;
};

/// Errors of one kernel over the cases of one size.
struct DriftPoint {
    int size = 0;                  ///< of the box, in pixels
    std::uint64_t cases = 0;       ///< with a finite value
    std::uint64_t not_finite = 0;  ///< without, or without an answer: the kernel crashed, hung or has been given up
    double worst_ulp = 0;          ///< largest error in ulps of the exact value, which is between 1 and 2
    double worst_relative = 0;     ///< largest |value / exact value - 1|
    std::uint64_t index = 0;       ///< of the worst case
};

struct DriftCurve {
    Kernel kernel;
    std::vector<DriftPoint> points;  ///< by ascending size
};

struct DriftReport {
    std::uint64_t seed = 0;
    std::uint64_t count = 0;
    std::vector<DriftCurve> curves;  ///< in the order of the kernels
};

/// Errors: no kernel, one that is not for triangles, count 0.
Result<DriftReport> measure_drift(const DriftOptions& options);

/// Case `index` of a size: the same on every machine.
Case drift_case(int size, std::uint64_t seed, std::uint64_t index);

// The audit of rules that find the texel of a texture coordinate. A row of `size` texels covers the coordinates u from
// 0 to 1: texel k those from k / size up to (k + 1) / size, the last one u = 1 too. Coordinates beyond belong to the
// first or last texel (clamp) or to the copies of the row side by side (repeat). Rules are compared with exact integers
// where such code is known to fail: at and within a few ulps of the borders of texels, at and beyond both ends,
// subnormal, huge.

enum class TexelWrap : std::uint8_t { clamp, repeat };

constexpr std::string_view name(TexelWrap w) {
    return w == TexelWrap::clamp ? "clamp" : "repeat";
}

struct TexelRule {
    std::string name;  ///< `texture.rule`
    TexelWrap wrap = TexelWrap::clamp;
    std::string formula, source, fails;                            ///< one line each, as those of Kernel
    std::int64_t (*texel)(double u, std::int64_t size) = nullptr;  ///< u finite, 1 <= size <= 2^31
};

/// All rules, in a fixed order: faults that are in use, and the exact ones.
const std::vector<TexelRule>& texel_rules();

enum class TexelFinding : std::uint8_t {
    past_end,      ///< size or more: reads what is not of the row
    before_start,  ///< negative
    wrong_texel,   ///< of the row, but not the one of u
};

inline constexpr std::array<std::string_view, 3> texel_finding_names{"past_end", "before_start", "wrong_texel"};

struct TexelWitness {
    double u = 0;
    std::int64_t size = 0, texel = 0, exact = 0;
};

struct TexelResult {
    TexelRule rule;
    std::uint64_t cases = 0;
    std::array<std::uint64_t, 3> counts{};    ///< by TexelFinding
    std::array<TexelWitness, 3> witnesses{};  ///< the first of each, where there is one
};

/// Holds each rule against the oracle on the same coordinates for rows of 1 to 2^31 texels.
std::vector<TexelResult> audit_texels(const std::vector<TexelRule>& rules, std::uint64_t count = 100000,
                                      std::uint64_t seed = 1);

}  // namespace barycert
