#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"
#include "mesh/sample/quantity/quantities.hpp"

namespace barycert::sample {
namespace {

using Kind = QuantityStep::Kind;

/// The fields of nodes or of cells; and the prefix that may stand before their names.
const std::vector<Field>& fields_of(const Mesh& mesh, bool cells) {
    return cells ? mesh.cell_fields : mesh.point_fields;
}
std::string_view prefix_of(bool cells) {
    return cells ? "cell:" : "point:";
}

/// True, and the choice made, if there is a field of that name; point:NAME and cell:NAME say where.
bool choose_field(const Mesh& mesh, std::string_view name, FieldChoice& chosen) {
    const auto choose = [&](bool cells, std::string_view full) {
        const Field* const field = field_named(fields_of(mesh, cells), full);
        if (field != nullptr) chosen = {field, cells};
        return field != nullptr;
    };
    for (const bool cells : {false, true}) {
        if (choose(cells, name) || choose(cells, std::string(prefix_of(cells)) + std::string(name))) return true;
    }
    for (const bool cells : {false, true}) {
        const std::string_view prefix = prefix_of(cells);
        if (name.starts_with(prefix) && choose(cells, name.substr(prefix.size()))) return true;
    }
    return false;
}

/// Returns the error that there is no such field, which one may be meant, and which there are.
Error no_such_field(const Mesh& mesh, const std::string& name) {
    const auto list = [](const std::vector<Field>& fields) { return base::joined(fields, ", ", &Field::name); };
    const std::string points = list(mesh.point_fields), cells = list(mesh.cell_fields);
    std::string remedy = "there are " + points;
    if (points.empty())
        remedy = cells.empty() ? "the mesh has none; a field may come from a file of its own" : "there are";
    if (!cells.empty()) remedy += (points.empty() ? " " : ", and of cells ") + cells;
    return {.code = "field.unknown",
            .what = "no field of that name",
            .found = '"' + name + '"',
            .remedy = base::did_you_mean(name, all_field_names(mesh), remedy)};
}

/// Deeper ones are no names that anybody means.
constexpr int deepest_expression = 16;

struct Split {
    std::string_view inner;
    QuantityStep step;
};

/// x, y, z are 0, 1, 2.
std::optional<int> component_of(std::string_view text) {
    if (text.size() == 1 && text[0] >= 'x' && text[0] <= 'z') return text[0] - 'x';
    if (text.starts_with('-') || (text.size() > 1 && text.starts_with('0'))) return std::nullopt;
    return base::whole_number<int>(text);
}

/// The last step of an expression; nothing if the text is none.
std::optional<Split> split_off(std::string_view text) {
    struct Bracket {
        std::string_view begin;
        char end;
        Kind kind;
    };
    for (const auto& [begin, end, kind] :
         {Bracket{"grad(", ')', Kind::gradient}, {"mean(", ')', Kind::mean}, {"|", '|', Kind::length}}) {
        if (text.size() > begin.size() + 1 && text.starts_with(begin) && text.ends_with(end))
            return Split{text.substr(begin.size(), text.size() - begin.size() - 1), {kind}};
    }
    const std::size_t dot = text.rfind('.');
    if (dot == std::string_view::npos || dot == 0 || dot + 1 == text.size()) return std::nullopt;
    const auto component = component_of(text.substr(dot + 1));
    if (!component) return std::nullopt;
    return Split{text.substr(0, dot), {Kind::component, *component}};
}

/// True, and the choice made, if the text names a field or what is made of one; else `missing` is the wrong name.
bool choose_quantity(const Mesh& mesh, std::string_view text, bool cells_first, int depth, FieldChoice& chosen,
                     std::string& missing) {
    if (cells_first && choose_field(mesh, "cell:" + std::string(text), chosen)) return true;
    if (choose_field(mesh, text, chosen)) return true;
    const auto split = depth == 0 ? std::nullopt : split_off(text);
    if (!split) {
        missing = text;
        return false;
    }
    if (!choose_quantity(mesh, split->inner, split->step.kind == Kind::mean, depth - 1, chosen, missing)) return false;
    chosen.steps.push_back(split->step);
    return true;
}

/// A name that two columns have, if one of them is made of a field.
std::optional<std::string> common_column(const Mesh& mesh, const std::vector<FieldChoice>& chosen) {
    if (std::ranges::all_of(chosen, [](const FieldChoice& c) { return c.steps.empty(); })) return std::nullopt;
    std::vector<TableField> fields;
    fields.reserve(chosen.size());
    for (const FieldChoice& choice : chosen)
        fields.push_back({name_of(choice), static_cast<int>(shape_of(mesh, choice)->components)});
    std::vector<std::string> names = column_names(fields);
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    return twice == names.end() ? std::nullopt : std::optional(*twice);
}

Error wrong_choice(ErrorCode code, std::string what, const FieldChoice& choice, std::string remedy) {
    return {.code = code, .what = std::move(what), .found = '"' + name_of(choice) + '"', .remedy = std::move(remedy)};
}

}  // namespace

const Field* field_named(const std::vector<Field>& fields, std::string_view name) {
    const auto it = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
    return it == fields.end() ? nullptr : &*it;
}

std::vector<std::string> all_field_names(const Mesh& mesh) {
    std::vector<std::string> names = base::names_of(mesh.point_fields);
    for (const Field& field : mesh.cell_fields) names.push_back(field.name);
    return names;
}

Result<QuantityShape> shape_of(const Mesh& mesh, const FieldChoice& choice) {
    QuantityShape shape{choice.of_cells, static_cast<std::size_t>(std::max(choice.field->components, 1)), false};
    bool length_at_points = false;
    for (const QuantityStep& step : choice.steps) {
        if (length_at_points)
            return wrong_choice("field.location", "nothing is made of a length at points", choice,
                                "ask for the length alone");
        switch (step.kind) {
            case Kind::component:
                if (step.component < 0 || static_cast<std::size_t>(step.component) >= shape.components)
                    return Error{.code = "field.component",
                                 .what = "no such component in \"" + name_of(choice) + '"',
                                 .expected = "0 to " + std::to_string(shape.components - 1),
                                 .found = std::to_string(step.component),
                                 .remedy = "components count from 0; x, y, z are 0, 1, 2"};
                shape.components = 1;
                break;
            case Kind::length:
                shape.components = 1;
                length_at_points = !shape.of_cells;
                shape.at_points = shape.at_points || length_at_points;
                break;
            case Kind::gradient:
                if (shape.of_cells || shape.at_points)
                    return wrong_choice("field.location",
                                        "the gradient of what is constant in each cell, or of a gradient", choice,
                                        "ask for that of a field of nodes, or of the mean at nodes: grad(mean(NAME))");
                shape.components *= static_cast<std::size_t>(mesh.dimension);
                shape.at_points = !mesh.mid_nodes.empty();
                shape.of_cells = mesh.mid_nodes.empty();
                break;
            default:
                if (!shape.of_cells)
                    return wrong_choice("field.location", "the mean over cells of what is not a field of cells", choice,
                                        "ask for that of a field of cells: mean(cell:NAME)");
                shape.of_cells = false;
        }
    }
    return shape;
}

Result<std::vector<FieldChoice>> quantities_named(const Mesh& mesh, const std::vector<std::string>& names) {
    std::vector<FieldChoice> chosen;
    if (names.empty()) {
        for (const bool cells : {false, true}) {
            for (const Field& f : fields_of(mesh, cells)) chosen.push_back({&f, cells});
        }
        return chosen;
    }
    std::string missing;
    const auto choose = [&](const std::string& name) {
        FieldChoice one;
        if (!choose_quantity(mesh, name, false, deepest_expression, one, missing)) return false;
        if (!one.steps.empty()) one.name = name;
        chosen.push_back(std::move(one));
        return true;
    };
    for (const std::string& text : names) {
        if (choose(text)) continue;  // a name may hold commas
        if (!for_names(text, choose)) return no_such_field(mesh, missing);
    }
    const auto rank = [&](const FieldChoice& choice) {
        const QuantityShape shape = *shape_of(mesh, choice);
        return shape.at_points ? 2 : shape.of_cells ? 1 : 0;
    };
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (const Result<QuantityShape> shape = shape_of(mesh, chosen[i]); !shape) return shape.error();
        for (std::size_t k = 0; k < i; ++k) {
            if (chosen[i].field == chosen[k].field && chosen[i].steps == chosen[k].steps)
                return wrong_choice("field.duplicate",
                                    chosen[i].steps.empty() ? "a field is chosen twice" : "a column is chosen twice",
                                    chosen[i], "name it once");
        }
    }
    if (const auto name = common_column(mesh, chosen))
        return Error{.code = "column.duplicate",
                     .what = "two columns have the same name",
                     .found = '"' + *name + '"',
                     .remedy = "choose one of them"};
    std::ranges::stable_sort(chosen, {}, rank);
    return chosen;
}

std::optional<std::string> with_other_name(std::string_view expression, std::string_view name, std::string_view other) {
    std::string_view inner = expression;
    for (int depth = deepest_expression;; --depth) {
        for (const std::string_view prefix : {"", "cell:", "point:"}) {
            if (inner.size() != prefix.size() + name.size() || !inner.starts_with(prefix) || !inner.ends_with(name))
                continue;
            const auto begin = static_cast<std::size_t>(inner.data() - expression.data()) + prefix.size();
            return std::string(expression).replace(begin, name.size(), other);
        }
        const auto split = depth == 0 ? std::nullopt : split_off(inner);
        if (!split) return std::nullopt;
        inner = split->inner;
    }
}

}  // namespace barycert::sample
