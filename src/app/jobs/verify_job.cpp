// Results of a tool held against the exact ones.

#include "barycert/verify_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/jobs/claimed_columns.hpp"
#include "app/jobs/job_files.hpp"
#include "app/jobs/stream.hpp"
#include "barycert/environment.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/verify.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"
#include "files/input_file.hpp"
#include "io/paths.hpp"
#include "mesh/sample/quantity/quantities.hpp"

namespace barycert {
namespace {

using jobs::Claims;
using jobs::refuse_member;
using jobs::Stopwatch;

constexpr double tolerance_of_floats = 1e-6;

/// Is every number of the columns of values single precision? False if there is none.
bool are_floats(const Claims& claims) {
    std::size_t numbers = 0;
    for (const double x : claims.values) {
        if (std::isnan(x) || x == 0) continue;
        if (static_cast<double>(static_cast<float>(x)) != x) return false;
        ++numbers;
    }
    return numbers > 0;
}

bool has_digits(double x, int digits) {
    return base::parse_double(fmt::format("{:.{}g}", x, digits)) == x;
}

/// Were the numbers written with six digits, as printf and streams do unless told otherwise?
bool are_cut_to_six_digits(const Claims& claims) {
    bool cut = false;
    for (const double x : claims.values) {
        if (!std::isfinite(x)) continue;
        if (!has_digits(x, 6)) return false;
        cut = cut || !has_digits(x, 5);
    }
    return cut;
}

/// Are these the errors of a tool that stops an iteration in second-order cells at 1e-5, as VTK does? A coordinate of
/// the cell that is off by s changes a value by up to 5 s of the range: at a vertex the slopes of the shape functions
/// are -4, -1, 1, 4. So 1e-4 is a bound, but for all three coordinates at their worst. Rounding leaves 1e-12 at most,
/// single precision 1e-7: few values are so good where an iteration stopped.
bool may_be_of_iteration(const ValueErrors& e) {
    const auto count = [&](int from_decade, int to_decade) {  // of errors from 10^from on, below 10^to
        const auto bin = e.by_relative.begin() + 19;
        return std::accumulate(bin + from_decade, bin + to_decade, std::uint64_t{0});
    };
    const bool single = e.floats == e.values;
    return e.values == e.identical || (e.values >= 10 && e.missing == 0 && e.spurious == 0 && count(-4, 3) == 0 &&
                                       count(-19, single ? -7 : -12) <= e.values / 10);
}

/// Points and what is claimed of them.
struct ClaimedBlock {
    std::vector<double> points;
    Claims claims;
};

class Verification {
public:
    explicit Verification(const VerifyJob& job) : job_(job) {}

    VerifyReport run() {
        Stopwatch whole;
        read_all();
        build();
        check_limits();
        compare();
        if (report_.verdicts.rows == 0)
            refuse_member("results.empty", "job.results", job_.results == "-" ? "standard input" : job_.results,
                          "there are no results to verify", "a row for each point", "no row",
                          "look at what should have written them: nothing was compared");
        for (WrongRow& row : report_.verdicts.examples) {
            row.exact.cell = mesh_.cell_number(row.exact.cell);
            if (row.claimed_cell >= static_cast<std::int64_t>(mesh_.cell_count())) continue;
            row.claimed_cell = mesh_.cell_number(static_cast<Mesh::Index>(row.claimed_cell));
        }
        report_.seconds.total = whole.lap();
        return std::move(report_);
    }

private:
    void read_all() {
        Stopwatch watch;
        mesh_ = jobs::open_mesh_with_fields(job_, job_.options.threads, report_);
        const std::vector<FieldChoice> fields = sample::quantities_named(mesh_, job_.fields).value();
        report_.seconds.mesh = watch.lap();
        report_.results = job_.results;
        report_.program = job_.program;
        PointOptions options{
            .columns = job_.columns, .keep = {"all"}, .nonfinite_points = job_.options.nonfinite_points};
        const auto open = [&] { source_ = open_points(job_.results, mesh_.dimension, options).value(); };
        open();
        columns_ = jobs::claimed_columns(job_, mesh_, fields, source_->carried(), report_.notes);
        options.keep = columns_.names();
        if (!io::is_read_once(job_.results)) open();
    }

