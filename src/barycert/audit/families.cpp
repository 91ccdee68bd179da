#include "barycert/audit.hpp"
#include "barycert/audit/mesh_draws.hpp"
#include "barycert/audit/recipes.hpp"
#include "barycert/base/random.hpp"

#include <algorithm>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"

namespace barycert {

using namespace audit;

bool Family::applies_to(Simplex s) const {
    return std::find(simplices.begin(), simplices.end(), s) != simplices.end();
}

const std::vector<Family>& all_families() {
    static const std::vector<Family> families = [] {
        std::vector<Family> all = mesh_families();
        for (auto* part : {near_families, shape_families, range_families, raster_families, perspective_families}) {
            for (Family& f : part()) all.push_back(std::move(f));
        }
        return all;
    }();
    return families;
}

std::vector<Family> families_matching(std::string_view glob) {
    std::vector<Family> matching;
    for (const Family& f : all_families()) {
        if (base::glob_match(glob, f.name)) matching.push_back(f);
    }
    return matching;
}

Case make_case(const Family& family, Simplex s, std::uint64_t seed, std::uint64_t index, const MeshSource& meshes,
               CaseOrigin* origin) {
    const ExactEnvironment environment;
    const std::uint64_t stream = base::hash64(family.name) + static_cast<std::uint64_t>(s);
    base::Random random = base::Random::stream(seed, stream, index);
    Case c;
    c.simplex = s;
    c.perspective = family.perspective;
    if (family.needs_mesh) {
        const Draw draw = family.mesh_recipe(random, meshes, s);
        c = draw.simplex;
        keep_finite(c.point);
        if (origin != nullptr) *origin = {draw.from->name, draw.from->mesh.cell_number(draw.cell)};
    } else {
        family.recipe(c, random, index);
    }
    return c;
}

}  // namespace barycert
