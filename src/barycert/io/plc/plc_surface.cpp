/// Surface files as PLCs: .off, .stl (text and binary) and .ply (text).
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include "barycert/base/input_file.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/plc/plc_text.hpp"
#include "barycert/io/vtk/numbers.hpp"

namespace barycert::io {
namespace {

/// These formats number from 0. A file that never uses 0 and does use `nodes` numbers from 1.
void settle_index_base(PlcText& in, Plc& plc) {
    std::int32_t min = 1;
    std::int32_t max = 0;
    for (const PlcFacet& facet : plc.facets) {
        for (const std::int32_t id : facet.polygons[0]) {
            min = std::min(min, id);
            max = std::max(max, id);
        }
    }
    if (static_cast<std::size_t>(max) < plc.point_count()) return;
    if (min == 0) in.fail("no such node", "0 to " + std::to_string(plc.point_count() - 1), std::to_string(max));
    plc.index_base = 1;
    for (PlcFacet& facet : plc.facets) {
        for (std::int32_t& id : facet.polygons[0]) --id;
    }
}

/// A line for each polygon, up to the end of the file if `last`.
void read_polygons(PlcText& in, std::size_t count, std::size_t nodes, bool last, Plc& plc) {
    for (std::size_t i = 0; i < count; ++i) {
        in.need_line("polygon " + std::to_string(i) + " of " + std::to_string(count));
        const std::size_t n = in.take_count("the number of a polygon's corners");
        if (n < 3) in.fail("cannot read", "a polygon of three or more corners", std::to_string(n));
        std::vector<std::int32_t>& ring = plc.facets.emplace_back().polygons.emplace_back();
        for (std::size_t k = 0; k < n; ++k) {
            ring.push_back(in.take_integer("a polygon's corner"));
            // One more than the last is let through here: files that number from 1 exist.
            if (ring.back() < 0 || static_cast<std::size_t>(ring.back()) > nodes)
                in.fail("no such node", "0 to " + std::to_string(nodes - 1), std::to_string(ring.back()));
        }
    }
    if (last && in.next_line()) in.fail("more lines than the header announces", "the end of the file", in.line());
    settle_index_base(in, plc);
}

/// Corners of a triangle soup: corners with equal coordinates are one node.
class SoupBuilder {
public:
    void add(const std::array<double, 3>& corner) {
        // -0 and 0 are one place.
        const std::array<double, 3> key{corner[0] + 0.0, corner[1] + 0.0, corner[2] + 0.0};
        const auto [entry, fresh] = node_at_.try_emplace(key, static_cast<std::int32_t>(node_at_.size()));
        if (fresh) plc.points.insert(plc.points.end(), key.begin(), key.end());
        ring_.push_back(entry->second);
        if (ring_.size() < 3) return;
        plc.facets.push_back({.polygons = {ring_}, .holes = {}});
        ring_.clear();
    }
    bool whole() const { return ring_.empty(); }

    Plc plc;

private:
    std::map<std::array<double, 3>, std::int32_t> node_at_;
    std::vector<std::int32_t> ring_;
};

/// The number of 4 bytes at that place.
template <class T>
T little_endian(std::string_view bytes, std::size_t at) {
    return number_at<T>(bytes.data() + at, std::endian::native == std::endian::big);
}

constexpr std::size_t stl_header = 84;  // 80 bytes of text and a count
constexpr std::size_t stl_record = 50;  // normal and three corners as floats, two bytes of padding

/// Of a file of `size` bytes that begins so. Some binary files begin with `solid` too; a text file has no zero byte.
bool is_binary_stl(std::string_view bytes, std::size_t size, const std::string& path) {
    if (bytes.substr(0, 5) == "solid" && bytes.find('\0') == std::string_view::npos) return false;
    const std::size_t count = bytes.size() < stl_header ? 0 : little_endian<std::uint32_t>(bytes, 80);
    if (size >= stl_header && (size - stl_header) / stl_record == count && (size - stl_header) % stl_record == 0)
        return true;
    refuse_file(path, "neither a text nor a whole binary .stl",
                "`solid`, or " + std::to_string(stl_header + stl_record * count) + " bytes",
                std::to_string(size) + " bytes");
}

Plc read_binary_stl(const std::string& path, std::string_view bytes) {
    const std::size_t count = (bytes.size() - stl_header) / stl_record;
    SoupBuilder soup;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            std::array<double, 3> point{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::size_t at = stl_header + stl_record * i + 12 * (corner + 1) + 4 * axis;
                point[axis] = static_cast<double>(little_endian<float>(bytes, at));
                if (!std::isfinite(point[axis]))
                    refuse_file(path, "a coordinate of triangle " + std::to_string(i) + " is not finite");
            }
            soup.add(point);
        }
    }
    return std::move(soup.plc);
}

