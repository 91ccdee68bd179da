// Which cells a page draws.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "barycert/report/check/check_pictures.hpp"

namespace barycert::report {
namespace {

using Cells = std::array<Mesh::Index, 2>;

/// Of exhibits with one kind of problem.
constexpr std::size_t longest_queue = 200;

/// Without cells that cannot be drawn; sorted, the second -1 if there is one.
Cells drawn_of(const Mesh& mesh, Cells cells) {
    for (Mesh::Index& c : cells) {
        const auto cell = static_cast<std::size_t>(c);  // of -1 beyond all cells
        if (cell >= mesh.cell_count() || !drawable(mesh, cell)) c = -1;
    }
    if (cells[0] == cells[1]) cells[1] = -1;
    if (cells[0] < 0 || (cells[1] >= 0 && cells[1] < cells[0])) std::swap(cells[0], cells[1]);
    return cells;
}

Exhibit of_contact(const CellContact& c, const Cells& cells) {
    return {.cells = cells,
            .what = c.overlap          ? "overlapping cells"
                    : c.dimension <= 0 ? "cells that touch in a point where they must not"
                    : c.dimension == 1 ? "cells that touch along a segment where they must not"
                                       : "cells that touch in an area where they must not",
            .contact = &c,
            .defect = true};
}

Exhibit of_place(DefectKind problem, const DefectPlace& p, const Cells& cells) {
    std::string what(defect_text(problem).name);
    std::replace(what.begin(), what.end(), '_', ' ');
    if (*p.detail != '\0') what += fmt::format(" ({})", p.detail);
    return {.cells = cells, .what = std::move(what), .defect = true};
}

}  // namespace

std::vector<Exhibit> worst_cells(const CheckReport& report, const Mesh& mesh, std::size_t max) {
    const CellMeasures& m = report.measures;
    std::vector<std::pair<double, Mesh::Index>> worst;  // a heap, the least bad on top
    for (std::size_t cell = 0; cell < m.min_angle.size(); ++cell) {
        const double angle = m.min_angle[cell];
        if (m.orientation[cell] == 0 || std::isnan(angle)) continue;
        const std::pair entry(angle, static_cast<Mesh::Index>(cell));
        if (worst.size() == max && !(entry < worst.front())) continue;
        if (!drawable(mesh, cell)) continue;
        worst.push_back(entry);
        std::push_heap(worst.begin(), worst.end());
        if (worst.size() <= max) continue;
        std::pop_heap(worst.begin(), worst.end());
        worst.pop_back();
    }
    std::sort_heap(worst.begin(), worst.end());
    std::vector<Exhibit> exhibits;
    const char* const kind = mesh.dimension == 2 ? "" : "dihedral ";
    for (const auto& [angle, cell] : worst)
        exhibits.push_back({.cells = {cell, -1}, .what = fmt::format("smallest {}angle {:.4g}°", kind, angle)});
    return exhibits;
}

std::vector<Exhibit> defect_cells(const CheckReport& report, const Mesh& mesh, std::size_t max) {
    // One queue a kind of problem; of pairs of cells, those with a witness first.
    std::vector<std::vector<Exhibit>> queues;
    const auto add = [&](Exhibit e) {
        if (e.cells[0] >= 0 && queues.back().size() < longest_queue) queues.back().push_back(std::move(e));
    };
    for (const bool overlap : {true, false}) {
        queues.emplace_back();
        for (const CellContact& c : report.contacts) {
            if (c.overlap == overlap) add(of_contact(c, drawn_of(mesh, c.cells)));
        }
    }
    for (const Defect& f : report.defects) {
        if (!f.breaks()) continue;
        queues.emplace_back();
        for (const DefectPlace& p : f.places) add(of_place(f.kind, p, drawn_of(mesh, p.cells)));
    }
    // First such as have only cells that were not shown yet; one cell may overlap many.
    std::vector<Exhibit> exhibits;
    std::set<Cells> pairs;
    std::set<Mesh::Index> cells;
    for (const bool others : {true, false}) {
        for (std::size_t round = 0; round < longest_queue; ++round) {
            for (const std::vector<Exhibit>& queue : queues) {
                if (round >= queue.size() || exhibits.size() == max) continue;
                const Exhibit& e = queue[round];
                if (pairs.contains(e.cells) ||
                    (others && (cells.contains(e.cells[0]) || (e.cells[1] >= 0 && cells.contains(e.cells[1])))))
                    continue;
                exhibits.push_back(e);
                pairs.insert(e.cells);
                cells.insert(e.cells.begin(), e.cells.end());
            }
        }
    }
    return exhibits;
}

}  // namespace barycert::report
