#include "barycert/report.hpp"

#include <cmath>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/common/not_finite.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace {

std::string plural(std::uint64_t n, std::string_view one, std::string_view more) {
    return fmt::format("{} {}", n, n == 1 ? one : more);
}

std::string line(std::string_view name, const std::string& text) {
    return fmt::format("{:<10} {}\n", name, text);
}

std::string inside(const LocationCounts& n) {
    std::string text = std::to_string(n.inside());
    if (n.inside() != 0)
        text += fmt::format(": {} in the interior of a cell, {} on a face, {} on an edge, {} at a vertex", n.interior,
                            n.face, n.edge, n.vertex);
    return text;
}

/// How many points were found in which way.
std::string ways(const WayCounts& n) {
    std::vector<std::string> all;
    const auto add = [&](std::uint64_t count, std::string_view how) {
        if (count != 0) all.push_back(fmt::format("{} {}", count, how));
    };
    add(n.walk, "by a walk");
    add(n.contested, "in contested cells");
    add(n.candidates, "by testing every candidate");
    add(n.no_cell_near, "outside at once, no cell is near");
    return fmt::format("{}", fmt::join(all, "; "));
}

/// What became of points outside.
std::string outside(const SampleReport& summary, const Colours& paint) {
    const SampleCounts& n = summary.counts;
    const std::uint64_t count = n.locations.outside;
    if (count == 0) return "0";
    std::vector<std::string> fates;
    const auto far = [&] { return fmt::format("max distance {:.4g}", n.farthest); };
    if (n.snapped != 0)
        fates.push_back(fmt::format("{} snapped to the nearest point of the mesh, {}", n.snapped, far()));
    if (n.extrapolated != 0)
        fates.push_back(fmt::format("{} extrapolated from the nearest cell, {}", n.extrapolated, far()));
    if (const std::uint64_t strange = n.locations.not_finite; strange != 0)
        fates.push_back(fmt::format("{} not finite, got NaN", strange));
    if (const std::uint64_t without = n.without_value - n.locations.not_finite; without != 0) {
        const bool limited = summary.outside.kind == Outside::nearest;
        const std::string what =
            summary.outside.kind == Outside::fill ? "got " + base::shortest(summary.outside.fill) : "got NaN";
        fates.push_back(fmt::format("{} {}{}", without, what,
                                    limited ? ", farther than " + base::shortest(summary.outside.limit) : ""));
    }
    return paint.bold(fmt::format("{}: {}", count, fmt::join(fates, "; ")));
}

std::string values(const SampleReport& summary) {
    if (summary.columns.empty()) return "none: the mesh has no fields, and --field was not given";
    if (summary.rounding == Rounding::plain) return "plain double, by --rounding plain; cells and features are exact";
    const TierCounts& t = summary.counts.values;
    std::string text = fmt::format("exact{}, rounded once", for_straight_sides(summary.curved));
    if (t.cases() != 0)
        text += fmt::format("; decided by the filter {}, by double-double {}, by integers {}", t.filter,
                            t.double_double, t.exact);
    return text;
}

std::string picture(const SliceCounts& n) {
    if (std::isnan(n.low)) return "nothing drawn: no point has a finite value";
    std::string text = fmt::format("colours from {} to {}", base::shortest(n.low), base::shortest(n.high));
    if (n.below != 0) text += fmt::format("; {} below, drawn as the first", plural(n.below, "point", "points"));
    if (n.above != 0) text += fmt::format("; {} above, drawn as the last", plural(n.above, "point", "points"));
    const std::uint64_t clear = n.outside + n.not_finite;
    return text +
           (clear == 0 ? "" : fmt::format("; {} without a value, transparent", plural(clear, "point", "points")));
}

std::string integral(const FieldIntegral& of) {
    const auto over = [](double sum, const char* where, std::uint64_t left_out) {
        std::string text = fmt::format("{} over {}", base::shortest(sum), where);
        if (left_out != 0)
            text += fmt::format(" ({} without a finite value left out)", plural(left_out, "cell", "cells"));
        return text;
    };
    return fmt::format("{}: {}, {}", base::printable(of.column), over(of.source, "MESH", of.source_left_out),
                       over(of.target, "MESH2", of.target_left_out));
}

