// Answers of other systems, and of formulas under compiler flags: JSON for the page of an audit.
#include "barycert/audit_report.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(others) {
    static InputFile file("in.json");
    const Result<OtherResults> results = read_other_results(file.put(input));
    if (!results) return expect_useful(results.error(), lines_of(input));
    if (const auto* const matrix = std::get_if<FlagsMatrix>(&*results)) {
        for (const FlagsMatrix::KernelAnswers& row : matrix->rows)
            expect(row.cells.size() == matrix->columns.size(), "a row that does not fit the columns was read");
    }
}

}  // namespace barycert::fuzz
