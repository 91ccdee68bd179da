// Medit's files, text and binary: meshes, and fields alone. The first byte: which.
#include "io/medit/medit.hpp"

#include "tests/fuzz/files.hpp"
#include "tests/fuzz/same.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(medit) {
    static InputFile file("in.mesh");
    const unsigned how = input.empty() ? 0 : static_cast<unsigned char>(input.front());
    if (!input.empty()) input.remove_prefix(1);
    const std::string& path = file.put(input);
    if (how % 2 == 0) {
        const Result<Mesh> mesh = io::read_medit(path, {.faces = how % 4 == 0, .threads = 1});
        if (!mesh) return expect_useful(mesh.error(), lines_of(input));
        return expect_whole(*mesh);
    }
    const Result<Mesh> fields = io::read_medit_fields(path, how % 4 == 1 ? 3 : 2);
    if (!fields) return expect_useful(fields.error(), lines_of(input));
    for (const auto* all : {&fields->point_fields, &fields->cell_fields}) {
        for (const Field& field : *all)
            expect(field.data.size() % static_cast<std::size_t>(field.components) == 0, "half a row was read");
    }
}

}  // namespace barycert::fuzz
