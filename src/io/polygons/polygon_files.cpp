// Polygons from their files, by the ends of their names.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "files/format.hpp"
#include "io/paths.hpp"
#include "io/polygons/polygons.hpp"

namespace barycert::io {

bool is_binary_surface(std::string_view path, std::string_view beginning, std::size_t size) {
    const FormatKind kind = base::kind_of(path);
    if (kind == FormatKind::stl) return is_binary_stl(beginning, size, std::string(path));
    return kind == FormatKind::ply && beginning.substr(0, 200).find("\nformat binary") != std::string_view::npos;
}

Polygons read_polygons(const std::string& path) {
    const FormatKind kind = base::kind_of(path);
    const auto read = [&](PlcText& in) {
        return kind == FormatKind::off   ? read_off(in)
               : kind == FormatKind::obj ? read_obj(in)
               : kind == FormatKind::stl ? read_stl(in)
                                         : read_ply(in);
    };
    const Separators separators = kind == FormatKind::stl ? Separators::blanks_alone : Separators::blanks;
    const std::string text = read_surface_text(path, separators, read);
    PlcText in(path, text, text.size(), separators);
    Polygons all = read(in);
    in.note_last_number(all.notes);
    if (std::ranges::all_of(all.counts, [](std::uint32_t n) { return n == 3; })) all.counts.clear();
    return all;
}

}  // namespace barycert::io
