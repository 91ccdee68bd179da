#include "app/jobs/mesh_sink.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/job_files.hpp"
#include "app/jobs/stream.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "core/base/finite.hpp"
#include "core/base/text.hpp"
#include "io/mesh_format.hpp"
#include "io/mesh_notes.hpp"

namespace barycert::jobs {
namespace {

/// The other mesh, and what was sampled at its nodes besides its fields.
struct SampledNodes {
    Mesh mesh;
    Field mask{"vtkValidPointMask", 1, {}}, cell{"cell", 1, {}}, distance{"distance", 1, {}};
};

Status write_tetgen_files(const Mesh& mesh, const std::string& path) {
    for (const Field& f : mesh.point_fields) {
        const std::size_t bad = base::first_not_finite(f.data), node = bad / static_cast<std::size_t>(f.components);
        if (bad == f.data.size()) continue;
        return about(
            "job.outside",
            file_error("field.not-finite", path,
                       fmt::format("field \"{}\" is not finite at node {}, counted from 0", f.name, node),
                       "finite attributes: a .node file cannot hold NaN or infinity", "",
                       "choose job.outside nearest, extrapolate or fill=V for nodes outside, or another format"));
    }
    return write_tetgen(mesh, tetgen_stem(path));
}

}  // namespace

Sink mesh_sink(Mesh mesh, const std::string& path, const TableFormat& format, Notes& notes) {
    if (!format.carried.empty())
        refuse_member("field.type", "job.fields", path, "a mesh has no labels of nodes", "fields",
                      "label " + base::quoted(format.carried.front().name),
                      "leave labels out of job.fields, or write rows: .csv or .npy");
    const io::MeshFormat kind = io::mesh_output_format(path).value();
    if (kind == io::MeshFormat::tetgen) io::note_lost_names(format.columns(), "a .node", notes);
    mesh.point_fields.clear();
    for (const TableField& f : format.fields) mesh.point_fields.push_back({f.name, f.components, {}});
    const auto of = std::make_shared<SampledNodes>();
    of->mesh = std::move(mesh);
    const auto write = [of](const TableView& rows) -> Status {
        append_rows(rows, of->mesh.point_fields);
        for (const Mesh::Index cell : rows.cells) {
            of->mask.data.push_back(cell >= 0 ? 1 : 0);
            of->cell.data.push_back(cell);
        }
        of->distance.data.insert(of->distance.data.end(), rows.distances.begin(), rows.distances.end());
        return Done{};
    };
    return sink_of(write, [of, path, kind, data = format.vtk_data]() -> Status {
        if (kind == io::MeshFormat::tetgen) return write_tetgen_files(of->mesh, path);
        // Where there is room for what else is known of nodes. Gmsh draws each field: there `cell` stands for the mask.
        std::vector<Field>& fields = of->mesh.point_fields;
        if (!of->distance.data.empty()) fields.push_back(std::move(of->distance));
        if (kind == io::MeshFormat::vtk) fields.push_back(std::move(of->mask));
        fields.push_back(std::move(of->cell));
        return write_mesh(of->mesh, path, {.comment = {}, .data = data});
    });
}

}  // namespace barycert::jobs
