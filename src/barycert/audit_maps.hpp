/// Maps of a mesh: in which of its cells a kernel errs, and by how much.
///
/// A mesh in the plane is seen whole; of one in space a plane section, normal to an axis, in which the cells that it
/// meets are seen. Each of these cells is asked for the same few points: one inside, one computed on each of its facets
/// and, beside each of these, one that is an ulp off in one coordinate.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "barycert/audit_families.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mesh.hpp"

namespace barycert {

struct MeshMap {
    static constexpr std::size_t longer_side = 160, shortest_side = 32;  ///< pixels
    static constexpr std::size_t max_meshes = 4, max_kernels = 6;        ///< of mesh_maps()

    std::string mesh;
    std::string why_not;  ///< why there is no map; then all below is empty
    int dimension = 3;

    // The picture: x to the right and y upwards; of a section the other two axes, in their order.
    int axis = -1;  ///< of the section: coordinate `axis` is `at`; -1: the mesh lies in the plane
    double at = 0;
    std::array<double, 2> low{}, high{};
    std::size_t width = 0, height = 0;
    std::vector<std::int32_t> pixels;  ///< place in `cells` of the owner of the pixel's centre, -1: none; from the top

    std::vector<Mesh::Index> cells;  ///< those that are seen, ascending, by their numbers in the mesh's file

    struct OfKernel {
        std::string kernel;
        /// The largest Comparison::relative_error, a cell: infinite where there was no finite answer, -1 where the
        /// kernel had been given up.
        std::vector<double> errors;
        std::uint64_t cases = 0, wrong = 0;  ///< with a finding
    };
    /// Of those given that are for its cells: if they are more than max_kernels, the first of those that are no
    /// variants (names with a second dot).
    std::vector<OfKernel> kernels;
    std::size_t left_out = 0;  ///< how many more of these there are
};

/// Of the first meshes for whose cells there is a kernel. Points depend on the seed and the mesh alone.
std::vector<MeshMap> mesh_maps(const std::vector<Kernel>& kernels, const MeshSource& meshes, std::uint64_t seed,
                               int threads = 0);

}  // namespace barycert