    void build() {
        Stopwatch watch;
        locator_ = jobs::build_locator(job_, mesh_, job_.options.threads);
        jobs::report_maps(job_, *locator_, report_);
        sampler_ = Sampler::build(*locator_, columns_.fields).value();
        report_.interpolation = locator_->interpolation();
        report_.certified = locator_->certified();
        report_.contested_cells = locator_->contested_cells();
        report_.columns = sampler_->columns();
        report_.found_in = columns_.values;
        report_.cell_column = columns_.cell;
        report_.mask_column = columns_.mask;
        report_.seconds.build = watch.lap();
    }

    void check_limits() {
        report_.limits = job_.limits;
        for (const RowVerdict kind : kinds_of_wrong) {
            if (job_.limits.empty()) report_.limits.push_back({kind, 0});
        }
        for (const VerifyLimit& limit : job_.limits) {
            if (report_.compared(limit.verdict)) continue;
            const bool cells = limit.verdict == RowVerdict::wrong_cell;
            refuse_member("rule.unfit", cells ? "job.cell_column" : "job.values", job_.results,
                          "a rule that no row can break: " + std::string(handle(limit.verdict)),
                          cells ? "a column that names cells" : "a column of values of a field", "none",
                          cells ? "name it with job.cell_column, or leave the rule out"
                                : "name it with job.values, or leave the rule out");
        }
    }

    void guess(std::string text) {
        report_.notes.push_back({Note::Kind::guessed, std::move(text), job_.results, true, "job.tolerance"});
    }

    /// Single precision is told by the first block.
    void choose_tolerance(const jobs::BlockOfRows& first, VerifyOptions& options) {
        if (job_.tolerance) options.tolerance = *job_.tolerance;
        if (job_.tolerance || options.exact) return;
        const Claims claims = claims_of(first);
        cut_ = are_cut_to_six_digits(claims);
        if (cut_)
            return guess(
                "values have six digits: what was cut off counts as an error; let the tool write 17 digits, of "
                "coordinates as well, or see job.tolerance");
        if (!are_floats(claims)) return;
        options.tolerance = tolerance_of_floats;
        guess(
            "values are single precision: errors up to 1e-6 of the range count as right; job.tolerance says otherwise");
    }

    Claims claims_of(const jobs::BlockOfRows& block) const {
        return jobs::claims_of(columns_, block.rows.carried, mesh_, job_, block.first);
    }

    void compare() {
        const jobs::RowSource rows = jobs::rows_of_points(source_);
        jobs::BlockPipeline blocks(rows, job_.options.threads, report_.seconds);
        const jobs::BlockOfRows& first = blocks.first();
        blocks.locate_in(*locator_);
        VerifyOptions options = job_.options;
        options.threads = 1;  // blocks go side by side
        choose_tolerance(first, options);
        const ClaimedBlock asked_first{first.rows.points, claims_of(first)};
        const Verifier verifier(*sampler_, options);
        report_.ranges = verifier.ranges();
        report_.relative_to = verifier.relative_to();
        report_.tolerance = options.tolerance;
        report_.exact = options.exact;
        report_.outside_value = options.outside_value;
        report_.verdicts.columns.resize(report_.columns.size());
        const auto work = [&](jobs::BlockOfRows& block) {
            const Claims claims = claims_of(block);
            block.found = verdicts_of(verifier, block.rows.points, claims, block.first);
        };
        const auto write = [&](const jobs::BlockOfRows& block) {
            report_.verdicts.add(block.found, job_.options.examples);
            jobs::tell_stage(job_, "rows", block.first + block.size);
        };
        blocks.run(work, write);
        Stopwatch watch;
        Verifier(*sampler_, job_.options).measure(report_.verdicts).value();
        for (const Note& note : source_->notes()) {
            // Which columns are not compared has been told.
            if (note.kind != Note::Kind::left_out) report_.notes.push_back(note);
        }
        note_iteration();
        if (report_.verdicts.wrong() != 0) note_other_interpolation(asked_first, verifier, options);
        report_.seconds.sample += watch.lap();
    }

