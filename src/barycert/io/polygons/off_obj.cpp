#include "barycert/io/formats.hpp"
#include "barycert/io/polygons/polygons.hpp"

namespace barycert::io {

void check_corners(PlcText& in, Polygons& all) {
    if (all.corners.empty()) return;
    const auto [low, high] = std::ranges::minmax(all.corners);
    if (low >= 0 && static_cast<std::size_t>(high) < all.point_count()) return;
    // A file that never uses 0 and does use the count of its points numbers from 1.
    if (low < 1 || static_cast<std::size_t>(high) > all.point_count())
        in.fail("no such node", "0 to " + std::to_string(all.point_count() - 1), std::to_string(low < 0 ? low : high));
    all.index_base = 1;
    for (Mesh::Index& corner : all.corners) --corner;
}

/// Shape of the file: OFF, the counts of points, polygons and edges, then a line for each point and each polygon.
Polygons read_off(PlcText& in) {
    Polygons all;
    in.need_line("OFF");
    const std::string_view keyword = in.take("OFF");
    if (keyword != "OFF") in.fail("cannot read", "OFF", keyword);
    if (in.words_left() == 0) in.need_line("the counts of nodes and polygons");
    const std::size_t nodes = in.take_count("the number of nodes"), polygons = in.take_count("the number of polygons");
    for (std::size_t i = 0; i < nodes; ++i) {
        in.need_line("node", i, nodes);
        for (int axis = 0; axis < 3; ++axis) all.points.push_back(in.take_number("a coordinate"));
        if (in.words_left() > 0) in.fail("cannot read", "three coordinates", in.line());
    }
    for (std::size_t i = 0; i < polygons; ++i) {
        in.need_line("polygon", i, polygons);
        const std::size_t n = in.take_count("the number of a polygon's corners");
        if (n < 3) in.fail("cannot read", "a polygon of three or more corners", std::to_string(n));
        for (std::size_t k = 0; k < n; ++k) {
            all.corners.push_back(in.take_integer("a polygon's corner"));
            if (const Mesh::Index corner = all.corners.back(); corner < 0 || static_cast<std::size_t>(corner) > nodes)
                in.fail("no such node", "0 to " + std::to_string(nodes - 1), std::to_string(corner));
        }
        all.counts.push_back(static_cast<std::uint32_t>(n));
    }
    if (in.next_line()) in.fail("more lines than the header announces", "the end of the file", in.line());
    check_corners(in, all);
    return all;
}

/// Wavefront's format: lines `v x y z` and `f a b c ...`, where a corner is a number from 1, or from the last point
/// back if it is negative, with more behind a slash. All else is passed over.
Polygons read_obj(PlcText& in) {
    Polygons all;
    all.index_base = 1;
    std::vector<std::string> others;
    while (in.next_line()) {
        const std::string_view key = in.take("a keyword");
        if (key == "v") {
            for (int axis = 0; axis < 3; ++axis) all.points.push_back(in.take_number("a coordinate"));
        } else if (key == "f") {
            const std::size_t n = in.words_left();
            if (n < 3) in.fail("cannot read", "a polygon of three or more corners", in.line());
            for (std::size_t k = 0; k < n; ++k) {
                const auto count = static_cast<std::int64_t>(all.point_count());
                const std::int64_t id = in.take_integer("a polygon's corner", '/');
                const std::int64_t at = id < 0 ? count + id : id - 1;
                if (id == 0 || at < 0 || at >= count)
                    in.fail("no such node", "1 to " + std::to_string(count), std::to_string(id));
                all.corners.push_back(static_cast<Mesh::Index>(at));
            }
            all.counts.push_back(static_cast<std::uint32_t>(n));
        } else if (std::ranges::find(others, key) == others.end()) {
            others.emplace_back(key);
        }
    }
    if (!others.empty()) {
        std::string list;
        for (const std::string& key : others) list += (list.empty() ? "" : " ") + key;
        all.notes.push_back({Note::Kind::left_out, "lines other than v and f: " + list, in.path()});
    }
    return all;
}

Polygons read_polygons(const std::string& path) {
    const auto read = [&](PlcText& in) {
        return has_suffix(path, ".off")   ? read_off(in)
               : has_suffix(path, ".obj") ? read_obj(in)
               : has_suffix(path, ".stl") ? read_stl(in)
                                          : read_ply(in);
    };
    const std::string text = read_surface_text(path, read);
    PlcText in(path, text, text.size());
    Polygons all = read(in);
    if (std::ranges::all_of(all.counts, [](std::uint32_t n) { return n == 3; })) all.counts.clear();
    return all;
}

}  // namespace barycert::io
