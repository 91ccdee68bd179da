#include "barycert/io/vtk/legacy_arrays.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace barycert::io {

Status LegacyArrays::read_attributes(const std::string& keyword, std::size_t expected) {
    const bool of_points = keyword == "POINT_DATA";
    const Result<std::size_t> rows = text_.count("the rows of " + keyword);
    if (!rows) return rows.error();
    if (*rows != expected) {
        return text_.error("the rows of " + keyword,
                           std::to_string(expected) + (of_points ? ", one a point" : ", one a cell"),
                           std::to_string(*rows));
    }
    std::vector<RawArray>& arrays = of_points ? grid_.point_arrays : grid_.cell_arrays;
    while (true) {
        const LegacyText before = text_;
        const std::string kind = text_.keyword();
        if (kind.empty()) return Done{};
        if (kind == "POINT_DATA" || kind == "CELL_DATA") {
            text_ = before;
            return Done{};
        }
        if (Status s = read_attribute(kind, *rows, arrays); !s) return s;
    }
}

Status LegacyArrays::read_attribute(const std::string& kind, std::size_t rows, std::vector<RawArray>& arrays) {
    if (kind == "METADATA") return text_.skip_metadata();
    if (kind == "FIELD") return read_field_arrays(&arrays, rows);
    const std::string name = text_.name();
    if (kind == "LOOKUP_TABLE") {
        const Result<std::size_t> size = text_.count("the size of a lookup table");
        return size ? text_.skip_colors(std::uint64_t{4} * *size) : Status(size.error());
    }
    if (kind == "COLOR_SCALARS") {
        const Result<std::size_t> components = text_.count("the components of array " + in_quotes(name));
        return components ? read_colors(name, *components, rows, arrays) : Status(components.error());
    }
    std::size_t components = 0;
    if (kind == "TEXTURE_COORDINATES") {
        const Result<std::size_t> found = text_.count("the components of array " + in_quotes(name));
        if (!found) return found.error();
        components = *found;
    } else {
        constexpr std::array<std::pair<const char*, std::size_t>, 8> kinds{{{"SCALARS", 1},
                                                                            {"VECTORS", 3},
                                                                            {"NORMALS", 3},
                                                                            {"TENSORS", 9},
                                                                            {"TENSORS6", 6},
                                                                            {"GLOBAL_IDS", 1},
                                                                            {"PEDIGREE_IDS", 1},
                                                                            {"EDGE_FLAGS", 1}}};
        for (const auto& [known, count] : kinds) {
            if (kind == known) components = count;
        }
        if (components == 0) {
            return text_.error("a kind of array", "SCALARS, VECTORS, FIELD and the like", in_quotes(kind),
                               "the data before it may be cut off, or more than was announced");
        }
    }
    const std::string type = text_.word();
    if (kind == "SCALARS") {
        // The number of components may be left out; the line of the lookup table may be, too.
        if (const std::optional<std::uint64_t> count = parse_count(text_.rest_of_line()); count.has_value()) {
            components = static_cast<std::size_t>(std::min(*count, max_entities + 1));
        }
        const LegacyText before = text_;
        if (text_.keyword() == "LOOKUP_TABLE") {
            text_.name();
        } else {
            text_ = before;
        }
    }
    return read_array(name, type, components, rows, arrays);
}

/// `arrays` of nullptr: field data, which belong to neither points nor cells.
Status LegacyArrays::read_field_arrays(std::vector<RawArray>* arrays, std::size_t rows) {
    text_.name();
    const Result<std::size_t> count = text_.count("the number of arrays");
    if (!count) return count.error();
    std::vector<RawArray> unused;
    for (std::size_t i = 0; i < *count; ++i) {
        std::string name = text_.name();
        while (name == "METADATA") {
            if (Status s = text_.skip_metadata(); !s) return s;
            name = text_.name();
        }
        if (name == "NULL_ARRAY") continue;
        const Result<std::size_t> components = text_.count("the components of array " + in_quotes(name));
        if (!components) return components.error();
        const Result<std::size_t> tuples = text_.count("the rows of array " + in_quotes(name));
        if (!tuples) return tuples.error();
        if (arrays != nullptr && *tuples != rows) {
            return text_.error("the rows of array " + in_quotes(name), std::to_string(rows), std::to_string(*tuples));
        }
        const std::string type = text_.word();
        if (Status s = read_array(name, type, *components, *tuples, arrays != nullptr ? *arrays : unused); !s) {
            return s;
        }
        if (!unused.empty() && !is_time(name)) grid_.loose_arrays.push_back(name);
        unused.clear();
    }
    return Done{};
}

