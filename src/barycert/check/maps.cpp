// The isoparametric maps of cells: where their Jacobians are positive, or not.
#include "barycert/check/stages.hpp"
#include "barycert/mesh/cell_maps.hpp"
#include "barycert/mesh/consistency.hpp"

namespace barycert::check {

std::optional<MapReport> check_maps(const Checked& c) {
    if ((c.mesh.shapes.types.empty() && c.mesh.mid_nodes.empty()) ||
        mesh::inconsistency_of_cells(c.mesh, mesh::FieldValues::any) != nullptr)
        return std::nullopt;
    using core::isoparametric::JacobianSign;
    const mesh::CellMaps maps(c.mesh, true, true);
    const std::vector<Mesh::Index>& parts = c.mesh.shapes.parts;
    std::vector<std::int8_t> signs(c.mesh.whole_count());
    std::vector<std::uint8_t> mapped(signs.size());
    base::parallel_for_each(signs.size(), 256, [&](std::size_t whole) {
        const auto* const reference = maps.reference(whole);
        if (reference == nullptr) return;
        mapped[whole] = 1;
        signs[whole] = static_cast<std::int8_t>(core::isoparametric::jacobian_sign(*reference, maps.places(whole)));
    });
    MapReport report;
    std::vector<std::int8_t>& of_cells = c.report.measures.jacobian;
    of_cells.assign(c.mesh.cell_count(), 0);
    for (std::size_t whole = 0; whole < signs.size(); ++whole) {
        const auto first = parts.empty() ? whole : static_cast<std::size_t>(parts[whole]);
        const auto last = parts.empty() ? whole + 1 : static_cast<std::size_t>(parts[whole + 1]);
        for (std::size_t cell = first; cell < last; ++cell)
            of_cells[cell] = mapped[whole] != 0 ? signs[whole] : c.orientation[cell];
        if (mapped[whole] == 0) continue;
        ++report.cells;
        const auto sign = static_cast<JacobianSign>(signs[whole]);
        ++(sign == JacobianSign::positive   ? report.positive
           : sign == JacobianSign::negative ? report.negative
           : sign == JacobianSign::changes  ? report.changing
                                            : report.unknown);
        const bool good = sign == JacobianSign::positive || sign == JacobianSign::negative;
        if (!good && report.examples.size() < c.options.examples)
            report.examples.push_back(static_cast<Mesh::Index>(first));
    }
    return report.cells == 0 ? std::nullopt : std::optional(report);
}

}  // namespace barycert::check
