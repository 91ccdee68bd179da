#include "app/cli/reports.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/options/want_of_memory.hpp"
#include "barycert/job.hpp"
#include "barycert/mesh.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "files/named_file.hpp"

namespace barycert::cli {

void Reports::ci(const Options& o, const std::string& failures) {
    file(o, "--junit", "Write " + failures + " as failures in JUnit XML; - is stdout and suppresses the table");
    file(o, "--sarif", "Write all that was found as SARIF 2.1.0, " + failures + " as errors; - is stdout likewise");
    o.flag("--annotations", annotations_,
           "Print " + failures + " as annotations of GitHub's workflows, after the table");
}

const std::string& Reports::path(std::string_view option) const {
    static const std::string none;
    const auto named = std::find_if(files_.begin(), files_.end(), [&](const auto& f) { return f.what == option; });
    return named == files_.end() ? none : named->path;
}

std::vector<std::pair<std::string, std::string>> Reports::outputs() const {
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& f : files_) all.emplace_back(f.what, f.path);
    // Annotations follow the table; without one stdout is theirs alone.
    if (table())
        all.emplace_back(summary_ ? "the summary" : "the table", "-");
    else if (annotations_)
        all.emplace_back("--annotations", "-");
    return all;
}

void Reports::check(const std::vector<base::NamedFile>& inputs) const {
    std::vector<base::NamedFile> files;
    for (const auto& [what, path] : outputs()) files.push_back({what, path});
    base::check_outputs(inputs, std::move(files)).value();
}

void Reports::begin(MeshJob& job) {
    begin_progress();
    job.reports = outputs();
    job.program = command_name();
    job.progress = [this](const JobProgress& p) {
        if (p.done == 0) progress_.stage(p.stage);
        if (p.done != 0 && progress_.due()) progress_.stage(fmt::format("{}: {}", p.stage, p.done));
    };
}

Progress& Reports::begin_progress() {
    // Rows on the same terminal would run into the progress.
    const bool rows_on_terminal = rows_ != nullptr && *rows_ == "-" && isatty(STDOUT_FILENO) == 1;
    progress_.begin(!quiet_ && isatty(STDERR_FILENO) == 1 && !rows_on_terminal);
    return progress_;
}

int Reports::write(Told told) {
    end_for_want_of_memory();
    if (told.ci) {
        told.files["--junit"] = [&] { return ci_junit(told.ci()); };
        told.files["--sarif"] = [&] { return ci_sarif(told.ci()); };
    }
    std::vector<Status> done{told.written};
    for (const auto& f : files_) {
        const auto made = told.files.find(f.what);
        if (f.path.empty() || made == told.files.end()) continue;
        const Result<std::string> text = made->second();
        done.push_back(text ? write_output(f.path, *text) : Status(text.error()));
        if (f.what == "--json" && done.back()) expect_json({});  // it stands there, whatever fails besides
    }
    if (!quiet_) tell_important(told.notes);
    if (table()) {
        done.push_back(write_output("-", told.text(colour_on_stdout())));
    } else if (!quiet_ && summary_) {
        tell(told.text(false));
    } else if (!quiet_) {
        for (const CurvedCells& curved : told.curved) {
            if (curved.cells != 0) tell(fmt::format("note: {}\n", message(curved)));
        }
    }
    if (told.ci && annotations_) done.push_back(write_output("-", ci_annotations(told.ci())));
    for (const Status& status : done) {
        if (!status) return fail(status.error());
    }
    tell(told.failures);
    return told.clean ? exit_clean : exit_findings;
}

bool colour_on_stdout() {
    const char* no_colour = std::getenv("NO_COLOR");
    return isatty(STDOUT_FILENO) == 1 && (no_colour == nullptr || *no_colour == '\0');
}

}  // namespace barycert::cli
