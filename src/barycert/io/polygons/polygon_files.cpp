#include "barycert/io/polygons/polygons.hpp"
#include "barycert/io/vtk/numbers.hpp"

namespace barycert::io {
namespace {

constexpr std::size_t header_bytes = 84;  // 80 bytes of text and a count
constexpr std::size_t record_bytes = 50;  // normal and three corners as floats, two bytes of padding

/// Corners of a triangle soup: those of equal coordinates are one point. A table of open addresses.
class Joined {
public:
    explicit Joined(std::size_t corners) : table_(std::bit_ceil(std::max<std::size_t>(16, corners)), -1) {}

    void add(std::array<double, 3> at) {
        for (double& x : at) x += 0.0;  // -0 and 0 are one place
        if (2 * (count_ + 1) > table_.size()) grow();
        Mesh::Index& entry = find(at);
        if (entry < 0) {
            entry = static_cast<Mesh::Index>(count_++);
            all.points.insert(all.points.end(), at.begin(), at.end());
        }
        all.rings.push_back(entry);
    }

    Polygons all;

private:
    Mesh::Index& find(std::span<const double, 3> at) {
        std::uint64_t hash = 0;
        for (const double x : at)
            hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15, hash ^= hash >> 29;
        for (std::size_t i = hash & (table_.size() - 1);; i = (i + 1) & (table_.size() - 1)) {
            Mesh::Index& entry = table_[i];
            if (entry < 0 || std::equal(at.begin(), at.end(), &all.points[3 * static_cast<std::size_t>(entry)]))
                return entry;
        }
    }
    void grow() {
        table_.assign(2 * table_.size(), -1);
        for (std::size_t i = 0; i < count_; ++i)
            find(std::span<const double, 3>(&all.points[3 * i], 3)) = static_cast<Mesh::Index>(i);
    }

    std::vector<Mesh::Index> table_;
    std::size_t count_ = 0;  // of points
};

template <class T>
T little_endian(std::string_view bytes, std::size_t at) {
    return number_at<T>(bytes.data() + at, std::endian::native == std::endian::big);
}

/// Some binary files begin with `solid` too; a text file has no zero byte.
bool is_binary(std::string_view bytes, std::size_t size, const std::string& path) {
    if (bytes.starts_with("solid") && bytes.find('\0') == std::string_view::npos) return false;
    const std::size_t count = bytes.size() < header_bytes ? 0 : little_endian<std::uint32_t>(bytes, 80);
    const std::size_t whole = header_bytes + record_bytes * count;
    if (size == whole) return true;
    refuse_file(path, "neither a text nor a whole binary .stl", "`solid`, or " + std::to_string(whole) + " bytes",
                std::to_string(size) + " bytes");
}

Polygons read_binary(const std::string& path, std::string_view bytes) {
    const std::size_t count = (bytes.size() - header_bytes) / record_bytes;
    Joined soup(count);
    soup.all.rings.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            std::array<double, 3> at{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::size_t byte = header_bytes + record_bytes * i + 12 * (corner + 1) + 4 * axis;
                at[axis] = static_cast<double>(little_endian<float>(bytes, byte));
                if (!std::isfinite(at[axis]))
                    refuse_file(path, "a coordinate of triangle " + std::to_string(i) + " is not finite");
            }
            soup.add(at);
        }
    }
    return std::move(soup.all);
}

std::string nodes_of(std::size_t count) {
    return count == 0 ? "none, as there are no nodes" : "0 to " + std::to_string(count - 1);
}

/// Refuses corners that are no points; numbers from 1 become numbers from 0.
void check_corners(PlcText& in, Polygons& all) {
    if (all.rings.empty()) return;
    const auto [low, high] = std::ranges::minmax(all.rings);
    if (low >= 0 && static_cast<std::size_t>(high) < all.point_count()) return;
    // A file that never uses 0 and does use the count of its points numbers from 1.
    if (low < 1 || static_cast<std::size_t>(high) > all.point_count())
        in.fail("no such node", nodes_of(all.point_count()), std::to_string(low < 0 ? low : high));
    all.index_base = 1;
    for (Mesh::Index& corner : all.rings) --corner;
}

