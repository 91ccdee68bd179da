/// How a subcommand declares its options, a call each; and the options that several of them have.
#pragma once

#include <CLI/CLI.hpp>

#include <charconv>
#include <concepts>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/jobs.hpp"
#include "options/parser.hpp"

namespace barycert::cli {

/// The integer that is the whole text.
template <class N>
std::optional<N> integer_of(std::string_view text) {
    N n = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return n;
}

/// A finite number; nothing if the text is something else. Likewise one above 0, and an integer of at least 1.
std::optional<double> finite(std::string_view text);
std::optional<double> positive(std::string_view text);
std::optional<std::int64_t> count_of(std::string_view text);

/// Reads the parts of a text between separators, each by `read`, from `least` to `most` of them; nothing if that fails.
template <class Read>
auto numbers(char separator, Read read, std::size_t least, std::size_t most = std::numeric_limits<std::size_t>::max()) {
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

/// MIN,MAX.
std::optional<std::pair<double, double>> ends_of(std::string_view text);

/// "a finite number of at least 0", or above it: what an option expects.
std::string finite_number(double least, bool above);

/// Of each item its name, a member or name(item).
template <class Items>
std::vector<std::string> names_of(const Items& items) {
    std::vector<std::string> names;
    for (const auto& item : items) {
        if constexpr (requires { item.name; })
            names.push_back(item.name);
        else
            names.emplace_back(name(item));
    }
    return names;
}

/// The options of one subcommand. What they set must live as long as the parser. Texts name the program as it is
/// called.
class Options {
public:
    /// `exit_code` is set by the subcommand that has run.
    Options(CLI::App& app, int& exit_code) : app_(&app), exit_code_(&exit_code) {}

    /// The options of a subcommand below this one. `footer`: what its help ends with.
    Options below(std::string_view name, const std::string& about, const std::string& footer) const;

    /// The same with arguments of its own; work(arguments) does what the subcommand does, and returns the exit code.
    template <class Arguments>
    std::pair<Options, Arguments&> command(std::string_view name, const std::string& about, const std::string& footer,
                                           int (*work)(Arguments&)) const {
        const Options o = below(name, about, footer);
        const auto a = std::make_shared<Arguments>();
        o.run([a, work] { return work(*a); });
        return {o, *a};
    }

    CLI::App& app() const { return *app_; }

    /// What the subcommand does; it returns the exit code. A subcommand below it does its own work instead.
    void run(const std::function<int()>& work) const;

    /// A text or, if the option may be repeated, texts. A file or mesh, by the type, is not the empty string.
    template <class Text>
    CLI::Option* text(const std::string& name, Text& text, const std::string& help,
                      const std::string& type = "FILE") const {
        return text_like(app_->add_option(name, text, told(help)), type, !std::same_as<Text, std::string>);
    }
    /// Of an option that may be repeated, each text.
    CLI::Option* each(const std::string& name, const std::string& type, const std::string& help,
                      const std::function<void(const std::string&)>& take) const;

    /// Sets what is not `given` without it.
    CLI::Option* flag(const std::string& name, bool& value, const std::string& help, bool given = true) const;

    /// An integer from `least` to `most`; the help shows what it is without the option.
    template <class N>
    CLI::Option* integer(const std::string& name, N& n, N least, N most, const std::string& help,
                         const std::string& type = "N") const {
        return app_->add_option(name, n, told(help))
            ->capture_default_str()
            ->check(CLI::Range(least, most).description(""))
            ->type_name(type);
    }
    /// A whole number of 64 bits, all of which may be given. "-1" and 2^64 are refused: the parser would take both for
    /// 2^64 - 1.
    template <class N>
    CLI::Option* whole(const std::string& name, N& n, const std::string& help, const std::string& type = "S") const {
        return parsed(name, type, help, "a whole number from 0 to 2^64 - 1", n, integer_of<std::uint64_t>);
    }
    /// A finite number of at least `least`; with `above`, more than it.
    template <class X>
    CLI::Option* number(const std::string& name, X& x, double least, const std::string& help, const std::string& type,
                        bool above = false) const {
        const auto read = [=](std::string_view text) {
            const std::optional<double> number = finite(text);
            return number && (*number > least || (!above && *number == least)) ? number : std::nullopt;
        };
        return parsed(name, type, help, finite_number(least, above), x, read);
    }
    /// What take(text) reads; it returns false for what is not as `expected`.
    CLI::Option* taken(const std::string& name, const std::string& type, const std::string& help,
                       const std::string& expected, const std::function<bool(const std::string&)>& take) const;
    /// What read(text) makes of it; it returns nothing for what is not as `expected`.
    template <class Value, class Read>
    CLI::Option* parsed(const std::string& name, const std::string& type, const std::string& help,
                        const std::string& expected, Value& value, Read read) const {
        return taken(name, type, help, expected, [&value, read](const std::string& text) {
            const auto x = read(text);
            if (x) value = *x;
            return x.has_value();
        });
    }
    /// One of a few words, each of which stands for a value, in the order of the help.
    template <class Value>
    CLI::Option* choice(const std::string& name, Value& value,
                        const std::vector<std::pair<std::string, Value>>& choices, const std::string& help) const {
        std::vector<std::string> words;
        for (const auto& choice : choices) words.push_back(choice.first);
        const auto set = [&value, choices](const std::string& word) {
            for (const auto& choice : choices) {
                if (choice.first == word) value = choice.second;
            }
        };
        return app_->add_option_function<std::string>(name, set, told(help))
            ->check(one_of(words))
            ->type_name(joined(words));
    }

    // Options that several subcommands have.
    void mesh(std::string& mesh) const;
    void threads(int& threads) const;
    void curved(Curved& curved) const;
    void vtk_data(std::optional<VtkData>& data) const;
    void nonfinite(NonfinitePoints& points) const;
    void rounding(Rounding& rounding, const char* help) const;
    /// MIN,MAX: what the first and the last colour of a picture mean. `what`: "Picture: ", where there are other
    /// outputs.
    void range(std::optional<std::pair<double, double>>& range, const std::string& what) const;
    /// --step and --time, of a MESH that is a series. `all`: what --step all sets; nullptr: not allowed.
    void step(StepChoice& step, bool* all = nullptr) const;
    /// Fields from files; `either` names the option whose rows may belong to nodes or to cells. `series`: where fields
    /// with a file for each step go; nullptr: there are none.
    void field_files(std::vector<FieldFile>& files, const std::string& either,
                     std::vector<FieldFile>* series = nullptr) const;
    /// --size WxH.
    void size(RasterSize& size) const;
    /// Where the camera stands. `what`: as above.
    void camera(ViewOptions& view, const std::string& what) const;

private:
    static std::string told(const std::string& help);
    static CLI::Option* text_like(CLI::Option* option, const std::string& type, bool several);

    CLI::App* app_;
    int* exit_code_;
};

/// The first option that was given and is among these; or, with `others`, that is not. Empty: none.
std::string given_option(const CLI::App& app, std::initializer_list<std::string_view> names, bool others = false);

/// Throws what the parser of options tells.
[[noreturn]] void refuse_option(const std::string& option, const std::string& expected, std::string_view found);

/// NAME and VALUE of NAME=VALUE, neither of them empty; else refuses the option.
std::pair<std::string, std::string> assignment(const std::string& option, const std::string& expected,
                                               const std::string& text);

/// What MESH may be.
inline constexpr const char* mesh_help =
    "A mesh: TetGen's or Triangle's .node/.ele, Gmsh's .msh, Medit's .mesh .meshb, VTK's .vtu .vtk .vtp .pvtu .vtm "
    ".pvd .vtu.series .vtp.series; others by way of meshio; any packed as .gz";

/// What the help ends with where there are no other exit codes.
inline constexpr const char* done_or_error = "Exit codes: 0 done; 2 usage or input error.";

/// What two outputs of text say of themselves.
inline constexpr const char* json_instead = "Write the report as JSON; - is stdout and suppresses the table";
inline constexpr const char* json_summary = "Write the summary as JSON; - is stdout";

}  // namespace barycert::cli
