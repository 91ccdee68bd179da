#include "barycert/io/medit/medit_fields.hpp"

#include <algorithm>
#include <new>
#include <numeric>

#include "barycert/base/input_file.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/medit/read_medit.hpp"
#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert::io {
namespace {

/// Numbers a value of a field has: 1 is a scalar, 2 a vector, 3 a symmetric matrix, 4 any matrix.
std::size_t components_of(std::int64_t type, std::size_t dimension) {
    return type == 1 ? 1 : type == 2 ? dimension : type == 3 ? dimension * (dimension + 1) / 2 : dimension * dimension;
}

Status add_fields_of(const MeditFile& file, const MeditSection& section, std::vector<Field>& fields) {
    const auto dimension = static_cast<std::size_t>(file.dimension());
    std::size_t width = 0;
    for (const std::int64_t type : section.types) width += components_of(type, dimension);
    const Result<MeditRows> rows = file.rows(section, width, 0);
    if (!rows) return rows.error();
    for (std::size_t i = 0, begin = 0; i < section.types.size(); ++i) {
        const std::size_t components = components_of(section.types[i], dimension);
        Field field{"solution" + std::to_string(i), static_cast<int>(components), {}};
        field.data.resize(section.count * components);
        for (std::size_t row = 0; row < section.count; ++row)
            std::copy_n(&rows->reals[row * width + begin], components, &field.data[row * components]);
        fields.push_back(std::move(field));
        begin += components;
    }
    return Done{};
}

}  // namespace

Status add_medit_fields(const MeditFile& file, Mesh& mesh) {
    for (const MeditSection& section : file.sections()) {
        if (section.keyword.kind != MeditKind::solution) continue;
        const int of = section.keyword.dimension;
        if (of != 0 && of != mesh.dimension) {
            mesh.notes.push_back({Note::Kind::left_out, section.name + ": they are no cells of the mesh", file.path()});
            continue;
        }
        if (Status s = add_fields_of(file, section, of == 0 ? mesh.point_fields : mesh.cell_fields); !s) return s;
    }
    return Done{};
}

void note_medit_sections(const MeditFile& file, Notes& notes) {
    std::vector<std::string> names;
    for (const MeditSection& section : file.sections()) {
        const bool new_one = std::find(names.begin(), names.end(), section.name) == names.end();
        if (section.keyword.kind == MeditKind::other && new_one) names.push_back(section.name);
    }
    if (!names.empty()) notes.push_back({Note::Kind::left_out, "sections " + list_of(names), file.path()});
}

Result<Mesh> read_medit_fields(const std::string& path, int dimension) {
    const ExactEnvironment environment;
    try {
        const Result<MeditFile> file = MeditFile::open(path);
        if (!file) return file.error();
        Mesh mesh;
        mesh.dimension = dimension;
        if (Status s = add_medit_fields(*file, mesh); !s) return s.error();
        note_medit_sections(*file, mesh.notes);
        return mesh;
    } catch (const std::bad_alloc&) {
        return base::too_little_memory(path);
    }
}

}  // namespace barycert::io
