/// A job run, and its reports written: files, the table or summary, what is told besides, the exit code.
#pragma once

#include <algorithm>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "barycert/environment.hpp"
#include "barycert/figure.hpp"
#include "barycert/job.hpp"
#include "barycert/mesh.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "files/named_file.hpp"

namespace barycert::cli {

/// One line of stderr that is written over and over and cleared at the end; none without a terminal, or if not wanted.
class Progress {
public:
    void begin(bool on) { on_ = on; }
    void stage(std::string_view text) {
        if (!on_) return;
        tell(fmt::format("\r\033[K{}", base::printable(text)));
        shown_ = true;
        last_ = std::chrono::steady_clock::now();
    }
    /// True if a line is shown at all and the last one is a tenth of a second old.
    bool due() const { return on_ && std::chrono::steady_clock::now() - last_ > std::chrono::milliseconds(100); }
    void clear() {
        if (shown_) tell("\r\033[K");
        shown_ = false;
    }

private:
    bool on_ = false, shown_ = false;
    std::chrono::steady_clock::time_point last_{};
};

struct Told {
    /// By option, what goes into the file that it names. One that is not here is not written.
    std::map<std::string_view, std::function<Result<std::string>()>> files = {};
    std::function<std::string(bool colour)> text = {};  ///< the table or summary
    std::function<CiReport()> ci = {};
    Notes notes = {};
    std::vector<CurvedCells> curved = {};  ///< the table tells them; without it, they are told
    std::string failures = {};             ///< lines for stderr, when all is written
    bool clean = true;
    Status written = Done{};  ///< of what the job wrote itself
};

class Reports {
public:
    // Declared in the order of the help.
    void file(const Options& o, const char* option, const std::string& help) {
        files_.push_back({option, ""});
        o.text(option, files_.back().path, help);
    }
    /// One whose form goes by its suffix.
    void picture(const Options& o, const char* option, const std::string& help) {
        std::string& path = files_.emplace_back(base::NamedFile{option, ""}).path;
        o.taken(option, "FILE", help + ": " + pictures_help() + "; - is SVG on stdout",
                "a name that ends in " + base::suffixes_written(base::Use::picture) + ", or -",
                [&path](const std::string& name) { return is_figure_name(path = name) || name == "-"; });
    }
    /// --junit, --sarif, --annotations. `failures`: what is reported as failed, as in "broken rules".
    void ci(const Options& o, const std::string& failures);
    void quiet(const Options& o, const char* help) { o.flag("--quiet", quiet_, help); }

    /// An output of the job that may be stdout.
    void rows(const std::string& path) { rows_ = &path; }

    bool is_quiet() const { return quiet_; }
    const std::string& path(std::string_view option) const;

    /// Throws where an output is one of these, or cannot be written.
    void check(const std::vector<base::NamedFile>& inputs) const;

    /// Tells the job of the reports, and how the program is called; its progress is shown from now on.
    void begin(MeshJob& job);
    Progress& begin_progress();

    /// Files first: whoever reads the table may stop reading (`| head`). One that fails costs no other.
    int write(Told told);

    /// The end of a job: its error, or its report by told(report), with options in the notes.
    template <class Report, class Tell>
    int end(Result<Report> report, Tell told) {
        progress_.clear();
        if (!report) return fail(report.error());
        if constexpr (requires { report->notes; }) report->notes = with_options(std::move(report->notes));
        if constexpr (requires { report->mesh.notes; })
            report->mesh.notes = with_options(std::move(report->mesh.notes));
        return write(told(std::as_const(*report)));
    }

    /// A job on a mesh whose report is a summary, and JSON.
    template <class Job, class Report>
    int summarise(Job& job, Result<Report> (*files)(const Job&), std::string (*json)(const Report&, const Environment&),
                  std::string (*text)(const Report&, bool)) {
        summary_ = true;
        begin(job);
        return end(files(job), [&](const Report& report) {
            return Told{.files = {{"--json", [&] { return json(report, measure_environment()); }}},
                        .text = [&](bool colour) { return text(report, colour); },
                        .notes = report.notes};
        });
    }

private:
    bool table() const {
        const bool rows = rows_ != nullptr && *rows_ == "-";
        return !quiet_ && !rows && std::ranges::find(files_, "-", &base::NamedFile::path) == files_.end();
    }
    std::vector<std::pair<std::string, std::string>> outputs() const;

    std::deque<base::NamedFile> files_;  // options refer to the paths
    bool annotations_ = false, quiet_ = false;
    bool summary_ = false;  ///< a table stands aside for a report on stdout; a summary goes to stderr then
    const std::string* rows_ = nullptr;
    Progress progress_;
};

template <class Job>
struct Arguments {
    Job job;
    Reports reports;
    const CLI::App* app = nullptr;  ///< the command
};

/// True if text for people on stdout may be coloured: a terminal, and NO_COLOR is not set.
bool colour_on_stdout();

/// "fails: WHAT = VALUE, limit LIMIT", a line.
inline std::string failure(const std::string& what, const std::string& value, const std::string& limit) {
    return fmt::format("fails: {} = {}, limit {}\n", what, value, limit);
}

}  // namespace barycert::cli
