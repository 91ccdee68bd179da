// Rules of --fail-on.
#include <cmath>

#include "barycert/audit.hpp"
#include "barycert/jobs.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(rules) {
    const Result<Threshold> threshold = parse_threshold(input);
    if (threshold) expect(!std::isnan(threshold->limit), "a limit that nothing exceeds");
    const Result<VerifyLimit> limit = parse_verify_limit(input);
    for (const Error* const error : {threshold ? nullptr : &threshold.error(), limit ? nullptr : &limit.error()})
        expect(error == nullptr || !error->what.empty(), "an error that does not say what");
}

}  // namespace barycert::fuzz
