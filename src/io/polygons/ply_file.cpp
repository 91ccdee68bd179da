// PLY, text and binary: G. Turk, "The PLY Polygon File Format", 1994.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "io/polygons/polygons.hpp"
#include "io/vtk/numbers.hpp"
#include "io/words.hpp"

namespace barycert::io {
namespace {

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
    // Names of each NumberType; PLY has none of 64 bits but double.
    constexpr std::array<std::string_view, 11> types{
        "", "char int8", "uchar uint8",   "short int16",   "ushort uint16", "int int32", "uint uint32",
        "", "",          "float float32", "double float64"};
    const std::string_view name = in.take("a type");
    const auto is_it = [&](std::string_view names) { return has_word(names, name); };
    const auto* const found = std::ranges::find_if(types, is_it);
    if (found == types.end()) in.fail("file.syntax", "cannot read", "a type of numbers, such as float", name);
    return static_cast<NumberType>(found - types.begin());
}

void take_format(PlcText& in, Header& header) {
    constexpr std::array<std::string_view, 3> forms{"ascii", "binary_little_endian", "binary_big_endian"};
    const std::string_view format = in.take("a format");
    const auto* const found = std::ranges::find(forms, format);
    if (found == forms.end())
        in.fail("file.syntax", "cannot read", "ascii, binary_little_endian or binary_big_endian", format);
    header.form = static_cast<Header::Form>(found - forms.begin());
    const std::string_view version = in.take("version 1.0");
    if (version != "1.0") in.fail("file.version", "unknown version of the format", "1.0", version);
    in.need_end("format, its name and version 1.0");
}

Property take_property(PlcText& in) {
    Property property;
    if (in.word(1) == "list") {
        in.take("list");
        property.count = take_type(in);
        if (*property.count >= NumberType::float32)
            in.fail("file.syntax", "cannot read", "a count of whole numbers", in.line());
    }
    property.type = take_type(in);
    property.name = in.take("a property's name");
    in.need_end("property, its type and name");
    return property;
}

Header read_header(PlcText& in) {
    Header header;
    in.need_line("ply");
    if (in.take("ply") != "ply") in.fail("file.format", "cannot read", "ply", in.line());
    in.need_end("ply");
    for (in.need_line("end_header"); in.word(0) != "end_header"; in.need_line("end_header")) {
        const std::string_view key = in.take("a keyword");
        if (key == "format") {
            take_format(in, header);
        } else if (key == "element") {
            const std::string name(in.take("an element's name"));
            // Each takes a byte or more, but for those without properties.
            header.elements.push_back({name, in.take_count("a count"), {}});
            in.need_end("element, its name and count");
        } else if (key == "property") {
            if (header.elements.empty())
                in.fail("file.syntax", "cannot read", "an element before its properties", in.line());
            header.elements.back().properties.push_back(take_property(in));
        } else if (key != "comment" && key != "obj_info") {
            in.fail("file.syntax", "cannot read", "format, element, property, comment, obj_info or end_header",
                    in.line());
        }
    }
    if (!header.form) in.fail("file.syntax", "cannot read", "format ascii 1.0, or a binary one");
    in.take("end_header");
    in.need_end("end_header");
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
        if (form_ == Header::Form::text) return take_word(type, what);
        const bool swap = (form_ == Header::Form::big) != (std::endian::native == std::endian::big);
        return with_number_type(type, [&]<class T>() {
            if (bytes_.size() < sizeof(T))
                in_.fail("file.truncated", "the file is truncated", what, "the end of the file");
            const char* const at = bytes_.data();
            bytes_.remove_prefix(sizeof(T));
            return static_cast<double>(number_at<T>(at, swap));
        });
    }
    void end(const Element& element) {
        if (form_ == Header::Form::text) in_.need_end("the properties of " + element.name + ", as the header has them");
    }
    /// Behind the last element there is no other. Bytes are told, where there are some.
    void end_all(Notes& notes) {
        if (form_ == Header::Form::text && in_.next_line())
            in_.fail("file.count", "more lines than the header announces", "the end of the file", in_.line());
        if (!bytes_.empty())
            notes.push_back({Note::Kind::left_out,
                             std::to_string(bytes_.size()) + " bytes behind the elements that the header announces",
                             in_.path(), true});
    }
    /// The corners of a list, or how many numbers it has.
    std::size_t take_list(const Property& list, std::vector<Mesh::Index>* corners) {
        const double count = take(*list.count, "the number of a polygon's corners");
        if (!(count >= 0 && count <= 1e9) || count != std::floor(count))
            in_.fail("file.syntax", "cannot read", "the number of a polygon's corners", std::to_string(count));
        const auto n = static_cast<std::size_t>(count);
        for (std::size_t i = 0; i < n; ++i) {
            const double corner = take(list.type, "a polygon's corner");
            if (corners == nullptr) continue;
            if (!(corner >= 0 && corner <= INT32_MAX) || corner != std::floor(corner))
                in_.fail("mesh.node-index", "no such node", "a number from 0", std::to_string(corner));
            corners->push_back(static_cast<Mesh::Index>(corner));
        }
        return n;
    }

private:
    double take_word(NumberType type, std::string_view what) {
        const double x = in_.take_number(what, false);
        const bool fits = type >= NumberType::float32 || with_number_type(type, [&]<class T>() {
                              T value{};
                              return convert_number(x, value);
                          });
        if (!fits)
            in_.fail("file.number", "cannot read", std::string(what) + ", a number of its type in the header",
                     base::shortest(x));
        return x;
    }

