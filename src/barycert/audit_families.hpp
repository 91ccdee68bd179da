/// Families of cases, and the meshes that some of them draw simplices from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

namespace base {
class Random;
}
namespace audit {
struct PreparedMesh;
struct Draw;
}  // namespace audit

/// Meshes whose cells, and the faces and edges of these, become simplices of cases. Copies share the meshes.
class MeshSource {
public:
    /// `certificate`: of this mesh, if it was checked.
    void add(std::string name, Mesh mesh, const Certificate& certificate = {});

    bool supplies(Simplex s) const;

    /// For recipes: the meshes as audit/mesh_draws.hpp has them.
    const std::vector<std::shared_ptr<const audit::PreparedMesh>>& meshes() const { return meshes_; }

private:
    std::vector<std::shared_ptr<const audit::PreparedMesh>> meshes_;
};

/// Where in a mesh the simplex of a case comes from.
struct CaseOrigin {
    std::string mesh;        ///< its name; empty if the simplex comes from none
    std::int64_t cell = -1;  ///< the number of its cell in the mesh's file, from 0
};

/// A recipe for cases; each family tests a particular way in which formulas fail.
///
/// Case number i of a family depends on (seed, family, simplex, i) and, for mesh families, on the meshes; on nothing
/// else. Only correctly rounded operations are used (+ - * / sqrt and powers of two), so the same seed gives the same
/// bits on every machine.
struct Family {
    std::string name;
    std::string tests;       ///< what it tests, one line
    std::string parameters;  ///< the recipe with its numbers
    bool needs_mesh = false;
    std::vector<Simplex> simplices;
    bool perspective = false;  ///< its cases are for kernels with Kernel::perspective, and no others

    /// Fills `c` (its simplex is set, all else zero). `index` is the case's number.
    using Recipe = void (*)(Case& c, base::Random& random, std::uint64_t index);
    Recipe recipe = nullptr;

    /// Returns the draw that the simplex is.
    using MeshRecipe = audit::Draw (*)(base::Random& random, const MeshSource& meshes, Simplex s);
    MeshRecipe mesh_recipe = nullptr;

    bool applies_to(Simplex s) const;
};

/// All families in a fixed order, those from meshes first.
const std::vector<Family>& all_families();

std::vector<Family> families_matching(std::string_view glob);

/// The case, and if wanted where it comes from. Preconditions: family.applies_to(s); family.needs_mesh implies
/// meshes.supplies(s).
Case make_case(const Family& family, Simplex s, std::uint64_t seed, std::uint64_t index, const MeshSource& meshes,
               CaseOrigin* origin = nullptr);

}  // namespace barycert
