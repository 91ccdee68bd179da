// barycert search: the worst cases of one kernel.

#include <fmt/format.h>
#include <signal.h>
#include <CLI/CLI.hpp>

#include <charconv>
#include <chrono>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>

#include "audit_inputs.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"
#include "command.hpp"
#include "files.hpp"
#include "names.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace barycert::cli {
namespace {

struct SearchArguments {
    std::string kernel, library, exponents, json, witnesses;
    std::vector<std::string> families, fail_on;
    std::uint64_t steps = 1000000, seed = 1;
    double seconds = 0;
    int threads = 0;
    bool quiet = false;
    std::shared_ptr<KernelRules> rules = std::make_shared<KernelRules>();
};

volatile sig_atomic_t interrupted = 0;

extern "C" void note_interrupt(int) {
    interrupted = 1;
}

/// While it lives Ctrl-C ends the search and not the program; a second one ends both.
class InterruptEndsSearch {
public:
    InterruptEndsSearch() {
        interrupted = 0;
        ::sigaction(SIGINT, nullptr, &before_);
        if (before_.sa_handler == SIG_IGN) return;
        struct sigaction noting {};
        noting.sa_handler = note_interrupt;
        noting.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
        ::sigaction(SIGINT, &noting, nullptr);
    }
    ~InterruptEndsSearch() { ::sigaction(SIGINT, &before_, nullptr); }
    InterruptEndsSearch(const InterruptEndsSearch&) = delete;
    InterruptEndsSearch& operator=(const InterruptEndsSearch&) = delete;

private:
    struct sigaction before_ {};
};

/// LOW:HIGH.
Status set_exponents(SearchOptions& o, const std::string& text) {
    if (text.empty()) return Done{};
    const std::size_t colon = text.find(':');
    const auto read = [](std::string_view part, int& into) {
        const char* const end = part.data() + part.size();
        const auto [stop, wrong] = std::from_chars(part.data(), end, into);
        return wrong == std::errc() && stop == end;
    };
    const std::string_view all = text;
    if (colon == std::string::npos || !read(all.substr(0, colon), o.min_exponent) ||
        !read(all.substr(colon + 1), o.max_exponent)) {
        return Error{.what = "--exponents", .expected = "LOW:HIGH, such as -10:10", .found = '"' + text + '"'};
    }
    return Done{};
}

Result<Kernel> chosen_kernel(const SearchArguments& a) {
    if (a.kernel.empty() == a.library.empty()) {
        return Error{.what = "which kernel",
                     .expected = "the name of one kernel, or --kernel-library FILE",
                     .found = a.kernel.empty() ? "neither" : "both",
                     .remedy = "`barycert kernels` lists the names"};
    }
    if (!a.library.empty()) {
        const Result<std::vector<Kernel>> one = select_kernels({}, {a.library}, *a.rules);
        return one ? one->front() : Result<Kernel>(one.error());
    }
    const std::vector<Kernel> kernels = kernels_matching(a.kernel);
    if (kernels.size() != 1) {
        return Error{.what = "which kernel",
                     .expected = "the name of one kernel",
                     .found = kernels.empty() ? '"' + a.kernel + '"' : std::to_string(kernels.size()) + " of them",
                     .remedy = base::did_you_mean(a.kernel, kernel_names(), "`barycert kernels` lists the names")};
    }
    return kernels.front();
}

/// What a rule of --fail-on is held against; nothing if a search has no such figure.
std::optional<double> figure(const SearchReport& report, const std::string& name) {
    if (name == "any" || name == "wrong_cases") return static_cast<double>(report.wrong_cases);
    const bool finding = finding_named(name).has_value();
    if (!finding && name != "worst_weight_ulp" && name != "worst_value_ulp") return std::nullopt;
    bool mute = report.given_up;
    for (const SearchFind& f : report.finds) {
        if (f.reason == name) return finding ? static_cast<double>(f.cases) : f.found.magnitude;
        mute = mute || f.reason == barycert::name(Finding::not_finite) ||
               f.reason == barycert::name(Finding::false_declaration) || f.reason == barycert::name(Finding::crashed) ||
               f.reason == barycert::name(Finding::hung) || f.reason == barycert::name(Finding::out_of_bounds);
    }
    // A kernel that gave no weights where there are some has no error to measure: it is worse than any.
    return finding || !mute ? 0 : std::numeric_limits<double>::infinity();
}

Result<std::vector<Threshold>> read_rules(const std::vector<std::string>& texts) {
    std::vector<Threshold> rules;
    for (const std::string& text : texts) {
        const Result<Threshold> rule = parse_threshold(text);
        if (!rule) return rule.error();
        if (!figure({}, rule->name)) {
            return Error{.what = "a rule that a search cannot tell",
                         .expected = "any, a class of finding, worst_weight_ulp or worst_value_ulp",
                         .found = rule->name};
        }
        rules.push_back(*rule);
    }
    return rules;
}

std::string progress_line(const SearchProgress& p, double seconds) {
    std::string line = fmt::format("{:3d} %  {} of {} cases, {:.0f} s", p.steps_done * 100 / p.steps_total,
                                   p.steps_done, p.steps_total, seconds);
    if (p.wrong_cases != 0) line += fmt::format(", {} wrong", p.wrong_cases);
    if (p.worst_weight_ulp >= 0) line += fmt::format(", worst {:.3g} ulps", p.worst_weight_ulp);
    return line + "  (Ctrl-C ends with what is found)";
}

int run_search(const SearchArguments& a) {
    const auto rules = read_rules(a.fail_on);
    if (!rules) return fail(rules.error());
    const bool table = !a.quiet && a.json != "-" && a.witnesses != "-";
    std::vector<base::NamedFile> outputs{{"--json", a.json}, {"--witnesses", a.witnesses}};
    if (table) outputs.push_back({"the table", "-"});
    std::vector<base::NamedFile> inputs;
    if (!a.library.empty()) inputs.push_back({"--kernel-library", a.library});
    if (const Status ok = base::check_outputs(inputs, std::move(outputs)); !ok) return fail(ok.error());
    SearchOptions o;
    if (const Status ok = set_exponents(o, a.exponents); !ok) return fail(ok.error());
    Result<Kernel> kernel = chosen_kernel(a);
    if (!kernel) return fail(kernel.error());
    o.kernel = *kernel;
    const auto families = select_families(a.families);
    if (!families) return fail(families.error());
    o.families = *families;
    o.steps = a.steps;
    o.seconds = a.seconds;
    o.seed = a.seed;
    o.threads = a.threads;
    Progress progress(!a.quiet && stderr_is_terminal());
    const auto start = std::chrono::steady_clock::now();
    o.progress = [&](const SearchProgress& p) {
        if (progress.due()) {
            const auto elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start);
            progress.stage(progress_line(p, elapsed.count()));
        }
        return interrupted == 0;
    };
    Result<SearchReport> report = [&] {
        const InterruptEndsSearch while_searching;
        return search_worst_case(o);
    }();
    progress.clear();
    if (!report) return fail(report.error());

