// VTK's PolyData files, see io/vti/appended.hpp.
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "barycert/base/output_file.hpp"
#include "barycert/io/surface/surface_writers.hpp"
#include "barycert/io/vti/appended.hpp"

namespace barycert::io {
namespace {

/// An array and the bytes of its numbers.
struct ArrayBytes {
    VtiArray array;
    std::span<const std::byte> bytes;
};

template <class T>
ArrayBytes array_of(std::string name, int components, VtiType type, const std::vector<T>& numbers) {
    return {{std::move(name), components, type}, std::as_bytes(std::span(numbers))};
}

/// Arrays below an element such as PointData.
struct Section {
    std::string element;
    std::vector<ArrayBytes> arrays;
};

std::vector<ArrayBytes> arrays_of(const std::vector<Field>& fields) {
    std::vector<ArrayBytes> all;
    all.reserve(fields.size() + 1);
    for (const Field& f : fields) all.push_back(array_of(f.name, f.components, VtiType::float64, f.data));
    return all;
}

Status check_names(const std::string& path, const std::vector<ArrayBytes>& arrays) {
    std::vector<VtiArray> own;
    own.reserve(arrays.size());
    for (const ArrayBytes& a : arrays) own.push_back(a.array);
    return check_arrays(path, own);
}

bool has_array(const std::vector<ArrayBytes>& arrays, std::string_view name) {
    for (const ArrayBytes& a : arrays) {
        if (a.array.name == name) return true;
    }
    return false;
}

std::string head_of(const Surface& s, const std::vector<Section>& sections) {
    const std::string cells = std::to_string(s.cell_count());
    const bool lines = s.dimension == 2;
    std::string text = vtk_file_head("PolyData") + "  <PolyData>\n    <Piece NumberOfPoints=\"" +
                       std::to_string(s.point_count()) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
                       (lines ? cells : "0") + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + (lines ? "0" : cells) +
                       "\">\n";
    std::uint64_t offset = 0;
    for (const Section& section : sections) {
        text += "      <" + section.element + ">\n";
        for (const ArrayBytes& a : section.arrays) {
            text += array_element(a.array, offset);
            offset += appended_header + a.bytes.size();
        }
        text += "      </" + section.element + ">\n";
    }
    return text + "    </Piece>\n  </PolyData>\n" + std::string(appended_begin);
}

void write_bytes(base::OutputFile& file, std::span<const std::byte> bytes) {
    char header[appended_header];
    const std::uint64_t size = bytes.size();
    std::memcpy(header, &size, appended_header);
    file.write({header, appended_header});
    file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// Coordinates in space: VTK knows no plane.
std::vector<double> in_space(const Surface& s) {
    if (s.dimension == 3) return {};
    std::vector<double> points;
    points.reserve(3 * s.point_count());
    for (std::size_t v = 0; v < s.point_count(); ++v)
        points.insert(points.end(), {s.points[2 * v], s.points[2 * v + 1], 0.0});
    return points;
}

}  // namespace

Result<SurfaceFile> write_vtp(const Surface& s, const std::string& path) {
    // VTK's own indices are 64 bits wide: it takes these as they are.
    const std::vector<std::int64_t> connectivity(s.cells.begin(), s.cells.end());
    std::vector<std::int64_t> offsets(s.cell_count());
    for (std::size_t c = 0; c < offsets.size(); ++c) offsets[c] = static_cast<std::int64_t>(s.corners() * (c + 1));
    const std::vector<double> flat = in_space(s);

    std::vector<ArrayBytes> of_points = arrays_of(s.point_fields), of_cells = arrays_of(s.cell_fields);
    if (!s.mesh_cells.empty() && !has_array(of_cells, "cell"))
        of_cells.push_back(array_of("cell", 1, VtiType::int32, s.mesh_cells));
    for (const auto* const arrays : {&of_points, &of_cells}) {
        if (Status good = check_names(path, *arrays); !good) return good.error();
    }
    const std::vector<Section> sections{
        {"PointData", std::move(of_points)},
        {"CellData", std::move(of_cells)},
        {"Points", {array_of("Points", 3, VtiType::float64, s.dimension == 2 ? flat : s.points)}},
        {s.dimension == 2 ? "Lines" : "Polys",
         {array_of("connectivity", 1, VtiType::int64, connectivity), array_of("offsets", 1, VtiType::int64, offsets)}}};
    base::OutputFile file(path);
    file.write(head_of(s, sections));
    for (const Section& section : sections) {
        for (const ArrayBytes& a : section.arrays) write_bytes(file, a.bytes);
    }
    file.write(appended_tail);
    if (Status written = file.commit(); !written) return written.error();
    return SurfaceFile{};
}

}  // namespace barycert::io
