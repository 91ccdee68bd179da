// Fields in files of their own: text, CSV, NPY. The first byte: which, and the column.
#include <array>

#include "io/fields/field_file.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(fields) {
    static InputFile text("in.txt"), npy("in.npy");
    const unsigned how = input.empty() ? 0 : static_cast<unsigned char>(input.front());
    if (!input.empty()) input.remove_prefix(1);
    const std::string column = std::array<const char*, 4>{"", "T", "2", "v.1"}[how / 2 % 4];
    InputFile& file = how % 2 == 0 ? text : npy;
    Notes notes;
    const Result<Field> field = io::read_field_file("T", file.put(input), column, notes);
    if (!field) return expect_useful(field.error(), lines_of(input));
    expect(field->components > 0, "a field without components was read");
    expect(field->data.size() % static_cast<std::size_t>(field->components) == 0, "half a row was read");
}

}  // namespace barycert::fuzz
