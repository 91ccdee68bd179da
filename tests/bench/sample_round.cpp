#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "sample_rounds.hpp"
#include "sample_verify.hpp"

namespace barycert::bench {
namespace {

using Which = VtkPeer::Which;

void tell(const std::string& who, const Comparison& found) {
    std::printf(
        "  %s: %llu points missed, %llu found that are outside; %llu values off by more than 1e-12, at most %.2g\n",
        who.c_str(), static_cast<unsigned long long>(found.missed),
        static_cast<unsigned long long>(found.found_outside), static_cast<unsigned long long>(found.off), found.worst);
}

/// A peer is free to be wrong, and is told to be; but if it is far off for many, it was not asked the same question.
void require_same_question(const Subject& subject, const std::string& who, std::span<const double> right,
                           std::span<const double> theirs) {
    std::size_t far = 0;
    for (std::size_t i = 0; i < right.size(); ++i)
        far +=
            std::isnan(right[i]) != std::isnan(theirs[i]) || std::abs(right[i] - theirs[i]) > 1e-6 * subject.max_value
                ? 1
                : 0;
    require(100 * far <= right.size(), who + " answers something else at " + std::to_string(far) + " points");
}

void verify_vtk(Round& round) {
    const Subject& subject = round.subject;
    round.vtk_static_bytes = round.vtk->build(Which::static_locator);
    round.vtk_tree_bytes = round.vtk->build(Which::cell_tree);
    for (const Which which : {Which::static_locator, Which::cell_tree}) {
        const std::string who = which == Which::cell_tree ? "vtkCellTreeLocator" : "vtkStaticCellLocator";
        std::vector<Mesh::Index> cells;
        std::vector<double> values;
        round.vtk->find(which, cells);
        round.vtk->interpolate(which, values);
        tell(who, compare(subject, round.rows.values, values));
        std::printf("    %llu of its cells do not hold the point\n",
                    static_cast<unsigned long long>(not_held(subject, corners_of(subject, cells))));
        require_same_question(subject, who, round.rows.values, values);
    }
}

/// Its triangulation is another one, so that a linear field is all that can be compared. Nodal values are off by three
/// roundings of at most 2^-53 sum |terms| each, and so is what is interpolated from them exactly, here and there; then
/// both values are rounded: they are 8 such roundings apart at most.
void verify_cgal(Round& round) {
    const Subject& subject = round.subject;
    round.cgal->build();
    round.cgal->sort(subject.points);
    round.cgal->walk();
    const auto cells = round.cgal->found();
    require(not_held(subject, cells) == 0, "CGAL's cells do not hold their points");
    double terms = 0;
    for (std::size_t i = 0; i < subject.mesh.point_count(); ++i) {
        const double* const x = subject.mesh.points.data() + 3 * i;
        terms = std::max(terms, 1.5 * std::abs(x[0]) + 2.5 * std::abs(x[1]) + std::abs(x[2]));
    }
    const std::vector<double> exact = exact_values(subject, cells);
    for (std::size_t i = 0; i < exact.size(); ++i) {
        if (std::isnan(round.rows.values[i])) continue;
        require(std::abs(exact[i] - round.rows.values[i]) <= 8 * 0x1p-53 * terms,
                "CGAL's cell of point " + std::to_string(i) + " gives another value");
    }
    std::vector<double> values;
    round.cgal->interpolate(subject.linear.data, values);
    tell("CGAL, on its own triangulation up to the convex hull, in plain double",
         compare(subject, round.rows.values, values));
}

}  // namespace

std::string joined(std::initializer_list<std::string> parts) {
    std::string out;
    for (const std::string& part : parts) out += (out.empty() || part.empty() ? "" : ", ") + part;
    return out;
}

std::string times_as_long(const Contest& contest, const char* who, const std::string& slow, const std::string& fast) {
    const double ratio = contest.cpu_ratio(slow, fast);
    return std::isnan(ratio) ? std::string() : std::string(who) + (*who != '\0' ? " " : "") + with_unit(ratio, "x");
}

void run_subject(const Subject& subject, const RoundOptions& options_, SampleTable& table) {
    Round round{.subject = subject, .how = options_, .ours = Ours(subject)};
    round.bytes = round.ours.walk.bytes();
    {
        const std::size_t before = handed_out();
        const Locator locator = demand_value(Locator::build(subject.mesh));
        round.handed_out = handed_out() - before;
    }
    verify_points(subject, round.ours, round.rows);
    verify_grid(subject, round.ours, round.grid_values);
#ifdef BARYCERT_WITH_VTK
    round.vtk = make_vtk_peer(subject.mesh, subject.linear.data, subject.points, subject.grid);
#endif
    if (round.vtk != nullptr) verify_vtk(round);
    round.cgal = std::make_unique<CgalPeer>(subject.mesh);
    verify_cgal(round);
    run_points(round, table);
    run_grid(round, table);
    run_builds(round, table);
}

}  // namespace barycert::bench