    PlcText& in_;
    Header::Form form_;
    std::string_view bytes_;
};

void read_vertices(PlcText& in, Numbers& numbers, const Element& element, Polygons& all) {
    std::vector<std::size_t> to;  // the axis; 3 and on: the fields
    for (const Property& property : element.properties) {
        if (property.count) in.fail("file.unsupported", "cannot read a list at a vertex", "numbers", property.name);
        const std::size_t axis = property.name.size() == 1 ? std::string_view("xyz").find(property.name[0]) : 3;
        to.push_back(axis < 3 ? axis : 3 + all.point_fields.size());
        if (axis >= 3) all.point_fields.push_back({property.name, 1, {}});
    }
    const auto has = [&](std::size_t axis) { return std::ranges::count(to, axis) != 0; };
    if (!has(0) || !has(1) || !has(2)) in.fail("file.syntax", "cannot read", "properties x, y and z");
    for (std::size_t i = 0; i < element.count; ++i) {
        numbers.begin(element, i);
        std::array<double, 3> at{};
        for (std::size_t k = 0; k < to.size(); ++k) {
            const double x = numbers.take(element.properties[k].type, "a property of a node");
            (to[k] < 3 ? at[to[k]] : all.point_fields[to[k] - 3].data.emplace_back()) = x;
        }
        if (!std::ranges::all_of(at, [](double x) { return std::isfinite(x); }))
            in.fail("mesh.coordinate", "a coordinate of node " + std::to_string(i) + " is not finite");
        all.points.insert(all.points.end(), at.begin(), at.end());
        numbers.end(element);
    }
}

void read_faces(PlcText& in, Numbers& numbers, const Element& element, Polygons& all) {
    const auto is_corners = [](const Property& p) {
        return p.count && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    if (std::ranges::count_if(element.properties, is_corners) != 1)
        in.fail("mesh.faces", "cannot read faces", "a list vertex_indices",
                element.properties.empty() ? "none" : "others");
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
            if (n < 3) in.fail("file.syntax", "cannot read", "a polygon of three or more corners", std::to_string(n));
            all.counts.push_back(static_cast<std::uint32_t>(n));
        }
        numbers.end(element);
    }
}

}  // namespace

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
            in.fail("file.unsupported", "cannot read these elements", "vertex, then face", element.name);
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
                numbers.end(element);
            }
            if (element.count != 0)
                all.notes.push_back(
                    {Note::Kind::left_out, std::to_string(element.count) + " elements " + element.name, in.path()});
        }
    }
    numbers.end_all(all.notes);
    check_corners(in, all);
    return all;
}

}  // namespace barycert::io
