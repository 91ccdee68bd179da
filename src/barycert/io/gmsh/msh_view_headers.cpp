// Strings count, a line each: the name, perhaps an interpolation scheme. Reals count, reals: the time. Integers count,
// integers: step, components, rows, perhaps a partition. All this is text. Rows: tag value...
#include <algorithm>
#include <array>

#include "barycert/io/gmsh/msh_views.hpp"
#include "barycert/io/gmsh/walk.hpp"

namespace barycert::io {
namespace {

/// What a line says, without quotes.
std::string string_of(std::string_view line) {
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    if (line.size() >= 2 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
    return std::string(line);
}

class HeaderReader {
public:
    HeaderReader(const MshFile& file, const MshSection& section)
        : file_(file), at_(section.body.data()), end_(at_ + section.body.size()), name_(section.name) {}

    Status read(MshView& view) {
        std::int64_t strings = 0, reals = 0, integers = 0;
        if (!integer(strings, "the number of strings")) return error();
        take_line(at_, end_);
        for (std::int64_t i = 0; i < strings; ++i) {
            if (at_ == end_) return error("a string");
            std::string text = string_of(take_line(at_, end_));
            if (i == 0) view.name = std::move(text);
            if (i == 1) view.interpolated = true;
        }
        if (!integer(reals, "the number of real numbers")) return error();
        for (std::int64_t i = 0; i < reals; ++i) {
            double value = 0;
            if (!real(value)) return error();
            if (i == 0) view.time = value;
        }
        if (!integer(integers, "the number of integers")) return error();
        std::array<std::int64_t, 3> values{0, 0, -1};
        for (std::int64_t i = 0; i < integers; ++i) {
            std::int64_t value = 0;
            if (!integer(value, "an integer")) return error();
            if (i < 3) values[static_cast<std::size_t>(i)] = value;
        }
        view.step = values[0];
        if (values[1] < 1 || values[1] > max_components) return refuse("the number of components, 1 to 100", values[1]);
        if (values[2] < 0 || values[2] > INT32_MAX) return refuse("the number of values", values[2]);
        view.components = static_cast<int>(values[1]);
        const std::string_view rest = take_line(at_, end_);
        if (rest.find_first_not_of(" \t") != std::string_view::npos) return error("a line end");
        if (view.of == MshView::Of::element_nodes) return Done{};
        Walk walk(file_, *view.section);
        walk.move_to(at_);
        const auto components = static_cast<std::size_t>(view.components);
        view.rows = {walk.place(), static_cast<std::size_t>(values[2]), 0, 4 + 8 * components, 0};
        if (!walk.skip_rows(values[2], 1 + components, view.rows.row_bytes, "values") || !walk.at_end())
            return walk.error();
        return Done{};
    }

private:
    static constexpr std::int64_t max_components = 100;

    bool integer(std::int64_t& value, const char* name) {
        wanted_ = name;
        TextRow<true> row(at_, end_);
        if (!row.integer(value, name) || row.at() > end_) return false;
        at_ = row.at();
        return true;
    }
    bool real(double& value) {
        wanted_ = "a real number";
        TextRow<true> row(at_, end_);
        if (!row.value(value, "") || row.at() > end_) return false;
        at_ = row.at();
        return true;
    }
    Error error() const { return error(wanted_); }
    Error error(const char* wanted) const {
        return file_.error_at(at_, "bad header of $" + std::string(name_), wanted, word_at(at_, end_));
    }
    Error refuse(const char* wanted, std::int64_t found) const {
        return file_.error_at(at_, "bad header of $" + std::string(name_), wanted, std::to_string(found));
    }

    const MshFile& file_;
    const char* at_;
    const char* end_;
    std::string_view name_;
    const char* wanted_ = "";
};

}  // namespace

Result<std::vector<MshView>> find_msh_views(const MshFile& file) {
    constexpr std::array<std::string_view, 3> names{"NodeData", "ElementData", "ElementNodeData"};
    std::vector<MshView> views;
    for (const MshSection& section : file.sections()) {
        const auto* const name = std::find(names.begin(), names.end(), section.name);
        if (name == names.end()) continue;
        MshView view;
        view.of = static_cast<MshView::Of>(name - names.begin());
        view.section = &section;
        if (Status s = HeaderReader(file, section).read(view); !s) return s.error();
        views.push_back(std::move(view));
    }
    return views;
}

}  // namespace barycert::io