/// The number of nodes or polygons and where x, y, z stand, from the head of a .ply file.
struct PlyHeader {
    std::size_t nodes = 0, polygons = 0;
    std::array<std::optional<std::size_t>, 3> axis;
    std::size_t properties = 0;
};

PlyHeader read_ply_header(PlcText& in) {
    PlyHeader header;
    std::string element;
    bool text_format = false;
    in.need_line("ply");
    if (in.take("ply") != "ply") in.fail("cannot read", "ply", in.line());
    for (in.need_line("end_header"); in.word(0) != "end_header"; in.need_line("end_header")) {
        const std::string_view key = in.take("a keyword");
        if (key == "format") {
            const std::string_view format = in.take("ascii");
            if (format != "ascii") in.fail("cannot read a binary .ply", "ascii", format, text_ply_remedy(in.path()));
            text_format = true;
        } else if (key == "element") {
            element = in.take("an element's name");
            const std::size_t count = in.take_count("a count");
            if (element == "vertex" && header.polygons == 0) {
                header.nodes = count;
            } else if (element == "face" && header.nodes > 0) {
                header.polygons = count;
            } else if (header.polygons == 0) {
                in.fail("cannot read this order of elements", "vertex, face", in.line());
            }
        } else if (key == "property") {
            const std::string_view name = in.word(in.word_count() - 1);
            const bool list = in.take("a type") == "list";
            if (element == "vertex") {
                if (list) in.fail("cannot read a list at a vertex", "numbers", in.line());
                if (name == "x" || name == "y" || name == "z")
                    header.axis[static_cast<std::size_t>(name[0] - 'x')] = header.properties;
                ++header.properties;
            }
        }
    }
    if (!text_format) in.fail("cannot read", "format ascii 1.0");
    if (!header.axis[0] || !header.axis[1] || !header.axis[2]) in.fail("cannot read", "properties x, y and z");
    return header;
}

}  // namespace

Plc read_off(PlcText& in) {
    Plc plc;
    in.need_line("OFF");
    const std::string_view keyword = in.take("OFF");
    if (keyword != "OFF") in.fail("cannot read", "OFF", keyword);
    if (in.words_left() == 0) in.need_line("the counts of nodes and polygons");
    const std::size_t nodes = in.take_count("the number of nodes"), polygons = in.take_count("the number of polygons");
    for (std::size_t i = 0; i < nodes; ++i) {
        in.need_line("node " + std::to_string(i) + " of " + std::to_string(nodes));
        for (int axis = 0; axis < 3; ++axis) plc.points.push_back(in.take_number("a coordinate"));
        if (in.words_left() > 0) in.fail("cannot read", "three coordinates", in.line());
    }
    read_polygons(in, polygons, nodes, true, plc);
    return plc;
}

void check_stl_size(const std::string& path) {
    const Result<base::InputFile> file = base::InputFile::open(path);
    std::string block(base::first_block, '\0');
    const Result<std::size_t> size = file ? file->read_at(0, block, path) : Result<std::size_t>(std::size_t{0});
    if (file && size) is_binary_stl(std::string_view(block).substr(0, *size), file->size(), path);
}

Plc read_stl(PlcText& in) {
    const std::string_view bytes = in.rest();
    if (is_binary_stl(bytes, bytes.size(), in.path())) return read_binary_stl(in.path(), bytes);
    SoupBuilder soup;
    bool ended = false;
    while (in.next_line()) {
        ended = in.word(0) == "endsolid";
        if (in.word(0) != "vertex") continue;
        in.take("vertex");
        std::array<double, 3> corner{};
        for (double& x : corner) x = in.take_number("a coordinate");
        soup.add(corner);
    }
    if (!ended || !soup.whole()) in.fail("the file is truncated", "endsolid", "the end of the file");
    return std::move(soup.plc);
}

Plc read_ply(PlcText& in) {
    Plc plc;
    const PlyHeader header = read_ply_header(in);
    std::vector<double> row(header.properties);
    for (std::size_t i = 0; i < header.nodes; ++i) {
        in.need_line("node " + std::to_string(i) + " of " + std::to_string(header.nodes));
        for (double& value : row) value = in.take_number("a property of a node");
        for (const std::optional<std::size_t>& at : header.axis) plc.points.push_back(row[*at]);
    }
    read_polygons(in, header.polygons, header.nodes, false, plc);
    return plc;
}

}  // namespace barycert::io
