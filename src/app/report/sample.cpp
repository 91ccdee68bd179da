// Report on a run of sampling.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/report/common/document.hpp"
#include "app/report/common/json.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/figure.hpp"
#include "barycert/grid.hpp"
#include "barycert/job.hpp"
#include "barycert/mesh.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/sampler.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "barycert/weights.hpp"
#include "core/base/text.hpp"

namespace barycert {

using namespace report;

JSON_OF(FieldIntegral, column, source, target, source_left_out, target_left_out)
JSON_OF(WayCounts, no_cell_near, walk, contested, candidates)

namespace {

void tell_inside(Document& d, const LocationCounts& n, bool surface) {
    const std::string interior = surface ? "" : fmt::format("{} in the interior of a cell, ", n.interior);
    d.figure("inside", record("count", n.inside(), MEMBERS(n, interior, face, edge, vertex)),
             surface ? "on it" : "inside",
             n.inside() == 0 ? "0"
                             : fmt::format("{}: {}{} on a face, {} on an edge, {} at a vertex", n.inside(), interior,
                                           n.face, n.edge, n.vertex));
}

/// Adds what became of points outside.
void tell_outside(Document& d, const SampleReport& s) {
    const SampleCounts& n = s.counts;
    const std::uint64_t strange = n.locations.not_finite, without = n.without_value - strange;
    const std::string far = fmt::format("max distance {:.4g}", n.farthest);
    const std::string fates = clauses(
        {{n.snapped,
          (s.surface ? "got the value at the nearest point, " : "snapped to the nearest point of the mesh, ") + far},
         {n.extrapolated, "extrapolated from the nearest cell, " + far},
         {strange, "not finite, got NaN"},
         {without,
          (s.outside.kind == Outside::fill ? "got " + base::shortest(s.outside.fill) : "got NaN") +
              (s.outside.kind == Outside::nearest ? ", farther than " + base::shortest(s.outside.limit) : "")}});
    const std::uint64_t count = n.locations.outside;
    d.figure("outside",
             record("count", count, "policy", policy_text(s.outside), MEMBERS(n, snapped, extrapolated, without_value),
                    "not_finite", strange, MEMBERS(n, farthest)),
             s.surface ? "off it" : "outside", count == 0 ? "0" : fmt::format("{}: {}", count, fates),
             count == 0 ? Tone::plain : Tone::strong);
}

void tell_values(Document& d, const SampleReport& s) {
    const TierCounts& t = s.counts.values;
    std::string text = fmt::format("exact{}, rounded once", for_straight_sides(s.curved));
    if (t.cases() != 0)
        text += fmt::format("; decided by the filter {}, by double-double {}, by integers {}", t.filter,
                            t.double_double, t.exact);
    if (s.counts.undecided != 0)
        text += fmt::format("; how the values{} of {} round is not decided: they are off by at most {:.2g}",
                            s.counts.snapped + s.counts.extrapolated != 0 ? " or distances" : "",
                            counted(s.counts.undecided, "point"), s.counts.max_off);
    if (s.counts.unmapped != 0)
        text += fmt::format("; {} got the values of the parts of cells{}: not found in their maps",
                            counted(s.counts.unmapped, "point"),
                            s.counts.extrapolated != 0 ? ", or outside those at the nearest point" : "");
    if (s.rounding == Rounding::plain) text = "plain double, by --rounding plain; cells and features are exact";
    if (s.columns.empty()) text = "none: the mesh has no fields, and --field was not given";
    d.figure("values",
             record("rounding", s.rounding == Rounding::correct ? "correct" : "plain",
                    MEMBERS(t, filter, double_double, exact), MEMBERS(s.counts, undecided, max_off, unmapped), "nan",
                    s.nan_values),
             "values", text);
    if (s.nan_values != 0)
        d.name("NaN",
               counted(s.nan_values, "value") + " at points inside: values of nodes or cells there are not finite",
               Tone::strong);
}

std::string steps_text(const SampleReport& s) {
    std::string text = fmt::format("{}: {} to {}", s.steps.size(), s.steps.front(), s.steps.back());
    if (!s.times.empty())
        text += fmt::format(", times {} to {}", base::shortest(s.times.front()), base::shortest(s.times.back()));
    if (s.meshes > 1)
        text += fmt::format("; on {} meshes, in each of which the points were located, and counted above", s.meshes);
    return text;
}

void tell_picture(Document& d, const FigureCounts& n) {
    const auto points = [](std::uint64_t count, const char* how) {
        return count == 0 ? "" : fmt::format("; {} {}", counted(count, "point"), how);
    };
    d.figure("picture", record(MEMBERS(n, low, high), MEMBERS(n.grid, drawn), MEMBERS(n, below, above)), "picture",
             std::isnan(n.low)
                 ? "nothing drawn: no point has a finite value"
                 : fmt::format("colours from {} to {}", base::shortest(n.low), base::shortest(n.high)) +
                       points(n.below, "below, drawn as the first") + points(n.above, "above, drawn as the last") +
                       points(n.grid.outside + n.grid.not_finite, "without a value"));
}

void tell_integrals(Document& d, const std::vector<FieldIntegral>& all) {
    if (all.empty()) return;
    put(d.data, "integrals", all);
    const auto over = [](double sum, const char* where, std::uint64_t left_out) {
        return fmt::format("{} over {}", base::shortest(sum), where) +
               (left_out == 0 ? "" : fmt::format(" ({} without a finite value left out)", counted(left_out, "cell")));
    };
    for (const FieldIntegral& of : all)
        d.name("integral", fmt::format("{}: {}, {}", of.column, over(of.source, "MESH", of.source_left_out),
                                       over(of.target, "MESH2", of.target_left_out)));
}

void tell_mesh(Document& d, const SampleReport& s) {
    std::string cells = s.surface ? counted(s.cells, "triangle") : cells_text(s.cells, s.simplices, s.dimension);
    cells += ", " + counted(s.nodes, "node");
    const std::string one = s.simplices != 0 ? "part" : "cell";
    if (s.degenerate_cells != 0)
        cells += fmt::format("; {} nothing", counted(s.degenerate_cells, one + " is degenerate and owns",
                                                     one + "s are degenerate and own"));
    d.name(s.surface ? "surface" : "mesh", cells, s.degenerate_cells == 0 ? Tone::plain : Tone::strong);
}

void tell_times(Document& d, const SampleReport& s) {
    const JobSeconds& t = s.seconds;
    std::vector<std::pair<std::string_view, double>> parts{
        {"mesh", t.mesh}, {"locator", t.build}, {"sampling", t.sample}, {"writing", t.write}};
    if (s.from != PointsFrom::grid) parts.insert(parts.begin() + 2, {"points", t.read});
    std::string text = time_text(t.total, s.threads, parts);
    if (const std::uint64_t n = s.counts.locations.points(); n != 0)
        text += fmt::format("; sampling took {} ns a point", brief_time(1e9 * t.sample / static_cast<double>(n)));
    d.figure("seconds", record(MEMBERS(t, mesh, build, read, sample, write, total)), "time", text);
    put(d.data, MEMBERS(s, threads));
}

Json grid_json(const Grid& g) {
    const auto axes = [&](const auto& all) { return Json(std::vector(all.begin(), all.begin() + g.dimension)); };
    return record("counts", axes(g.counts), "origin", axes(g.origin), "spacing", axes(g.spacing), "last", axes(g.last));
}

Document sample_document(const SampleReport& s, const Environment& environment) {
    Document d;
    d.data = record("schema", sample_schema, MEMBERS(s, command, mesh, curved));
    d.curved(s.curved);
    if (s.from == PointsFrom::mesh) put(d.data, MEMBERS(s, onto_curved));
    if (!message(s.onto_curved).empty()) d.name("--onto", s.points + ":");
    d.curved(s.onto_curved);
    put(d.data, MEMBERS(s, dimension, nodes, cells, degenerate_cells, contested_cells, verdict, from));
    if (s.simplices != 0) put(d.data, MEMBERS(s, simplices));
    s.grid ? put(d.data, "grid", grid_json(*s.grid)) : put(d.data, "file", s.points);
    put(d.data, MEMBERS(s, output));
    if (!s.weights.empty()) put(d.data, MEMBERS(s, weights));
    if (!s.steps.empty()) put(d.data, MEMBERS(s, steps));
    if (!s.times.empty()) put(d.data, MEMBERS(s, times, meshes));
    put(d.data, MEMBERS(s, columns, carried));

    const std::uint64_t points = s.counts.locations.points();
    std::string text = std::to_string(points);
    if (s.grid)
        text += fmt::format(": a grid of {}",
                            fmt::join(s.grid->counts.begin(), s.grid->counts.begin() + s.grid->dimension, " x "));
    if (s.all) text += fmt::format(", in {}: one for each cell that holds a point", counted(s.rows, "row"));
    d.figure("points", points, "points", text);
    put(d.data, "rows", s.rows, "on_boundary", s.all ? "all" : "lowest");
    tell_inside(d, s.counts.locations, s.surface);
    tell_outside(d, s);
    tell_values(d, s);
    if (!s.steps.empty()) d.name("steps", steps_text(s));
    if (s.picture) tell_picture(d, *s.picture);
    tell_integrals(d, s.integrals);
    tell_mesh(d, s);
    const std::string method(s.surface ? "nearest" : name(s.method));
    d.figure("method", method, "method", fmt::format("{}: {}", method, s.reason));
    put(d.data, MEMBERS(s, reason));
    if (const WayCounts& w = s.counts.locations.ways; w.points() != 0)
        d.figure("ways", w, "found",
                 clauses({{w.walk, "by a walk"},
                          {w.contested, "in contested cells"},
                          {w.candidates, "by testing every candidate"},
                          {w.no_cell_near, "outside at once, no cell is near"}}));
    put(d.data, MEMBERS(s, notes, not_finite));
    for (const Note& note : s.notes) d.name("note", message(note));
    for (const NotFinite& field : s.not_finite) d.name("note", not_finite_text(field));
    tell_times(d, s);
    put(d.data, "environment", environment);
    return d;
}

}  // namespace

std::string policy_text(const OutsidePolicy& policy) {
    constexpr std::array names{"nan", "error", "fill=", "nearest", "extrapolate"};  // by Outside
    const std::string text = names[static_cast<std::size_t>(policy.kind)];
    if (policy.kind == Outside::fill) return text + base::shortest(policy.fill);
    const bool limited = policy.kind == Outside::nearest && !std::isinf(policy.limit);
    return limited ? text + "=" + base::shortest(policy.limit) : text;
}

std::string sample_text(const SampleReport& report, bool colour) {
    return written_text([&] { return sample_document(report, {}); }, colour);
}

std::string sample_json(const SampleReport& report, const Environment& environment) {
    return written_json([&] { return sample_document(report, environment); }, 2);
}

}  // namespace barycert
