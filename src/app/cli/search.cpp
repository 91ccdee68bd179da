// barycert search: the worst cases of one kernel.

#include <signal.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "app/cli/audit_inputs.hpp"
#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/choices.hpp"
#include "barycert/result.hpp"
#include "barycert/threshold.hpp"
#include "core/base/text.hpp"

namespace barycert::cli {
namespace {

struct SearchArguments : Arguments<SearchOptions> {
    KernelChoice kernel;
    std::string name, library;
    std::vector<std::string> families;
    std::vector<Threshold> rules;
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

std::string progress_line(const SearchProgress& p, double seconds) {
    std::string line = fmt::format("{:3d} %  {} of {} cases, {:.0f} s", p.steps_done * 100 / p.steps_total,
                                   p.steps_done, p.steps_total, seconds);
    if (p.wrong_cases != 0) line += fmt::format(", {} wrong", p.wrong_cases);
    if (p.worst_weight_ulp >= 0) line += fmt::format(", worst {:.3g} ulps", p.worst_weight_ulp);
    return line + "  (Ctrl-C ends with what is found)";
}

Result<SearchReport> search(SearchArguments& a) {
    Progress& progress = a.reports.begin_progress();
    const auto start = std::chrono::steady_clock::now();
    a.job.progress = [&](const SearchProgress& p) {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        if (progress.due()) progress.stage(progress_line(p, elapsed.count()));
        return interrupted == 0;
    };
    const InterruptEndsSearch while_searching;
    return search_worst_case(a.job);
}

int run_search(SearchArguments& a) {
    check_search_rules(a.rules).value();
    if (!a.name.empty()) a.kernel.names = {a.name};
    if (!a.library.empty()) a.kernel.libraries = {a.library};
    a.reports.check(library_files(a.kernel));
    a.job.kernel = choose_kernel(a.kernel).value();
    tell_note(a.library, a.job.kernel);
    a.job.families = choose_families(a.families).value();
    return a.reports.end(search(a), [&](const SearchReport& report) {
        const std::vector<Violation> broken = violations(report, a.rules);
        return Told{
            .files = {{"--json", [&] { return search_json(report); }},
                      {"--witnesses", [&] { return witnesses_json(report); }}},
            .text = [&](bool colour) { return search_text(report, style_to_repeat(a.reports, a.kernel, colour)); },
            .failures = failures_of(broken),
            .clean = broken.empty()};
    });
}

}  // namespace

void add_search(const Options& program) {
    const auto& [o, a] =
        program.command("search", "Search for the worst cases of one kernel, and the plainest that show them",
                        "Exit codes: 0 done; 1 a rule of --fail-on is broken; 2 usage or input error.", run_search);
    SearchOptions& options = a.job;
    o.app().add_option("KERNEL", a.name, with_command_name("The kernel, as `barycert kernels` lists it"));
    o.text("--kernel-library", a.library, "Instead: a shared library with a kernel of yours (see barycert/kernel.h)");
    add_containment(o, a.kernel);
    o.integer("--steps", options.steps, std::uint64_t{1}, std::uint64_t{1} << 48, "Cases to make");
    o.parsed("--seconds", "S", "End after this time at the latest; then a repetition may find otherwise",
             "a finite number above 0", options.seconds, positive);
    add_seed(o, options.seed, "The same seed and steps find the same, on any number of threads");
    o.taken("--exponents", "LOW:HIGH",
            "Keep coordinates within 2^LOW <= |x| < 2^(HIGH+1), or zero; default: -1074:1023, all doubles",
            "LOW:HIGH, integers from -1074 to 1023, such as -10:10", [&options](const std::string& text) {
                const auto ends = numbers(':', base::whole_number<int>, 2, 2)(text);
                if (ends) std::tie(options.min_exponent, options.max_exponent) = std::pair((*ends)[0], (*ends)[1]);
                return ends.has_value();
            });
    o.text("--family", a.families, "Start from families that match; may be repeated; default: all", "FAMILY|GLOB");
    o.threads(options.threads);
    a.reports.file(o, "--json", json_instead);
    a.reports.file(o, "--witnesses", "Write the plainest cases as JSON, for `barycert replay`; - is stdout");
    o.each("--fail-on", "RULE[>NUMBER]",
           "Exit with 1 if RULE exceeds NUMBER (0 if omitted): any, a class of finding (cases), worst_weight_ulp, "
           "worst_value_ulp; may be repeated",
           [&rules = a.rules](const std::string& text) { rules.push_back(parse_threshold(text).value()); });
    a.reports.quiet(o, "Print no table and no progress");
}

}  // namespace barycert::cli
