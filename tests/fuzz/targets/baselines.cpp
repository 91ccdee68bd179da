// Baselines: the JSON of an earlier audit.
#include "barycert/audit.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(baselines) {
    static InputFile file("in.json");
    const Result<Baseline> baseline = read_baseline(file.put(input));
    if (!baseline) return expect_useful(baseline.error(), lines_of(input));
    for (const BaselineEntry& entry : baseline->entries)
        expect(entry.figures.size() == baseline_figures().size(), "an entry without its figures was read");
}

}  // namespace barycert::fuzz
