// A section has four parts. Strings: their count, then one a line: the name, perhaps an interpolation scheme. Reals:
// their count, then these: the time. Integers: their count, then these: step, components, rows, perhaps a partition.
// All this is text. Rows: tag value...
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "io/gmsh/msh_file.hpp"
#include "io/gmsh/msh_parts.hpp"
#include "io/tetgen/scanner.hpp"

namespace barycert::io {
namespace {

std::string string_of(std::string_view line) {
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    if (line.size() >= 2 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
    return std::string(line);
}

void read_header(const MshFile& file, MshView& view) {
    constexpr std::int64_t max_components = 100;
    Walk walk(file, *view.section, true, "bad header of");
    const char* const end = walk.end();
    const std::int64_t strings = walk.integer("the number of strings");
    walk.line();
    for (std::int64_t i = 0; i < strings; ++i) {
        if (walk.at() == end) walk.refuse_word("a string", word_at(end, end));
        std::string text = string_of(walk.line());
        if (i == 0) view.field = std::move(text);
        if (i == 1) view.interpolated = true;
    }
    const std::int64_t reals = walk.integer("the number of real numbers");
    for (std::int64_t i = 0; i < reals; ++i) {
        const double value = walk.real("a real number", true);
        if (i == 0) view.time = value;
    }
    const std::int64_t integers = walk.integer("the number of integers");
    std::array<std::int64_t, 3> values{0, 0, -1};
    for (std::int64_t i = 0; i < integers; ++i) {
        const std::int64_t value = walk.integer("an integer");
        if (i < 3) values[static_cast<std::size_t>(i)] = value;
    }
    view.step = values[0];
    if (values[1] < 1 || values[1] > max_components)
        walk.refuse_word("the number of components, 1 to 100", std::to_string(values[1]));
    if (values[2] < 0 || values[2] > INT32_MAX) walk.refuse_word("the number of values", std::to_string(values[2]));
    view.components = static_cast<int>(values[1]);
    if (walk.line().find_first_not_of(" \t") != std::string_view::npos)
        walk.refuse_word("a line end", word_at(walk.at(), end));
    if (view.of == MshView::Of::element_nodes) return;
    Walk rows(file, *view.section);
    rows.move_to(walk.at());
    const std::size_t numbers = 1 + static_cast<std::size_t>(values[1]), bytes = 8 * numbers - 4;
    view.rows = {rows.at(), static_cast<std::size_t>(values[2]), 0, numbers, bytes, 0};
    rows.skip_rows(values[2], numbers, bytes, "values");
    rows.need_end();
}

std::string step_text(const MshView& view) {
    return "step " + std::to_string(view.step) + " (time " + base::shortest(view.time) + ")";
}

/// Makes one field out of the sections of one name and step.
class FieldMaker {
public:
    FieldMaker(const MshFile& file, const ViewTargets& targets, const MshView& first, Notes& notes)
        : file_(file), targets_(targets), first_(first), notes_(notes) {
        field_.name = first.field;
        field_.components = first.components;
        if (field_.name.empty()) {
            field_.name = first.section->name;
            note(Note::Kind::guessed, "the name of a view without one: " + field_.name, false);
        }
    }

    void add(const MshView& view) {
        if (view.components != first_.components) return skip(view, "has another number of components");
        const auto components = static_cast<std::size_t>(view.components);
        std::vector<std::int64_t> tags(view.rows.count);
        std::vector<double> values(view.rows.count * components);
        parse_runs(file_, view.section->name, {&view.rows, 1}, [&, components](auto& row, const Run&, std::size_t i) {
            if (!row.integer(tags[i], "a tag")) return false;
            for (std::size_t c = 0; c < components; ++c) {
                if (!row.any_real(values[i * components + c], "a number")) return false;
            }
            return true;
        });
        bool all = placed_ == 0 && tags.size() == targets_.count;
        std::vector<Mesh::Index> to(tags.size());
        for (std::size_t i = 0; i < to.size(); ++i) {
            to[i] = targets_.index.find(tags[i]);
            all = all && to[i] == static_cast<Mesh::Index>(i);
        }
        if (!all) return place(view, tags, values, to);
        field_.data = std::move(values);
        placed_ = targets_.count;
    }

    void finish(std::vector<Field>& fields) {
        const std::string name = base::quoted(field_.name);
        if (lost_ != 0)
            note(Note::Kind::left_out, std::to_string(lost_) + " values of " + name + ", of what is no " + targets_.one,
                 placed_ == 0);
        if (lost_ == 0 && placed_ == 0) note(Note::Kind::left_out, "view " + name + ", which has no values", false);
        if (placed_ == 0) return;
        if (placed_ != targets_.count)
            note(Note::Kind::guessed,
                 "NaN for the values of " + name + " at " + std::to_string(targets_.count - placed_) + " of " +
                     std::to_string(targets_.count) + " " + targets_.one + "s, which have none",
                 true);
        fields.push_back(std::move(field_));
    }

private:
    void note(Note::Kind kind, std::string text, bool important) {
        notes_.push_back({kind, std::move(text), file_.path(), important});
    }
    void skip(const MshView& view, const char* why) {
        note(Note::Kind::left_out,
             "a second section " + base::quoted(view.field) + " of " + step_text(view) + ": it " + why, true);
    }

    /// Value i, of the tag i, at to[i], if that is not -1.
    void place(const MshView& view, const std::vector<std::int64_t>& tags, const std::vector<double>& values,
               const std::vector<Mesh::Index>& to) {
        const auto components = static_cast<std::size_t>(field_.components);
        if (has_.empty()) {
            has_.assign(targets_.count, placed_ == targets_.count ? 1 : 0);
            if (field_.data.empty())
                field_.data.assign(targets_.count * components, std::numeric_limits<double>::quiet_NaN());
        }
        for (const Mesh::Index i : to) {
            if (i >= 0 && has_[static_cast<std::size_t>(i)] == 1) return skip(view, "has values for the same tags");
        }
        for (std::size_t row = 0; row < to.size(); ++row) {
            if (to[row] < 0) {
                ++lost_;
                continue;
            }
            const auto i = static_cast<std::size_t>(to[row]);
            if (has_[i] == 2)
                file_.refuse("mesh.numbering", view.section->name.data(),
                             "two values of " + base::quoted(view.field) + " for one " + targets_.one,
                             "each tag once in a section", "tag " + std::to_string(tags[row]) + " again");
            has_[i] = 2;
            ++placed_;
            std::copy_n(&values[row * components], components, &field_.data[i * components]);
        }
        std::replace(has_.begin(), has_.end(), std::uint8_t{2}, std::uint8_t{1});
    }

    const MshFile& file_;
    const ViewTargets& targets_;
    const MshView& first_;
    Notes& notes_;
    Field field_;
    std::vector<std::uint8_t> has_;  ///< 1: a value of a section before, 2: of this one
    std::size_t placed_ = 0, lost_ = 0;
};

/// The step to be read of the views of one name; nothing if it is not among them.
std::optional<std::int64_t> choose_step(const std::vector<const MshView*>& views, std::optional<std::int64_t> wanted,
                                        const std::string& path, Notes& notes) {
    std::set<std::int64_t> steps;
    for (const MshView* view : views) steps.insert(view->step);
    if (steps.size() == 1) return *steps.begin();
    const std::string has = base::quoted(views.front()->field) + " has " + std::to_string(steps.size()) + " steps, " +
                            std::to_string(*steps.begin()) + " to " + std::to_string(*steps.rbegin());
    if (wanted && steps.contains(*wanted)) return wanted;
    const MshView* const first = *std::ranges::min_element(views, {}, &MshView::step);
    const std::string rest =
        wanted ? ": none of them is " + std::to_string(*wanted) : ": all but " + step_text(*first) + ", which is read";
    notes.push_back({Note::Kind::left_out, has + rest, path, true});
    return wanted ? std::nullopt : std::optional(first->step);
}

}  // namespace

std::vector<MshView> find_msh_views(const MshFile& file) {
    constexpr std::array<std::string_view, 3> names{"NodeData", "ElementData", "ElementNodeData"};
    std::vector<MshView> views;
    for (const MshSection& section : file.sections()) {
        const auto* const name = std::find(names.begin(), names.end(), section.name);
        if (name == names.end()) continue;
        MshView& view = views.emplace_back();
        view.of = static_cast<MshView::Of>(name - names.begin());
        view.of_cells = view.of == MshView::Of::elements;
        view.section = &section;
        read_header(file, view);
    }
    return views;
}

void read_msh_fields(const MshFile& file, const std::vector<MshView>& views, MshView::Of of, const ViewTargets& targets,
                     std::optional<std::int64_t> step, std::vector<Field>& fields, Notes& notes) {
    std::vector<std::vector<const MshView*>> by_name;
    std::map<std::string, std::size_t> position;
    for (const MshView& view : views) {
        if (view.of != of) continue;
        const auto [it, added] = position.emplace(view.field, by_name.size());
        if (added) by_name.emplace_back();
        by_name[it->second].push_back(&view);
        if (view.interpolated)
            notes.push_back(
                {Note::Kind::left_out, "the interpolation scheme of " + base::quoted(view.field), file.path(), true});
    }
    for (std::vector<const MshView*>& same : by_name) {
        const std::optional<std::int64_t> chosen = choose_step(same, step, file.path(), notes);
        if (!chosen) continue;
        std::erase_if(same, [&](const MshView* view) { return view->step != *chosen; });
        FieldMaker maker(file, targets, *same.front(), notes);
        for (const MshView* view : same) maker.add(*view);
        maker.finish(fields);
    }
}

}  // namespace barycert::io
