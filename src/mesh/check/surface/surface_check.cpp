// The check of surfaces and PLCs: its stages, in their order.

#include <tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/check/surface/parts.hpp"
#include "mesh/facets/facet_triangles.hpp"
#include "mesh/facets/plc_triangles.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {

using namespace check;

namespace {

using Fault = surface::PlcTriangles::Fault;
using FaultKind = surface::FacetFault::Kind;

const char* detail(FaultKind kind) {
    return kind == FaultKind::flat     ? "all on one line"
           : kind == FaultKind::folded ? "folded: two nodes at one place of its plane"
                                       : "segments that cross";
}

void add_faults(DefectList& defects, const std::vector<Fault>& faults) {
    for (const auto& [facet, fault] : faults) {
        const auto& n = fault.nodes;
        if (fault.kind == FaultKind::on_segment) {
            defects.add(DefectKind::node_on_facet, {.nodes = {n[0], -1, -1}, .other_nodes = {n[1], n[2], -1}});
        } else {
            defects.add(DefectKind::bad_facet,
                        {.nodes = {n[0], n[1], -1}, .detail = detail(fault.kind), .other_nodes = {n[2], n[3], -1}});
        }
    }
}

void check_all(SurfaceParts& s, const Plc* plc) {
    s.stage("triangles");
    if (!check_triangles(s) || s.enough()) return;
    s.stage("intersections");
    // Steps that one thread does alone run beside the rest.
    tbb::task_group beside;
    beside.run([&] { link_triangles(s); });
    std::vector<CellPair> pairs = find_intersections(s);
    beside.wait();
    if (s.enough()) return;
    // Triangles that break S1 are left out of all else.
    s.embedded = !s.defects.has([](const DefectText& t) { return t.condition == "S2"; });
    s.stage("edges and nodes");
    connect_triangles(s);
    const std::vector<CellPair> passing = find_passing_sheets(s);
    pairs.insert(pairs.end(), passing.begin(), passing.end());
    if (plc != nullptr) {
        s.stage("segments");
        check_segments(s, *plc);
    }
    s.stage("shells and regions");
    measure_regions(s, plc);
    // Inside the region that a PLC bounds, facets may be open.
    const bool bounds = plc != nullptr && !s.found.regions.empty();
    if (!bounds) s.defects[DefectKind::open_edge].cause = true;
    if (bounds) s.found.closed = true;
    if (s.options.verdict_only) return;
    s.stage("cracks");
    find_surface_cracks(s);
    s.stage("witnesses");
    for (std::size_t i = 0; i < std::min(pairs.size(), s.options.contacts); ++i)
        s.report.contacts.push_back(common_part(s.surface, pairs[i]));
}

Verdict verdict_of(SurfaceParts s, const std::vector<Fault>& faults, const Plc* plc) {
    add_faults(s.defects, faults);
    if (s.surface.dimension != 3 || s.surface.points.size() % 3 != 0 || s.surface.cells.size() % 3 != 0 ||
        s.surface.point_count() > INT32_MAX || s.surface.cell_count() > std::size_t{1} << 29) {
        s.defects.add(DefectKind::bad_structure, {.detail = "arrays that are no points and triangles in space"});
    } else {
        check_all(s, plc);
    }
    // --fix is for meshes.
    s.defects[DefectKind::repeated_node].better_remedy = "take the node out of the polygon, or leave out the triangle";
    s.defects[DefectKind::coincident_nodes].better_remedy = "none needed: nodes at one place count as one";
    s.defects[DefectKind::near_nodes].better_remedy = "merge them in the program that made the surface";
    const Verdict verdict = s.report_defects();
    return s.found.closed ? verdict : Verdict::not_certified;
}

Verdict run_check(const Surface& surface, const std::vector<Fault>& faults, const Plc* plc, const CheckOptions& options,
                  CheckReport& report) {
    const auto start = std::chrono::steady_clock::now();
    report.threads = base::threads_of(options.threads);
    report.nodes = surface.points.size() / 3;
    report.cells = surface.cells.size() / 3;
    report.surface.emplace();
    report.surface->plc = plc != nullptr;
    report.surface->facets = plc != nullptr ? plc->facets.size() : surface.facet_total();
    report.cell_numbers = surface.facets;
    report.notes = surface.notes;
    report.measures.defects.assign(report.cells, 0);
    const Verdict verdict = base::in_arena(options.threads, report.cells, [&] {
        return verdict_of({{options, report}, surface}, faults, plc);
    });
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return verdict;
}

}  // namespace

CheckReport check_surface(const Surface& surface, const CheckOptions& options) {
    const ExactEnvironment environment;
    CheckReport report;
    report.certificate = Certificate(run_check(surface, {}, nullptr, options, report));
    return report;
}

CheckReport check_plc(const Plc& plc, const CheckOptions& options) {
    const ExactEnvironment environment;
    const surface::PlcTriangles cut = surface::triangles_of(plc);
    CheckReport report;
    report.certificate = Certificate(run_check(cut.surface, cut.faults, &plc, options, report));
    return report;
}

}  // namespace barycert