/// Text or binary. Corners of equal coordinates are one point, numbered as they first come.
Polygons read_stl(PlcText& in) {
    const std::string_view bytes = in.rest();
    if (is_binary(bytes, bytes.size(), in.path())) return read_binary(in.path(), bytes);
    Joined soup(1024);
    bool ended = false;
    std::size_t begin = 0;
    while (in.next_line()) {
        ended = in.word(0) == "endsolid";
        if (in.word(0) == "endloop" && soup.all.rings.size() - std::exchange(begin, soup.all.rings.size()) != 3)
            in.fail("cannot read", "a facet of three corners", in.line());
        if (in.word(0) != "vertex") continue;
        in.take("vertex");
        std::array<double, 3> corner{};
        for (double& x : corner) x = in.take_number("a coordinate");
        soup.add(corner);
    }
    if (!ended || soup.all.rings.size() % 3 != 0) in.fail("the file is truncated", "endsolid", "the end of the file");
    return std::move(soup.all);
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
            all.rings.push_back(in.take_integer("a polygon's corner"));
            if (const Mesh::Index corner = all.rings.back(); corner < 0 || static_cast<std::size_t>(corner) > nodes)
                in.fail("no such node", nodes_of(nodes), std::to_string(corner));
        }
        all.counts.push_back(static_cast<std::uint32_t>(n));
    }
    if (in.next_line()) in.fail("more lines than the header announces", "the end of the file", in.line());
    check_corners(in, all);
    return all;
}

/// Wavefront: lines `v x y z` and `f a b c ...`, corners from 1, or from the last point back, with more behind a slash.
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
                all.rings.push_back(static_cast<Mesh::Index>(at));
            }
            all.counts.push_back(static_cast<std::uint32_t>(n));
        } else if (std::ranges::find(others, key) == others.end()) {
            others.emplace_back(key);
        }
    }
    const std::string list = base::joined(others, " ", std::identity());
    if (!list.empty()) all.notes.push_back({Note::Kind::left_out, "lines other than v and f: " + list, in.path()});
    return all;
}

// PLY: G. Turk, "The PLY Polygon File Format", 1994.

struct Property {
    std::string name;
    NumberType type = NumberType::float64;
    std::optional<NumberType> count = {};  ///< of a list
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    enum class Form : std::uint8_t { text, little, big };
    std::optional<Form> form;
    std::vector<Element> elements;
};

NumberType take_type(PlcText& in) {
    // Of each NumberType; PLY has none of 64 bits but double.
    constexpr std::array<std::string_view, 11> types{
        "", "char int8", "uchar uint8",   "short int16",   "ushort uint16", "int int32", "uint uint32",
        "", "",          "float float32", "double float64"};
    const std::string_view name = in.take("a type");
    const auto is_it = [&](std::string_view names) { return has_word(names, name); };
    const auto* const found = std::ranges::find_if(types, is_it);
    if (found == types.end()) in.fail("cannot read", "a type of numbers, such as float", name);
    return static_cast<NumberType>(found - types.begin());
}

Header read_header(PlcText& in) {
    Header header;
    in.need_line("ply");
    if (in.take("ply") != "ply") in.fail("cannot read", "ply", in.line());
    for (in.need_line("end_header"); in.word(0) != "end_header"; in.need_line("end_header")) {
        const std::string_view key = in.take("a keyword");
        if (key == "format") {
            const std::string_view format = in.take("a format");
            if (format == "ascii") header.form = Header::Form::text;
            if (format == "binary_little_endian") header.form = Header::Form::little;
            if (format == "binary_big_endian") header.form = Header::Form::big;
            if (!header.form) in.fail("cannot read", "ascii, binary_little_endian or binary_big_endian", format);
        } else if (key == "element") {
            const std::string name(in.take("an element's name"));
            // Each takes a byte or more, but for those without properties.
            header.elements.push_back({name, in.take_count("a count"), {}});
        } else if (key == "property") {
            if (header.elements.empty()) in.fail("cannot read", "an element before its properties", in.line());
            Property property;
            if (in.word(1) == "list") {
                in.take("list");
                property.count = take_type(in);
                if (*property.count >= NumberType::float32)
                    in.fail("cannot read", "a count of whole numbers", in.line());
            }
            property.type = take_type(in);
            property.name = in.take("a property's name");
            header.elements.back().properties.push_back(std::move(property));
        }
    }
    if (!header.form) in.fail("cannot read", "format ascii 1.0, or a binary one");
    return header;
}

/// The numbers of the elements, one after the other, as doubles: all types are exact there.
class Numbers {
public:
    Numbers(PlcText& in, Header::Form form) : in_(in), form_(form) {
        if (form != Header::Form::text) bytes_ = in.rest();
    }

    void begin(const Element& element, std::size_t i) {
        if (form_ == Header::Form::text) in_.need_line(element.name, i, element.count);
    }
    double take(NumberType type, std::string_view what) {
        if (form_ == Header::Form::text) return in_.take_number(what, false);
        const bool swap = (form_ == Header::Form::big) != (std::endian::native == std::endian::big);
        return with_number_type(type, [&]<class T>() {
            if (bytes_.size() < sizeof(T)) in_.fail("the file is truncated", what, "the end of the file");
            const char* const at = bytes_.data();
            bytes_.remove_prefix(sizeof(T));
            return static_cast<double>(number_at<T>(at, swap));
        });
    }
    /// The corners of a list, or how many numbers it has.
    std::size_t take_list(const Property& list, std::vector<Mesh::Index>* corners) {
        const double count = take(*list.count, "the number of a polygon's corners");
        if (!(count >= 0 && count <= 1e9) || count != std::floor(count))
            in_.fail("cannot read", "the number of a polygon's corners", std::to_string(count));
        const auto n = static_cast<std::size_t>(count);
        for (std::size_t i = 0; i < n; ++i) {
            const double corner = take(list.type, "a polygon's corner");
            if (corners == nullptr) continue;
            if (!(corner >= 0 && corner <= INT32_MAX) || corner != std::floor(corner))
                in_.fail("no such node", "a number from 0", std::to_string(corner));
            corners->push_back(static_cast<Mesh::Index>(corner));
        }
        return n;
    }

private:
    PlcText& in_;
    Header::Form form_;
    std::string_view bytes_;
};

