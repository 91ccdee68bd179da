/// Families: recipes for cases, and the meshes that some of them draw simplices from.
///
/// Example:
///
///     #include <cstdio>
///     for (const Family& family : families_matching("*sliver*")) {
///         if (family.applies_to(Simplex::tetrahedron)) std::puts(family.tests.c_str());
///     }
#pragma once

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

    /// For recipes: the meshes as audit/recipes.hpp has them.
    const std::vector<std::shared_ptr<const audit::PreparedMesh>>& meshes() const { return meshes_; }

private:
    std::vector<std::shared_ptr<const audit::PreparedMesh>> meshes_;
};

/// A recipe for cases that tests a particular way in which formulas fail. Case i depends on (seed, family, simplex, i)
/// and, for mesh families, on the meshes; on nothing else. Only correctly rounded operations are used (+ - * / sqrt and
/// powers of two), so the same seed gives the same bits on every machine.
struct Family {
    std::string name;
    std::string tests;       ///< what it tests, one line
    std::string parameters;  ///< the recipe with its numbers
    std::vector<Simplex> simplices;

    /// Fills `c` (its simplex is set, all else zero). `index` is the case's number.
    void (*recipe)(Case& c, base::Random& random, std::uint64_t index) = nullptr;
    /// Set for a family from meshes: makes the simplex, and returns the draw that it is.
    audit::Draw (*mesh_recipe)(base::Random& random, const MeshSource& meshes, Simplex s) = nullptr;

    bool needs_mesh = false;
    bool perspective = false;  ///< its cases are for kernels with Kernel::perspective, and no others

    bool applies_to(Simplex s) const;
};

/// All families in a fixed order, those from meshes first.
const std::vector<Family>& all_families();

std::vector<Family> families_matching(std::string_view glob);

}  // namespace barycert
