/// How a subcommand declares its options, a call each; and the options that several of them have.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/cli/command.hpp"
#include "app/options/parser.hpp"
#include "barycert/figure.hpp"
#include "barycert/job.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/raster.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/table.hpp"
#include "barycert/weights.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"

namespace barycert::cli {

using base::names_of;

/// A finite number; nothing if the text is something else. Likewise one above 0, and an integer of at least 1.
inline std::optional<double> finite(std::string_view text) {
    const auto x = base::parse_double(text);
    return x && std::isfinite(*x) ? x : std::nullopt;
}
inline std::optional<double> positive(std::string_view text) {
    const auto x = finite(text);
    return x && *x > 0 ? x : std::nullopt;
}
inline std::optional<std::int64_t> count_of(std::string_view text) {
    const auto n = base::whole_number<std::int64_t>(text);
    return n && *n >= 1 ? n : std::nullopt;
}

/// Reads the parts of a text between separators, each by `read`, from `least` to `most` of them; nothing if that fails.
template <class Read>
auto numbers(char separator, Read read, std::size_t least, std::size_t most) {
    return [=](std::string_view text) {
        std::optional<std::vector<typename decltype(read(text))::value_type>> all(std::in_place);
        for (;;) {
            const std::size_t end = text.find(separator);
            const auto x = read(text.substr(0, end));
            if (x) all->push_back(*x);
            if (!x || all->size() > most) return decltype(all)();
            if (end == std::string_view::npos) return all->size() < least ? decltype(all)() : all;
            text.remove_prefix(end + 1);
        }
    };
}

/// An axis and where, such as z=0.5, or NX,NY,NZ,D.
std::optional<Plane> plane_of(const std::string& given);

/// MIN,MAX.
inline std::optional<std::pair<double, double>> ends_of(std::string_view text) {
    const auto ends = numbers(',', finite, 2, 2)(text);
    if (!ends) return std::nullopt;
    return std::pair((*ends)[0], (*ends)[1]);
}

/// A:B, two points of `least` to three coordinates each.
inline std::optional<std::vector<std::vector<double>>> segment_of(std::string_view text, std::size_t least) {
    const auto ends = numbers(':', numbers(',', finite, least, 3), 2, 2)(text);
    return ends && (*ends)[0].size() == (*ends)[1].size() ? ends : std::nullopt;
}

/// What a mesh may be, and lists of suffixes, from the table of formats.
inline std::string mesh_help() {
    return "A mesh: of " + base::families_read(base::Use::mesh) + "; others by way of meshio; any packed as .gz";
}
inline std::string pictures_help() {
    return base::suffix_list_written(base::Use::picture);
}
inline std::string contours_help() {
    return base::suffix_list_written(base::Use::surface) + "; a picture: " + pictures_help();
}

/// Texts that declare options: names, types, helps.
using Text = const std::string&;

/// The options of pictures, for outputs that are none.
inline const std::vector<std::string_view> figure_options{
    "--range",      "--log",  "--labels",     "--colormap", "--title",  "--unit",  "--no-bar",
    "--background", "--axes", "--resolution", "--samples",  "--size",   "--width", "--view",
    "--camera",     "--zoom", "--parallel",   "--edges",    "--outline"};

/// Refuses what an option is given.
[[noreturn]] void refuse_option(Text option, Text expected, Text found);

/// The options of one subcommand. The variables that they set must outlive the parser. Texts name the program as it is
/// called.
class Options {
public:
    /// `exit_code` is set by the subcommand that has run.
    Options(CLI::App& app, int& exit_code) : app_(&app), exit_code_(&exit_code) {}

    /// Options and arguments of a subcommand below; work(arguments), unless there is one below it, gives the exit code.
    template <class Arguments>
    std::pair<Options, Arguments&> command(std::string_view name, Text about, Text footer,
                                           int (*work)(Arguments&)) const {
        const auto a = std::make_shared<Arguments>();
        CLI::App* const sub = app_->add_subcommand(std::string(name), about);
        if constexpr (requires { a->app; }) a->app = sub;
        sub->footer(with_command_name(footer));
        sub->callback([a, work, sub, code = exit_code_] {
            if (!sub->get_subcommands().empty()) return;
            if constexpr (requires { a->reports; }) expect_json(a->reports.path("--json"));
            *code = work(*a);
        });
        return {Options(*sub, *exit_code_), *a};
    }

    CLI::App& app() const { return *app_; }

    /// A text or, if the option may be repeated, texts. A file or mesh, by the type, is not the empty string.
    template <class Texts>
    CLI::Option* text(Text name, Texts& text, Text help, Text type = "FILE") const {
        return text_like(app_->add_option(name, text, with_command_name(help)), type,
                         !std::same_as<Texts, std::string>);
    }
    /// Takes each text of an option that may be repeated.
    CLI::Option* each(Text name, Text type, Text help, const std::function<void(Text)>& take) const;

