#include <algorithm>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "generated_mesh.hpp"
#include "sample_contest.hpp"
#include "sample_rounds.hpp"
#include "sample_verify.hpp"

namespace barycert::bench {
namespace {

/// One size: its mesh, and what is timed on it.
struct Size {
    Size(int n, std::size_t points)
        : subject("generated", jittered_cube(n, 7), std::max(points, static_cast<std::size_t>(3) * n * n * n), 2),
          locator(demand_value(Locator::build(subject.mesh))),
          sampler(demand_value(Sampler::build(locator, {{&subject.linear}}))) {
        require(locator.method() == Method::walk, "no walk on " + subject.name);
        demand_done(sampler.sample(subject.points, options(1), rows));
        require(rows.counts.locations.outside == 0, "a point of the cube is outside " + subject.name);
        verify_rows(subject, rows);
    }

    /// The first of them, or so many as there are cells for two.
    std::span<const double> first(std::size_t points) const { return std::span(subject.points).first(3 * points); }
    std::size_t half_the_cells() const { return subject.mesh.cell_count() / 2; }

    Subject subject;
    Locator locator;
    Sampler sampler;
    Table rows;
};

std::string per_cell(double value, std::size_t cells, const char* unit) {
    return with_unit(value / static_cast<double>(cells), unit);
}

}  // namespace

void run_growth(std::span<const int> sizes, std::size_t point_count, const RoundOptions& how, SampleTable& table) {
    std::vector<std::unique_ptr<Size>> all;  // all of them at once, so that they can take turns
    Contest contest;
    for (const int n : sizes) {
        std::fprintf(stderr, "generating, checking and verifying %d cells ...\n", 6 * n * n * n);
        all.push_back(std::make_unique<Size>(n, point_count));
        Size& size = *all.back();
        const std::string name = size.subject.name;
        contest.add("sample, " + name, [&size, point_count] {
            demand_done(size.sampler.sample(size.first(point_count), options(1), size.rows));
        });
        contest.add("locate, " + name, [&size, point_count] {
            size.rows.cells.resize(point_count);
            size.rows.features.resize(point_count);
            demand_done(size.locator.locate(size.first(point_count), size.rows.cells, size.rows.features, nullptr, 1));
        });
        contest.add("dense, " + name, [&size] {
            demand_done(size.sampler.sample(size.first(size.half_the_cells()), options(1), size.rows));
        });
        contest.add("build, " + name, [&size] { demand_value(Locator::build(size.subject.mesh)); });
    }
    contest.run(how.repetitions);
    const auto points = static_cast<double>(point_count);
    for (const auto& size : all) {
        const std::string& name = size->subject.name;
        const std::size_t cells = size->subject.mesh.cell_count();
        table.add(
            {.what = name + ": a random point, found and interpolated",
             .ours = with_unit(1e9 * contest.cpu("sample, " + name) / points, "ns"),
             .ratio = with_unit(contest.cpu_ratio("sample, " + name, "sample, " + all.front()->subject.name), "x") +
                      " the smallest"});
        table.add(
            {.what = name + ": found alone",
             .ours = with_unit(1e9 * contest.cpu("locate, " + name) / points, "ns"),
             .ratio = with_unit(contest.cpu_ratio("locate, " + name, "locate, " + all.front()->subject.name), "x") +
                      " the smallest"});
        // The same number of points a cell on every mesh, and so a quotient of times a point.
        const auto dense = [&](const Size& of) {
            return contest.cpu("dense, " + of.subject.name) / static_cast<double>(of.half_the_cells());
        };
        table.add({.what = name + ": one point for two cells, found and interpolated",
                   .ours = with_unit(1e9 * dense(*size), "ns"),
                   .ratio = with_unit(dense(*size) / dense(*all.front()), "x") + " the smallest"});
        table.add({.what = name + ": locator built, per cell",
                   .ours = per_cell(1e9 * contest.cpu("build, " + name), cells, "ns") + ", " +
                           per_cell(static_cast<double>(size->locator.bytes()), cells, "bytes")});
    }
    table.demand("growth of a query from " + in_thousands(all.front()->subject.mesh.cell_count()) + " to " +
                     in_thousands(all.back()->subject.mesh.cell_count()) + " cells",
                 contest.cpu_ratio("sample, " + all.back()->subject.name, "sample, " + all.front()->subject.name), 1.5,
                 true);
}

}  // namespace barycert::bench
