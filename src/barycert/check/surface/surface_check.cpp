// The check of surfaces and PLCs: its stages, in their order.

#include <tbb/task_group.h>

#include <chrono>

#include "barycert/check/surface/parts.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/polygons/triangles.hpp"

namespace barycert {

using namespace check;

namespace {

using Fault = io::PlcTriangles::Fault;
using FaultKind = surface::FacetFault::Kind;

const char* detail(FaultKind kind) {
    return kind == FaultKind::flat     ? "all on one line"
           : kind == FaultKind::folded ? "folded: two nodes at one place of its plane"
                                       : "segments that cross";
}

class SurfaceCheck {
public:
    SurfaceCheck(const Surface& surface, const CheckOptions& options, const Plc* plc, CheckReport& report)
        : options_(options),
          plc_(plc),
          report_(report),
          defects_(options.examples, report.measures.defects),
          parts_{surface, options, report, defects_} {}

    void add(const std::vector<Fault>& faults) {
        for (const auto& [facet, fault] : faults) {
            const auto& n = fault.nodes;
            if (fault.kind == FaultKind::on_segment) {
                defects_.add(DefectKind::node_on_facet, {.nodes = {n[0], -1, -1}, .other_nodes = {n[1], n[2], -1}});
            } else {
                defects_.add(
                    DefectKind::bad_facet,
                    {.nodes = {n[0], n[1], -1}, .detail = detail(fault.kind), .other_nodes = {n[2], n[3], -1}});
            }
        }
    }

    Verdict run() {
        const Surface& s = parts_.surface;
        if (s.dimension != 3 || s.points.size() % 3 != 0 || s.cells.size() % 3 != 0 || s.point_count() > INT32_MAX ||
            s.cell_count() > std::size_t{1} << 29) {
            defects_.add(DefectKind::bad_structure, {.detail = "arrays that are no points and triangles in space"});
        } else {
            check_all();
        }
        // --fix is for meshes.
        defects_[DefectKind::coincident_nodes].better_remedy = "none needed: nodes at one place count as one";
        defects_[DefectKind::near_nodes].better_remedy = "merge them in the program that made the surface";
        report_.defects = std::move(defects_).list();
        const bool whole = std::ranges::none_of(report_.defects, &Defect::breaks);
        return whole && parts_.found.closed ? Verdict::certified : Verdict::not_certified;
    }

private:
    void stage(const char* name) const {
        if (!options_.progress) return;
        options_.progress(name);
        ExactEnvironment::renew();
    }
    bool enough() const {
        return options_.verdict_only && defects_.has([](const DefectText& t) { return t.breaks; });
    }

    void check_all() {
        stage("triangles");
        if (!check_triangles(parts_) || enough()) return;
        stage("intersections");
        // What one thread does alone is done beside the rest.
        tbb::task_group beside;
        beside.run([&] { link_triangles(parts_); });
        const std::vector<CellPair> pairs = find_intersections(parts_);
        beside.wait();
        if (enough()) return;
        parts_.embedded = !defects_.has([](const DefectText& t) { return t.breaks; });
        stage("edges and nodes");
        connect_triangles(parts_);
        if (plc_ != nullptr) {
            stage("segments");
            check_segments(parts_, *plc_);
        }
        stage("shells and regions");
        measure_regions(parts_, plc_);
        // Inside the region that a PLC bounds, facets may be open.
        const bool bounds = plc_ != nullptr && !parts_.found.regions.empty();
        if (!bounds) defects_[DefectKind::open_edge].cause = true;
        if (bounds) parts_.found.closed = true;
        if (options_.verdict_only) return;
        stage("cracks");
        find_surface_cracks(parts_);
        stage("witnesses");
        for (std::size_t i = 0; i < std::min(pairs.size(), options_.contacts); ++i)
            report_.contacts.push_back(common_part(parts_.surface, pairs[i]));
    }

    const CheckOptions& options_;
    const Plc* plc_;
    CheckReport& report_;
    DefectList defects_;
    SurfaceParts parts_;
};

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
        SurfaceCheck check(surface, options, plc, report);
        check.add(faults);
        return check.run();
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
    CheckReport report;
    const io::PlcTriangles cut = io::triangles_of(plc);
    report.certificate = Certificate(run_check(cut.surface, cut.faults, &plc, options, report));
    return report;
}

}  // namespace barycert
