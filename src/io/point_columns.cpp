#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"
#include "io/paths.hpp"
#include "io/streams.hpp"
#include "io/words.hpp"

namespace barycert::io {
namespace {

constexpr std::array<std::array<std::string_view, 3>, 3> coordinate_names{
    {{"x", "y", "z"}, {"points:0", "points:1", "points:2"}, {"points_0", "points_1", "points_2"}}};

constexpr std::size_t most_listed = 8;

/// An example of columns: the names, or the places from `first` on.
std::string example(const TableColumns& all, int dimension, std::size_t first) {
    std::string text = "options.columns ";
    for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) {
        const bool name = all.named && all.names[first + i].find_first_of(", \"'") == std::string::npos;
        text += (i == 0 ? "" : ",") + (name ? base::printable(all.names[first + i]) : std::to_string(first + i + 1));
    }
    return text;
}

/// Throws an error of the columns, whose texts may name members of options.
template <class... Parts>
[[noreturn]] void refuse(ErrorCode code, const TableColumns& all, Parts&&... parts) {
    Error error = file_error(code, all.file, std::forward<Parts>(parts)...);
    error.line = all.line;
    throw Exception(about("options.columns", std::move(error)));
}

/// The column of exactly that name; names.size() if there is none.
std::size_t column_named(const TableColumns& all, std::string_view name) {
    const auto at = std::find(all.names.begin(), all.names.end(), name);
    if (at != all.names.end() && std::find(at + 1, all.names.end(), name) != all.names.end())
        refuse("column.duplicate", all, "two columns have the same name", "one column " + base::quoted(name), "two",
               "rename one of them");
    return static_cast<std::size_t>(at - all.names.begin());
}

[[noreturn]] void no_such_column(const TableColumns& all, const std::string& name, const std::string& remedy) {
    refuse("column.unknown", all, "no such column", base::quoted(name), listed(all.names),
           base::did_you_mean(name, all.names, remedy));
}

std::vector<std::size_t> axes_asked_for(const TableColumns& all, int dimension, const PointOptions& options) {
    const auto count = static_cast<std::size_t>(dimension);
    const std::vector<std::string> names = parts_of(options.columns, count);
    if (names.size() != count)
        refuse("column.unclear", all, "options.columns does not fit the mesh",
               std::to_string(count) + " columns, for the mesh is " + std::to_string(count) + "-dimensional",
               std::to_string(names.size()), "name a column for each axis, in their order");
    const bool places = are_places(names);
    std::vector<std::size_t> axes;
    for (const std::string& name : names) {
        const std::size_t column = places ? *place_of(name) - 1 : column_named(all, name);
        if (column >= all.names.size())
            no_such_column(all, name, "name columns that are there, or say their places, from 1");
        if (std::find(axes.begin(), axes.end(), column) != axes.end())
            refuse("column.duplicate", all, "a column is named twice in options.columns", "a column for each axis",
                   base::quoted(name), "name a column for each axis, in their order");
        axes.push_back(column);
    }
    return axes;
}

[[noreturn]] void not_clear(const TableColumns& all, int dimension) {
    const auto count = static_cast<std::size_t>(dimension);
    const std::string d = std::to_string(dimension);
    if (all.named)
        refuse("column.unclear", all, "the header does not name the coordinates",
               dimension == 2 ? "columns x, y (or Points:0, Points:1)"
                              : "columns x, y, z (or Points:0, Points:1, Points:2)",
               listed(all.names),
               all.names.size() >= count
                   ? "say which they are, such as " + example(all, dimension, 0) + ", or use these names"
                   : "use these column names, or start the file with numbers");
    const std::string found = std::to_string(all.names.size()) + " columns without names";
    if (all.names.size() < count)
        refuse("point.dimension", all, "too few columns for a point", d + ", for the mesh is " + d + "-dimensional",
               found, "write one point a line, with a coordinate for each axis");
    refuse("column.unclear", all, "it is not clear which columns are the coordinates",
           d + " columns, or names for them", found,
           "say which: " + example(all, dimension, 0) + ", or " + example(all, dimension, all.names.size() - count) +
               ", ..., or put a header line x,y" + (dimension == 3 ? ",z" : "") + ",... first");
}

/// Adds the column NAME of NAME or NEW=NAME; false if there is none.
bool keep_one(const TableColumns& all, const std::string& text, PointColumns& out) {
    std::string name = text;
    std::size_t column = column_named(all, text);
    if (const std::size_t sign = text.find('=');
        column == all.names.size() && sign != std::string::npos && sign != 0 && sign < text.find(',')) {
        name = text.substr(0, sign);
        column = column_named(all, text.substr(sign + 1));
    }
    if (column == all.names.size()) return false;
    if (out.is_coordinate(column))
        refuse("column.duplicate", all, "a column to keep is a coordinate", "another column", base::quoted(text),
               "leave it out of options.keep: rows begin with the coordinates");
    out.kept.push_back({column, std::move(name)});
    return true;
}

void keep_columns(const TableColumns& all, const std::vector<std::string>& keep, PointColumns& out) {
    for (const std::string& text : keep) {
        if (text == "all") {
            for (std::size_t c = 0; c < all.names.size(); ++c) {
                if (!out.is_coordinate(c)) out.kept.push_back({c, all.names[c]});
            }
            continue;
        }
        if (keep_one(all, text, out)) continue;  // a name may hold commas
        for (const std::string& part : parts_of({text}, 0)) {
            if (!keep_one(all, part, out))
                no_such_column(all, part, "name columns that are there, or options.keep all");
        }
    }
    std::set<std::string> names;
    std::set<std::size_t> columns;
    for (const PointColumns::Kept& kept : out.kept) {
        if (!columns.insert(kept.column).second)
            refuse("column.duplicate", all, "a column to keep is named twice", "each once",
                   base::quoted(all.names[kept.column]), "name it once in options.keep");
        if (!names.insert(kept.name).second)
            refuse("column.duplicate", all, "two columns to keep have the same name", "different names",
                   base::quoted(kept.name), "name each once; options.keep NEW=NAME gives a column another name");
    }
}

void note_the_others(const TableColumns& all, PointColumns& out) {
    if (out.zero && all.coordinates == 0)
        out.notes.push_back({Note::Kind::left_out,
                             "column " + all.names[*out.zero] + ", which must be 0 throughout, for the mesh is 2D",
                             all.file});
    std::vector<std::size_t> others;
    for (std::size_t c = 0; c < all.names.size(); ++c) {
        const bool kept = std::any_of(out.kept.begin(), out.kept.end(), [&](const auto& k) { return k.column == c; });
        if (!kept && !out.is_coordinate(c)) others.push_back(c);
    }
    if (others.empty()) return;
    const auto name = [&](std::size_t column) { return all.names[column]; };
    const std::span some = std::span(others).first(std::min(most_listed, others.size()));
    std::string text = (others.size() == 1 ? "column " : "columns ") + base::joined(some, ", ", name),
                names = base::joined(some, ",", name);
    if (others.size() > most_listed) {
        text += " and " + std::to_string(others.size() - most_listed) + " more";
        names = "all";
    }
    text += "; options.keep " + names + (others.size() == 1 ? " carries it through" : " carries them through");
    out.notes.push_back({Note::Kind::left_out, std::move(text), all.file, false, "options.keep"});
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
    const std::string text =
        base::joined(std::span(names).first(std::min(most_listed, names.size())), ", ", base::quoted);
    return names.empty() ? "none" : text + (names.size() > most_listed ? ", ..." : "");
}

std::vector<std::string> parts_of(const std::vector<std::string>& texts, std::size_t count) {
    if (texts.size() == count) return texts;
    std::vector<std::string> parts;
    for (const std::string& text : texts) {
        std::vector<std::string_view> fields = cut_fields(text, "", ",");
        if (text.empty()) fields.emplace_back();
        parts.insert(parts.end(), fields.begin(), fields.end());
    }
    return parts;
}

std::optional<PointColumns> find_coordinates(const TableColumns& all, int dimension) {
    for (const auto& names : coordinate_names) {
        std::array<std::optional<std::size_t>, 3> at{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 0; i < all.names.size(); ++i) {
                if (lower(all.names[i]) != names[axis]) continue;
                if (at[axis])
                    refuse("column.duplicate", all, "two columns have the same name",
                           "one column " + std::string(names[axis]),
                           base::quoted(all.names[*at[axis]]) + " and " + base::quoted(all.names[i]),
                           "rename the column that is not a coordinate, or say which by options.columns");
                at[axis] = i;
            }
            if (!at[axis] && axis < static_cast<std::size_t>(dimension)) break;
        }
        if (!at[0] || !at[1] || (dimension == 3 && !at[2])) continue;
        PointColumns found{.axes = {*at[0], *at[1]}};
        if (dimension == 3) found.axes.push_back(*at[2]);
        if (dimension == 2) found.zero = at[2];
        return found;
    }
    return std::nullopt;
}

PointColumns choose_columns(const TableColumns& all, int dimension, const PointOptions& options) {
    const auto count = static_cast<std::size_t>(dimension);
    PointColumns out{.axes = {0, 1}};
    if (dimension == 3) out.axes.push_back(2);
    if (!options.columns.empty()) {
        out.axes = axes_asked_for(all, dimension, options);
    } else if (all.coordinates != 0) {
        if (all.coordinates < count)
            refuse("point.dimension", all, "the points have another dimension", "3, for the mesh is 3-dimensional", "2",
                   "give points of the dimension of the mesh");
        if (all.coordinates > count) out.zero = count;
    } else if (all.named) {
        std::optional<PointColumns> found = find_coordinates(all, dimension);
        if (!found) not_clear(all, dimension);
        out = std::move(*found);
    } else if (all.names.size() != count) {
        not_clear(all, dimension);
    }
    keep_columns(all, options.keep, out);
    note_the_others(all, out);
    return out;
}

}  // namespace barycert::io
