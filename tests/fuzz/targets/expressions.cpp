// Names of fields and of what is made of them, a line each: NAME.x, |NAME|, grad(NAME), mean(NAME), cell:NAME.
#include <span>
#include <string>
#include <vector>

#include "barycert/sampler.hpp"
#include "tests/fuzz/small_meshes.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(expressions) {
    static const Result<Locator> locator = Locator::build(small_mesh(3), {.threads = 1});
    const Mesh& mesh = small_mesh(3);
    std::vector<std::string> names;
    for (std::string_view rest = input; !rest.empty() && names.size() < 16;) {
        const std::size_t end = rest.find('\n');
        names.emplace_back(rest.substr(0, end));
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    const Result<std::vector<FieldChoice>> chosen = choose_fields(mesh, names);
    if (!chosen) return expect(!chosen.error().what.empty(), "an error that does not say what");
    const Result<Sampler> sampler = Sampler::build(*locator, *chosen);
    if (!sampler) return expect(!sampler.error().what.empty(), "an error that does not say what");
    const std::vector<double> points{0.25, 0.25, 0.25, 0.5, 0.5, 0.5, 9, 9, 9};
    const Result<Table> rows = sampler->sample(points, {.threads = 1});
    expect(bool(rows) && rows->row_count() == 3 && rows->values.size() == 3 * sampler->columns().size(),
           "fields that were chosen are not sampled");
}

}  // namespace barycert::fuzz