void read_vertices(PlcText& in, Numbers& numbers, const Element& element, Polygons& all) {
    std::vector<std::size_t> to;  // the axis; 3 and on: the fields
    for (const Property& property : element.properties) {
        if (property.count) in.fail("cannot read a list at a vertex", "numbers", property.name);
        const std::size_t axis = property.name.size() == 1 ? std::string_view("xyz").find(property.name[0]) : 3;
        to.push_back(axis < 3 ? axis : 3 + all.point_fields.size());
        if (axis >= 3) all.point_fields.push_back({property.name, 1, {}});
    }
    const auto has = [&](std::size_t axis) { return std::ranges::count(to, axis) != 0; };
    if (!has(0) || !has(1) || !has(2)) in.fail("cannot read", "properties x, y and z");
    for (std::size_t i = 0; i < element.count; ++i) {
        numbers.begin(element, i);
        std::array<double, 3> at{};
        for (std::size_t k = 0; k < to.size(); ++k) {
            const double x = numbers.take(element.properties[k].type, "a property of a node");
            (to[k] < 3 ? at[to[k]] : all.point_fields[to[k] - 3].data.emplace_back()) = x;
        }
        if (!std::ranges::all_of(at, [](double x) { return std::isfinite(x); }))
            in.fail("a coordinate of node " + std::to_string(i) + " is not finite");
        all.points.insert(all.points.end(), at.begin(), at.end());
    }
}

void read_faces(PlcText& in, Numbers& numbers, const Element& element, Polygons& all) {
    const auto is_corners = [](const Property& p) {
        return p.count && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    if (std::ranges::count_if(element.properties, is_corners) != 1)
        in.fail("cannot read faces", "a list vertex_indices", element.properties.empty() ? "none" : "others");
    for (const Property& property : element.properties) {
        if (!property.count) all.cell_fields.push_back({property.name, 1, {}});
        if (property.count && !is_corners(property))
            all.notes.push_back({Note::Kind::left_out, "a list of each face: " + property.name, in.path()});
    }
    for (std::size_t i = 0; i < element.count; ++i) {
        numbers.begin(element, i);
        std::size_t field = 0;
        for (const Property& property : element.properties) {
            if (!property.count) {
                all.cell_fields[field++].data.push_back(numbers.take(property.type, "a property of a face"));
                continue;
            }
            const std::size_t n = numbers.take_list(property, is_corners(property) ? &all.rings : nullptr);
            if (!is_corners(property)) continue;
            if (n < 3) in.fail("cannot read", "a polygon of three or more corners", std::to_string(n));
            all.counts.push_back(static_cast<std::uint32_t>(n));
        }
    }
}

/// Text or binary, with fields of points and polygons: properties that are numbers, but for coordinates.
Polygons read_ply(PlcText& in) {
    const Header header = read_header(in);
    Polygons all;
    Numbers numbers(in, *header.form);
    bool vertices = false;
    for (const Element& element : header.elements) {
        if (element.name == "vertex") {
            read_vertices(in, numbers, element, all);
            vertices = true;
        } else if (element.name == "face" && vertices) {
            read_faces(in, numbers, element, all);
        } else if (element.name == "face" || element.name == "tristrips") {
            in.fail("cannot read these elements", "vertex, then face", element.name);
        } else {
            for (std::size_t i = 0; i < element.count; ++i) {
                numbers.begin(element, i);
                for (const Property& property : element.properties) {
                    if (property.count) {
                        numbers.take_list(property, nullptr);
                    } else {
                        numbers.take(property.type, "a property");
                    }
                }
            }
            if (element.count != 0)
                all.notes.push_back(
                    {Note::Kind::left_out, std::to_string(element.count) + " elements " + element.name, in.path()});
        }
    }
    check_corners(in, all);
    return all;
}

}  // namespace

bool is_binary_surface(std::string_view path, std::string_view beginning, std::size_t size) {
    if (has_suffix(path, ".stl")) return is_binary(beginning, size, std::string(path));
    return has_suffix(path, ".ply") && beginning.substr(0, 200).find("\nformat binary") != std::string_view::npos;
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