    std::vector<Status> written;
    if (!a.json.empty()) written.push_back(write_output(a.json, search_json(*report)));
    if (!a.witnesses.empty()) written.push_back(write_output(a.witnesses, witnesses_json(*report)));
    if (table) {
        TerminalStyle style{.colour = colour_on_stdout(),
                            .command = command_name(),
                            .witness_path = a.witnesses.empty() ? a.json : a.witnesses};
        if (!a.library.empty()) style.library_arguments.push_back(a.library);
        style.kernel_arguments = words_of(*a.rules);
        written.push_back(write_output("-", search_text(*report, style)));
    }
    if (const Status ok = all_written(written); !ok) return fail(ok.error());
    int code = exit_clean;
    for (const Threshold& rule : *rules) {
        const double value = figure(*report, rule.name).value_or(0);
        if (value <= rule.limit) continue;
        tell(fmt::format("fails: {}: {} = {}, limit {}\n", report->kernel.name, rule.name, base::shortest(value),
                         base::shortest(rule.limit)));
        code = exit_findings;
    }
    return code;
}

}  // namespace

void add_search(CLI::App& app, int& exit_code) {
    auto* sub =
        app.add_subcommand("search", "Search for the worst cases of one kernel, and the plainest that show them");
    sub->footer("Exit codes: 0 done; 1 a rule of --fail-on is broken; 2 usage or input error.");
    const auto a = std::make_shared<SearchArguments>();
    sub->add_option("KERNEL", a->kernel, "The kernel, as `barycert kernels` lists it");
    file_option(*sub, "--kernel-library", a->library,
                "Instead: a shared library with a kernel of yours (see barycert/kernel.h)");
    add_containment(*sub, a->rules);
    sub->add_option("--steps", a->steps, "Cases to make")
        ->capture_default_str()
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 48).description(""))
        ->type_name("N");
    sub->add_option("--seconds", a->seconds, "End after this time at the latest; then a repetition may find otherwise")
        ->check(finite_above(0))
        ->type_name("S");
    sub->add_option("--seed", a->seed, "The same seed and steps find the same, on any number of threads")
        ->capture_default_str()
        ->check(whole_number())
        ->type_name("S");
    sub->add_option("--exponents", a->exponents,
                    "Keep coordinates within 2^LOW <= |x| < 2^(HIGH+1), or zero; default: -1074:1023, all doubles")
        ->type_name("LOW:HIGH");
    sub->add_option("--family", a->families, "Start from families that match; may be repeated; default: all")
        ->type_name("FAMILY|GLOB")
        ->allow_extra_args(false);
    threads_option(*sub, a->threads);
    file_option(*sub, "--json", a->json, "Write the report as JSON; - is stdout and suppresses the table");
    file_option(*sub, "--witnesses", a->witnesses,
                "Write the plainest cases as JSON, for `barycert replay`; - is stdout");
    sub->add_option("--fail-on", a->fail_on,
                    "Exit with 1 if RULE exceeds NUMBER (0 if omitted): any, a class of finding (cases), "
                    "worst_weight_ulp, worst_value_ulp; may be repeated")
        ->type_name("RULE[>NUMBER]")
        ->allow_extra_args(false);
    sub->add_flag("--quiet", a->quiet, "Print no table and no progress");
    sub->callback([a, &exit_code] { exit_code = run_search(*a); });
}

}  // namespace barycert::cli
