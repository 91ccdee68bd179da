// OFF files: text, geometry alone.
#include <string>

#include "barycert/base/output_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/surface/surface_writers.hpp"

namespace barycert::io {

Result<SurfaceFile> write_off(const Surface& s, const std::string& path) {
    if (s.dimension == 2)
        return Error{.what = "an .off file holds polygons only",
                     .file = path,
                     .found = "segments in the plane",
                     .remedy = "choose .vtp or .ply"};
    SurfaceFile result;
    for (const auto* const fields : {&s.point_fields, &s.cell_fields}) {
        for (const Field& f : *fields) result.left_out.push_back(f.name);
    }
    base::OutputFile file(path);
    file.write("OFF\n" + std::to_string(s.point_count()) + ' ' + std::to_string(s.cell_count()) + " 0\n");
    for (std::size_t v = 0; v < s.points.size(); v += 3)
        file.write(base::shortest(s.points[v]) + ' ' + base::shortest(s.points[v + 1]) + ' ' +
                   base::shortest(s.points[v + 2]) + '\n');
    for (std::size_t c = 0; c < s.cells.size(); c += 3)
        file.write("3 " + std::to_string(s.cells[c]) + ' ' + std::to_string(s.cells[c + 1]) + ' ' +
                   std::to_string(s.cells[c + 2]) + '\n');
    if (Status written = file.commit(); !written) return written.error();
    return result;
}

}  // namespace barycert::io
