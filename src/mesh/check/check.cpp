#include "barycert/check.hpp"

#include <tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/not_finite.hpp"
#include "core/base/disjoint_sets.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/consistency.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {

using namespace check;

namespace {

/// Sets of usable cells connected over facets.
std::uint64_t count_parts(const Checked& c) {
    base::DisjointSets parts(c.usable.size());
    for (std::size_t i = 0; i < c.neighbours.size(); ++i) {
        const std::size_t cell = i / c.mesh.corners();
        if (const Mesh::Index other = c.neighbours[i]; other > static_cast<Mesh::Index>(cell))
            parts.join(cell, static_cast<std::size_t>(other));
    }
    std::uint64_t count = 0;
    for (std::size_t cell = 0; cell < c.usable.size(); ++cell)
        count += c.usable[cell] != 0 && parts.find(cell) == cell ? 1 : 0;
    return count;
}

/// Overlapping pairs first, then those whose boundary facets touch; each with a common point.
std::vector<CellContact> contacts(const Checked& c, std::vector<CellPair> overlapping, std::vector<CellPair> touching) {
    std::vector<CellPair> pairs;
    for (auto* list : {&overlapping, &touching}) {
        for (CellPair& p : *list) std::ranges::sort(p);
        std::ranges::sort(*list);
        for (const CellPair& p : *list) {
            // One of the parts of two cells: users know the cells.
            const auto same_cells = [&](const CellPair& other) {
                return std::ranges::equal(
                    p, other, {}, [&](Mesh::Index part) { return c.mesh.cell_number(part); },
                    [&](Mesh::Index part) { return c.mesh.cell_number(part); });
            };
            if (std::ranges::none_of(pairs, same_cells) && pairs.size() < c.options.contacts) pairs.push_back(p);
        }
    }
    std::vector<CellContact> all;
    for (const CellPair& p : pairs) {
        if (!c.degenerate(p[0]) && !c.degenerate(p[1])) all.push_back(common_part(c.mesh, p));
    }
    return all;
}

/// Arrays whose sizes do not make whole nodes or cells: nothing else can be said of such a mesh.
const char* fault_of_sizes(const Mesh& mesh) {
    if (mesh.dimension != 2 && mesh.dimension != 3) return "the dimension is neither 2 nor 3";
    if (!mesh.is_listed()) return mesh::not_listed;
    if (mesh.points.size() % static_cast<std::size_t>(mesh.dimension) != 0)
        return "the number of coordinates is not a multiple of the dimension";
    if (mesh.cells.size() % mesh.corners() != 0)
        return "the number of vertex indices is not a multiple of the vertices of a cell";
    // Corners of boundary facets are counted in 32 bits: 3 * 4 * 2^28 of them.
    if (mesh.point_count() > INT32_MAX || mesh.cell_count() > std::size_t{1} << 28)
        return "more than 2147483647 nodes or 268435456 cells, which this check cannot count";
    return nullptr;
}

/// How many cells with each defect that breaks the certificate are curved.
CurvedCells note_curved_cells(const Mesh& mesh, bool exact, CheckReport& report) {
    std::vector<std::uint8_t> each;
    const CurvedCells curved = curved_cells(mesh, &each, exact);
    const std::size_t known = std::min(each.size(), report.measures.defects.size());
    for (Defect& defect : report.defects) {
        if (!defect.breaks()) continue;
        for (std::size_t cell = 0; cell < known; ++cell)
            defect.curved_cells += each[cell] != 0 && (report.measures.defects[cell] & defect_bit(defect.kind)) != 0;
    }
    return curved;
}

/// Where the cause of what breaks the certificate is known.
void tell_remedies(DefectList& defects) {
    const bool merge = defects[DefectKind::coincident_nodes].cause || defects[DefectKind::near_nodes].cause;
    const bool split = defects[DefectKind::hanging_node].count != 0 || defects[DefectKind::near_hanging].cause;
    if (!merge && !split) return;
    constexpr std::string_view merging = "merge the coincident and near nodes below";
    constexpr std::string_view splitting = "split the cells at the hanging nodes below";
    constexpr std::string_view both =
        "merge coincident and near nodes, and split the cells at hanging nodes: both below";
    defects[DefectKind::boundary_contact].better_remedy = merge && split ? both : merge ? merging : splitting;
    defects[DefectKind::nested_part].better_remedy =
        "first merge nodes or split cells as said below; remove a part that lies inside another one even then";
    defects[DefectKind::overlapping_cells].better_remedy =
        "remove the other defects, those below included: this one follows from them";
}

void check_boundary_and_pairs(Checked& c, bool proved) {
    c.stage("boundary");
    const std::vector<std::uint32_t> pieces = check_boundary(c);
    if (c.enough()) return;
    BoundaryContacts touching;
    std::vector<CellPair> meeting;
    if (!proved) {
        c.stage("contacts of the boundary");
        const std::size_t limit = c.options.verdict_only ? 1 : pair_limit;
        touching = find_boundary_contacts(c, limit);
        if (c.enough()) return;
        meeting = find_nested_parts(c, pieces, limit);
    }
    check_files(c);
    if (c.enough()) return;
    std::vector<CellPair> overlapping;
    // One of P2 to P4 fails, or a cell is left out of them; otherwise the theorem says that there is none.
    if (c.defects.has([](const DefectText& t) { return t.breaks && t.condition != "P5"; })) {
        c.stage("overlapping cells");
        overlapping = find_overlapping_cells(c);
    }
    if (!c.options.verdict_only) {
        meeting.insert(meeting.end(), touching.cells.begin(), touching.cells.end());
        meeting.insert(meeting.end(), overlapping.begin(), overlapping.end());
        find_cracks(c, touching, meeting);
        tell_remedies(c.defects);
    }
    c.report.contacts = contacts(c, std::move(overlapping), std::move(touching.cells));
}

void check_all(Checked& c) {
    c.stage("nodes");
    check_nodes(c);
    c.stage("cells");
    check_cells(c);
    if (c.enough()) return;
    c.stage("facets");
    const bool proved = check_facets(c);
    if (c.enough()) return;
    // Steps that one thread does alone run beside the rest.
    tbb::task_group parts;
    if (!c.options.verdict_only) parts.run([&] { c.report.parts = count_parts(c); });
    check_boundary_and_pairs(c, proved);
    parts.wait();
    // Last, as it says nothing of where cells lie: what is certified is accepted by all who ask for a whole mesh.
    if (const char* fault = mesh::inconsistency_of_extras(c.mesh, mesh::FieldValues::any); fault != nullptr)
        c.defects.add(DefectKind::unfit_array, {.detail = fault});
    if (c.enough()) return;
    if (!c.options.verdict_only) c.report.maps = check_maps(c);
    if (c.options.delaunay) {
        c.stage("Delaunay");
        c.report.delaunay = check_delaunay(c);
    }
    if (c.options.plc != nullptr && c.mesh.dimension == 3) {
        c.stage("conformity");
        c.report.conformity = check_conformity(c);
    }
}

Verdict verdict_of(const Mesh& mesh, CheckRun findings) {
    if (const char* fault = fault_of_sizes(mesh); fault != nullptr) {
        findings.defects.add(DefectKind::bad_structure, {.detail = fault});
        return findings.report_defects();
    }
    Checked checked{std::move(findings), mesh};
    check_all(checked);
    return checked.report_defects();
}

}  // namespace

const Defect* CheckReport::find(DefectKind problem) const {
    const auto f = std::ranges::find(defects, problem, &Defect::kind);
    return f == defects.end() ? nullptr : &*f;
}

CheckReport check_mesh(const Mesh& mesh, const CheckOptions& options) {
    const ExactEnvironment environment;
    const auto start = std::chrono::steady_clock::now();
    CheckReport report;
    report.dimension = mesh.dimension;
    report.threads = base::threads_of(options.threads);
    // Cells of a dimension that is none cannot be counted: their corners can.
    base::in_arena(options.threads, mesh.cells.size(), [&] {
        report.certificate = Certificate(verdict_of(mesh, {options, report}), mesh);
    });
    if (mesh.dimension == 2 || mesh.dimension == 3) {
        report.nodes = mesh.point_count();
        report.cells = mesh.cell_count();
        report.shapes = mesh.shapes.count();
        if (mesh.cell_numbers.size() == mesh.cell_count()) report.cell_numbers = mesh.cell_numbers;
    }
    report.curved = note_curved_cells(mesh, options.curved == Curved::exact, report);
    report.notes = mesh.notes;
    report.not_finite = not_finite_values(mesh);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

}  // namespace barycert