    /// Sets what is not `given` without it.
    CLI::Option* flag(Text name, bool& value, Text help, bool given = true) const {
        return app_->add_flag_callback(
            name, [&value, given] { value = given; }, with_command_name(help));
    }

    /// An integer from `least` to `most`; the help shows what it is without the option.
    template <class N>
    CLI::Option* integer(Text name, N& n, N least, N most, Text help, Text type = "N") const {
        return app_->add_option(name, n, with_command_name(help))
            ->capture_default_str()
            ->check(CLI::Range(least, most).description(""))
            ->type_name(type);
    }
    /// Any whole number of 64 bits. "-1" and 2^64 are refused: the parser would take both for 2^64 - 1.
    template <class N>
    CLI::Option* whole(Text name, N& n, Text help, Text type = "S") const {
        return parsed(name, type, help, "a whole number from 0 to 2^64 - 1", n, base::whole_number<std::uint64_t>);
    }
    /// A finite number of at least `least`.
    template <class X>
    CLI::Option* number(Text name, X& x, double least, Text help, Text type) const {
        const auto read = [=](std::string_view text) {
            const std::optional<double> number = finite(text);
            return number && *number >= least ? number : std::nullopt;
        };
        return parsed(name, type, help, fmt::format("a finite number of at least {}", base::shortest(least)), x, read);
    }
    /// Takes a text by take(text), which returns false for a text that is not as `expected`.
    CLI::Option* taken(Text name, Text type, Text help, Text expected, const std::function<bool(Text)>& take) const;
    /// Sets the value that read(text) returns; nothing means that the text is not as `expected`.
    template <class Value, class Read>
    CLI::Option* parsed(Text name, Text type, Text help, Text expected, Value& value, Read read) const {
        return taken(name, type, help, expected, [&value, read](const std::string& text) {
            const auto x = read(text);
            if (x) value = *x;
            return x.has_value();
        });
    }
    /// One of a few words, each of which stands for a value, in the order of the help.
    template <class Value>
    CLI::Option* choice(Text name, Value& value, const std::vector<std::pair<std::string, Value>>& choices,
                        Text help) const {
        std::vector<std::string> words;
        std::ranges::transform(choices, std::back_inserter(words), &std::pair<std::string, Value>::first);
        const auto set = [&value, choices](const std::string& word) {
            value = std::ranges::find(choices, word, &std::pair<std::string, Value>::first)->second;
        };
        return app_->add_option_function<std::string>(name, set, with_command_name(help))
            ->check(one_of(words))
            ->type_name(joined(words));
    }

    // Options that several subcommands have.
    void mesh(std::string& mesh) const { text("MESH", mesh, mesh_help())->required(); }
    void threads(int& threads) const { integer("--threads", threads, 0, 4096, "Number of threads; 0: all"); }
    void curved(Curved& curved) const;
    void cell_interpolation(CellInterpolation& interpolation) const;
    void vtk_data(std::optional<VtkData>& data) const;
    void nonfinite(NonfinitePoints& points) const;
    void rounding(Rounding& rounding, const char* help) const {
        choice<Rounding>("--rounding", rounding, {{"correct", Rounding::correct}, {"plain", Rounding::plain}}, help);
    }
    /// Colours, axes, title and background of a picture. `what`: "Picture: ", if there are other outputs.
    void figure(FigureOptions& figure, Text what) const;
    /// Its samples, size and camera.
    void view(FigureOptions& figure, Text what) const;
    void edges(bool& edges, bool& outline, Text what) const;
    /// --step and --time, of a MESH that is a series. `all`: what --step all sets; nullptr: not allowed.
    void step(StepChoice& step, bool* all = nullptr) const;
    /// Fields from files; `either`: the option whose rows may be of nodes or cells. `series`: where those in steps go.
    void field_files(std::vector<FieldFile>& files, Text either, std::vector<FieldFile>* series = nullptr) const;
    void size(RasterSize& size) const;

private:
    static CLI::Option* text_like(CLI::Option* option, Text type, bool several);

    CLI::App* app_;
    int* exit_code_;
};

/// The first option that was given and is among these; or, with `others`, that is not. Empty: none.
std::string given_option(const CLI::App& app, const std::vector<std::string_view>& names, bool others = false);

/// NAME and VALUE of NAME=VALUE, neither of them empty; else refuses the option.
std::pair<std::string, std::string> assignment(Text option, Text expected, Text text);

/// Last line of the help where there are no other exit codes.
inline constexpr const char* done_or_error = "Exit codes: 0 done; 2 usage or input error.";

/// Helps of two outputs of text.
inline constexpr const char* json_instead = "Write the report as JSON; - is stdout and suppresses the table";
inline constexpr const char* json_summary = "Write the summary as JSON; - is stdout";

}  // namespace barycert::cli
