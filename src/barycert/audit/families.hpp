/// Families: recipes for cases, each after a particular way of going wrong.
///
/// Case number i of a family depends on (seed, family, simplex, i) and, for mesh families, on the meshes; on nothing
/// else. Only correctly rounded operations are used (+ - * / sqrt and powers of two), so the same seed gives the same
/// bits on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/audit/mesh_source.hpp"
#include "barycert/core/simplex.hpp"

namespace barycert::audit {

struct Family {
    std::string name;
    std::string after;       ///< what it is after, one line
    std::string parameters;  ///< the recipe with its numbers
    bool needs_mesh = false;
    std::vector<Simplex> simplices;

    /// Fills `c` (its simplex is set, all else zero). `index` is the case's number.
    using Recipe = void (*)(Case& c, Random& random, std::uint64_t index);
    Recipe recipe = nullptr;

    using MeshRecipe = void (*)(Case& c, Random& random, const MeshSource& meshes);
    MeshRecipe mesh_recipe = nullptr;

    bool applies_to(Simplex s) const;
};

/// All families in a fixed order, those from meshes first.
const std::vector<Family>& all_families();

std::vector<Family> families_matching(std::string_view glob);

/// The case. Preconditions: family.applies_to(s); family.needs_mesh implies meshes.supplies(s).
Case make_case(const Family& family, Simplex s, std::uint64_t seed, std::uint64_t index, const MeshSource& meshes);

/// The parts of all_families(): from meshes, and built.
std::vector<Family> mesh_families();
std::vector<Family> near_families();
std::vector<Family> shape_families();
std::vector<Family> range_families();

}  // namespace barycert::audit