/// Of cells; of points, where no mesh has to carry them.
bool LegacyArrays::may_label(const std::vector<RawArray>& arrays) const {
    return &arrays == &grid_.cell_arrays || (&arrays == &grid_.point_arrays && part_ == Part::point_arrays);
}

Status LegacyArrays::read_array(const std::string& name, const std::string& type, std::size_t components,
                                std::size_t rows, std::vector<RawArray>& arrays) {
    const std::string what = "array " + in_quotes(name);
    if (components == 0 && rows != 0 && &arrays != &grid_.point_arrays && &arrays != &grid_.cell_arrays) components = 1;
    if (components == 0 || components > max_entities) {
        return text_.error("the components of " + what, "1 or more", std::to_string(components));
    }
    if (Status s = must_be_new(name, arrays); !s) return s;
    RawArray array;
    array.field = {name, static_cast<int>(components), {}};
    const std::uint64_t numbers = static_cast<std::uint64_t>(components) * rows;
    if (LegacyText::is_text(type)) {
        const bool label = may_label(arrays);
        std::vector<std::string> texts;
        if (Status s = text_.strings(what, type, numbers, label && components == 1 ? &texts : nullptr); !s) return s;
        array.has_labels = label && components == 1;
        array.labels = std::move(texts);
        if (!array.has_labels)
            array.fault =
                label ? "it holds texts of several components" : "it holds text, which points of a mesh cannot carry";
    } else {
        const std::optional<NumberType> known = LegacyText::number_type_named(type);
        if (known == NumberType::bit && components > 1 && text_.binary()) {
            // VTK writes, and reads back, as many bits as there are rows.
            std::vector<double> part;
            array.fault = "VTK writes only the first bits of such an array";
            if (Status s = text_.numbers(what, *known, rows, part); !s) return s;
            arrays.push_back(std::move(array));
            return Done{};
        }
        if (!known.has_value()) {
            return text_.error("the type of " + what, "double, float, int and the like", in_quotes(type));
        }
        if (Status s = read_numbers(what, *known, numbers, arrays, array); !s) return s;
    }
    arrays.push_back(std::move(array));
    return Done{};
}

Status LegacyArrays::read_numbers(const std::string& what, NumberType type, std::uint64_t numbers,
                                  const std::vector<RawArray>& arrays, RawArray& array) {
    array.is_narrow = type == NumberType::float32;
    array.is_integer = type == NumberType::int64 || type == NumberType::uint64;
    const bool markers = &arrays == &grid_.point_arrays && array.field.name == marker_name &&
                         type == NumberType::int64 && array.field.components == 1;
    array.is_whole = type != NumberType::float32 && type != NumberType::float64;
    const bool label = may_label(arrays) && array.is_integer && array.field.components == 1;
    const LegacyText before = text_;
    NumberFault fault;
    if (!markers) {
        if (Status s = text_.numbers(what, type, numbers, array.field.data, &fault); !s) return s;
        if (!fault) return Done{};
        array.field.data = {};
        array.fault = inexact(fault);
        if (!label) return Done{};
        text_ = before;
    }
    std::vector<std::int64_t> labels;
    NumberFault wide;
    if (Status s = text_.numbers(what, type, numbers, labels, &wide); !s) return s;
    if (wide) return Done{};
    array.fault.clear();
    array.labels = std::move(labels);
    array.has_labels = true;
    return Done{};
}

Status LegacyArrays::read_colors(const std::string& name, std::size_t components, std::size_t rows,
                                 std::vector<RawArray>& arrays) {
    if (components == 0 || components > max_entities) {
        return text_.error("the components of array " + in_quotes(name), "1 or more", std::to_string(components));
    }
    if (Status s = must_be_new(name, arrays); !s) return s;
    RawArray array;
    array.field = {name, static_cast<int>(components), {}};
    if (Status s =
            text_.colors("array " + in_quotes(name), static_cast<std::uint64_t>(components) * rows, array.field.data);
        !s) {
        return s;
    }
    arrays.push_back(std::move(array));
    return Done{};
}

Status LegacyArrays::must_be_new(const std::string& name, const std::vector<RawArray>& arrays) const {
    const bool known =
        std::any_of(arrays.begin(), arrays.end(), [&](const RawArray& a) { return a.field.name == name; });
    if (!known) return Done{};
    return text_.error("two arrays of one section", "different names", in_quotes(name) + " twice",
                       "give them different names");
}

}  // namespace barycert::io