    static Verdicts verdicts_of(const Verifier& verifier, const std::vector<double>& points, const Claims& claims,
                                std::uint64_t first) {
        return verifier.verify({points, claims.cells, claims.inside, claims.values, first}).value();
    }

    /// Whether the other interpolation explains what is wrong in the first block.
    void note_other_interpolation(const ClaimedBlock& asked, const Verifier& own, const VerifyOptions& options) {
        if (mesh_.shapes.types.empty() && mesh_.is_listed()) return;
        const CellInterpolation is = locator_->interpolation();
        const CellInterpolation other =
            is == CellInterpolation::linear ? CellInterpolation::multilinear : CellInterpolation::linear;
        BuildOptions build = jobs::build_options(job_, job_.options.threads, Prove::never);
        build.interpolation = other;
        const Locator locator = Locator::build(mesh_, build).value();
        if (locator.interpolation() == is) return;
        const Sampler sampler = Sampler::build(locator, columns_.fields).value();
        const std::uint64_t wrong = verdicts_of(own, asked.points, asked.claims, 0).wrong();
        const std::uint64_t left = verdicts_of(Verifier(sampler, options), asked.points, asked.claims, 0).wrong();
        if (4 * left >= wrong) return;
        report_.notes.push_back(
            {Note::Kind::guessed,
             fmt::format("these values are those of {} interpolation: by it {} of the first {} are wrong, by {} "
                         "interpolation {}; see job.cell_interpolation",
                         name(other), left,
                         jobs::counted(asked.points.size() / static_cast<std::size_t>(mesh_.dimension), "row"),
                         name(is), wrong),
             job_.results, true, "job.cell_interpolation"});
    }

    /// Curved sides and cut digits explain errors of that size as well, and are told.
    void note_iteration() {
        const std::vector<ValueErrors>& columns = report_.verdicts.columns;
        if (mesh_.mid_nodes.empty() || report_.curved.cells != 0 || cut_ || report_.verdicts.wrong_value == 0 ||
            !std::all_of(columns.begin(), columns.end(), may_be_of_iteration))
            return;
        double most = 0;
        for (const ValueErrors& e : columns) most = std::max(most, e.max_relative);
        guess(
            fmt::format("the errors are of the size of an iterative solver's tolerance: the largest is {:.2g} of the "
                        "range, and few are as small as rounding; a tool that finds points in second-order cells by "
                        "iteration leaves such errors (VTK stops at 1e-5); job.tolerance 1e-4 counts them as right",
                        most));
    }

    const VerifyJob& job_;
    Mesh mesh_;
    jobs::ClaimedColumns columns_;
    std::unique_ptr<PointSource> source_;
    std::optional<Locator> locator_;
    std::optional<Sampler> sampler_;
    bool cut_ = false;  ///< values have six digits
    VerifyReport report_;
};

}  // namespace

Result<VerifyReport> verify_files(const VerifyJob& job) try {
    const base::RunFiles run;
    if (job.cell_base != 0 && job.cell_base != 1)
        refuse_member("option.value", "job.cell_base", "", "job.cell_base", "0 or 1", std::to_string(job.cell_base));
    jobs::check_files(job, {{"job.results", job.results}}, {});
    const jobs::ThreadLimit limit(job.options.threads);
    return Verification(job).run();
} catch (const Exception& e) {
    return e.error();
}

Result<VerifyLimit> parse_verify_limit(std::string_view text) {
    const ExactEnvironment environment;
    const base::NamedLimit limit = base::named_limit(text);
    std::vector<std::string> names;
    for (const RowVerdict kind : kinds_of_wrong) {
        names.emplace_back(handle(kind));
        if (names.back() == limit.name && limit.most && std::floor(*limit.most) == *limit.most && *limit.most <= 0x1p53)
            return VerifyLimit{kind, static_cast<std::uint64_t>(*limit.most)};
    }
    return file_error("rule.unknown", "", "unknown rule", "missed, invented, wrong_cell or wrong_value, perhaps >COUNT",
                      '"' + std::string(text) + '"', base::did_you_mean(limit.name, names));
}

}  // namespace barycert
