// OFF (Geomview) and OBJ (Wavefront).
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "io/number_word.hpp"
#include "io/polygons/polygons.hpp"

namespace barycert::io {
namespace {

/// Behind the corners: nothing, the number of a colour, or three or four shares of one. True: there is one.
bool take_colour(PlcText& in) {
    const std::size_t n = in.words_left();
    for (std::size_t k = 0; k < std::min<std::size_t>(n, 4); ++k) in.take_number("a colour behind a polygon's corners");
    in.need_end("the corners of a polygon, and at most the four numbers of a colour");
    if (n == 2)
        in.fail("file.syntax", "cannot read", "as many corners as the line says, or a colour of 1, 3 or 4 numbers",
                in.line());
    return n != 0;
}

/// A corner, as `1`, `1/2`, `1//3` or `1/2/3`: point, texture and normal, from 1, or from the last one back.
std::int64_t take_obj_corner(PlcText& in) {
    constexpr const char* expected = "a polygon's corner, an integer or up to three between slashes";
    const std::string_view word = in.take_numeric(expected);
    std::string_view rest = word;
    std::int64_t first = 0;
    for (int part = 0; part < 3; ++part) {
        const std::string_view digits = rest.substr(0, rest.find('/'));
        const std::optional<std::int32_t> id = integer_of_word<std::int32_t>(digits);
        if (!id && (part == 0 || !digits.empty())) in.fail("file.syntax", "cannot read", expected, word);
        if (part == 0) first = *id;
        if (digits.size() == rest.size()) return first;
        rest.remove_prefix(digits.size() + 1);
    }
    in.fail("file.syntax", "cannot read", expected, word);
}

}  // namespace

std::string nodes_of(std::size_t count) {
    return count == 0 ? "none, as there are no nodes" : "0 to " + std::to_string(count - 1);
}

void check_corners(PlcText& in, Polygons& all) {
    if (all.rings.empty()) return;
    const auto [low, high] = std::ranges::minmax(all.rings);
    if (low >= 0 && static_cast<std::size_t>(high) < all.point_count()) return;
    // A file that never uses 0 and does use the count of its points numbers from 1.
    if (low < 1 || static_cast<std::size_t>(high) > all.point_count())
        in.fail("mesh.node-index", "no such node", nodes_of(all.point_count()), std::to_string(low < 0 ? low : high));
    all.index_base = 1;
    for (Mesh::Index& corner : all.rings) --corner;
}

/// Shape of the file: OFF, the counts of points, polygons and edges, then a line for each point and each polygon.
/// A polygon's corners may go on over more lines: their count says how many are taken. Numbers behind them on the last
/// of these lines are a colour.
Polygons read_off(PlcText& in) {
    Polygons all;
    in.need_line("OFF");
    const std::string_view keyword = in.take("OFF");
    if (keyword != "OFF") in.fail("file.format", "cannot read", "OFF", keyword);
    if (in.words_left() == 0) in.need_line("the counts of nodes and polygons");
    const std::size_t nodes = in.take_count("the number of nodes"), polygons = in.take_count("the number of polygons");
    if (in.words_left() != 0) in.take_integer("the number of edges");
    in.need_end("the numbers of nodes, polygons and edges");
    for (std::size_t i = 0; i < nodes; ++i) {
        in.need_line("node", i, nodes);
        for (int axis = 0; axis < 3; ++axis) all.points.push_back(in.take_number("a coordinate"));
        in.need_end("three coordinates");
    }
    std::size_t colours = 0;
    std::optional<std::size_t> continued;  // the first polygon whose corners stand on more than one line
    for (std::size_t i = 0; i < polygons; ++i) {
        const std::string what = continued ? "polygon " + std::to_string(*continued) +
                                                 " takes corners from the line behind its own; then polygon"
                                           : "polygon";
        in.need_line(what, i, polygons);
        const std::size_t n = in.take_count("the number of a polygon's corners");
        if (n < 3) in.fail("file.syntax", "cannot read", "a polygon of three or more corners", std::to_string(n));
        for (std::size_t k = 0; k < n; ++k) {
            // Geomview reads words, wherever lines end. If a line lacks a corner instead, there are too few polygons.
            if (in.words_left() == 0) {
                in.need_line("corners of polygon", i, polygons);
                if (!continued) continued = i;
            }
            all.rings.push_back(in.take_integer("a polygon's corner"));
            if (const Mesh::Index corner = all.rings.back(); corner < 0 || static_cast<std::size_t>(corner) > nodes)
                in.fail("mesh.node-index", "no such node", nodes_of(nodes), std::to_string(corner));
        }
        all.counts.push_back(static_cast<std::uint32_t>(n));
        colours += take_colour(in) ? 1 : 0;
    }
    if (in.next_line()) in.fail("file.count", "more lines than the header announces", "the end of the file", in.line());
    if (colours != 0)
        all.notes.push_back({Note::Kind::left_out, "the colours of " + base::counted(colours, "polygon"), in.path()});
    check_corners(in, all);
    return all;
}

/// Lines `v x y z` and `f a b c ...`. Behind coordinates may stand a weight, a colour, or both.
Polygons read_obj(PlcText& in) {
    Polygons all;
    all.index_base = 1;
    std::vector<std::string> others;
    std::size_t more = 0;
    while (in.next_line()) {
        const std::string_view key = in.take("a keyword");
        const std::size_t n = in.words_left();
        if (key == "v") {
            for (std::size_t k = 0; k < std::max<std::size_t>(3, std::min<std::size_t>(n, 7)); ++k) {
                const double x = in.take_number(k < 3 ? "a coordinate" : "a weight or colour of a node", k < 3);
                if (k < 3) all.points.push_back(x);
            }
            in.need_end("v, three coordinates, and at most a weight and three shares of a colour");
            if (n == 5) in.fail("file.syntax", "cannot read", "v and 3 coordinates, or 4, 6 or 7 numbers", in.line());
            more += n > 3 ? 1 : 0;
        } else if (key == "f") {
            if (n < 3) in.fail("file.syntax", "cannot read", "a polygon of three or more corners", in.line());
            for (std::size_t k = 0; k < n; ++k) {
                const auto count = static_cast<std::int64_t>(all.point_count());
                const std::int64_t id = take_obj_corner(in), at = id < 0 ? count + id : id - 1;
                if (id == 0 || at < 0 || at >= count)
                    in.fail("mesh.node-index", "no such node", "1 to " + std::to_string(count), std::to_string(id));
                all.rings.push_back(static_cast<Mesh::Index>(at));
            }
            all.counts.push_back(static_cast<std::uint32_t>(n));
        } else if (std::ranges::find(others, key) == others.end()) {
            others.emplace_back(key);
        }
    }
    const std::string list = base::joined(others, " ", std::identity());
    if (!list.empty()) all.notes.push_back({Note::Kind::left_out, "lines other than v and f: " + list, in.path()});
    if (more != 0)
        all.notes.push_back({Note::Kind::left_out,
                             "weights or colours behind the coordinates of " + base::counted(more, "node"), in.path()});
    return all;
}

}  // namespace barycert::io