std::string times(const SampleReport& summary) {
    const SampleSeconds& s = summary.seconds;
    std::string text = fmt::format("{:.3g} s on {}: mesh {:.3g}", s.total,
                                   plural(static_cast<std::uint64_t>(summary.threads), "thread", "threads"), s.mesh);
    text += fmt::format(", locator {:.3g}", s.build);
    if (summary.from != PointsFrom::grid) text += fmt::format(", points {:.3g}", s.read);
    text += fmt::format(", sampling {:.3g}, writing {:.3g}", s.sample, s.write);
    if (const std::uint64_t n = summary.counts.locations.points(); n != 0)
        text += fmt::format("; sampling took {} ns a point", brief_time(1e9 * s.sample / static_cast<double>(n)));
    return text;
}

}  // namespace

std::string policy_text(const OutsidePolicy& policy) {
    switch (policy.kind) {
        case Outside::nan:
            return "nan";
        case Outside::error:
            return "error";
        case Outside::fill:
            return "fill=" + base::shortest(policy.fill);
        case Outside::nearest:
            return std::isinf(policy.limit) ? std::string("nearest") : "nearest=" + base::shortest(policy.limit);
        default:
            return "extrapolate";
    }
}

std::string sample_text(const SampleReport& summary, bool colour) {
    const ExactEnvironment environment;
    const Colours paint(colour);
    std::string points = std::to_string(summary.counts.locations.points());
    if (summary.grid) {
        const Grid& g = *summary.grid;
        points += fmt::format(": a grid of {} x {}", g.counts[0], g.counts[1]);
        if (g.dimension == 3) points += fmt::format(" x {}", g.counts[2]);
    }
    if (summary.all)
        points += fmt::format(", in {}: one for each cell that holds a point", plural(summary.rows, "row", "rows"));
    std::string out = curved_lines(summary.curved, paint);
    if (const std::string onto = curved_lines(summary.onto_curved, paint); !onto.empty())
        out += line("--onto", base::printable(summary.points) + ":") + onto;
    out += line("points", points);
    out += line("inside", inside(summary.counts.locations));
    out += line("outside", outside(summary, paint));
    out += line("values", values(summary));
    if (summary.nan_values != 0)
        out += line("NaN", paint.bold(fmt::format("{} at points inside: values of nodes or cells there are not finite",
                                                  plural(summary.nan_values, "value", "values"))));
    if (const auto& steps = summary.steps; !steps.empty()) {
        std::string text =
            fmt::format("{}: {} to {}", steps.size(), base::printable(steps.front()), base::printable(steps.back()));
        if (const auto& times = summary.times; !times.empty())
            text += fmt::format(", times {} to {}", base::shortest(times.front()), base::shortest(times.back()));
        if (summary.meshes > 1)
            text += fmt::format("; on {} meshes, in each of which the points were located, and counted above",
                                summary.meshes);
        out += line("steps", text);
    }
    if (summary.picture) out += line("picture", picture(*summary.picture));
    for (const FieldIntegral& of : summary.integrals) out += line("integral", integral(of));
    std::string cells = plural(summary.cells, "cell", "cells") + ", " + plural(summary.nodes, "node", "nodes");
    if (summary.degenerate_cells != 0)
        cells += paint.bold(fmt::format("; {} degenerate and own{} nothing",
                                        plural(summary.degenerate_cells, "cell is", "cells are"),
                                        summary.degenerate_cells == 1 ? "s" : ""));
    out += line("mesh", cells);
    out += line("method", fmt::format("{}: {}", name(summary.method), summary.reason));
    if (summary.counts.locations.ways.points() != 0) out += line("found", ways(summary.counts.locations.ways));
    for (const Note& note : summary.notes) out += line("note", message(note));
    for (const NotFinite& field : summary.not_finite) out += line("note", not_finite_text(field));
    out += line("time", times(summary));
    return out;
}

}  // namespace barycert
