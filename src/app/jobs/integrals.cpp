#include "app/jobs/integrals.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "app/jobs/job_files.hpp"
#include "app/jobs/sampled_mesh.hpp"
#include "app/jobs/stream.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"
#include "core/base/text.hpp"
#include "core/integer.hpp"
#include "core/scaled_double.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/index/exact_volumes.hpp"
#include "mesh/sample/quantity/quantities.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::jobs {
namespace {

using core::Integer;
using sample::name_of;

/// In the units of volumes and values.
struct PartialIntegral {
    Integer sum;
    std::uint64_t left_out = 0;
};

/// Means over cells, times `denominator`, are sums of weight times value over their entities.
struct MeanRule {
    std::size_t corners;             ///< nodes of the cell; 0: the value is that of the cell
    std::int64_t of_corner, of_mid;  ///< weights
    std::uint64_t denominator;
};

/// The rule for linear and quadratic functions on a simplex: their integrals over it are known in terms of nodal
/// values.
MeanRule rule_of_nodes(const Mesh& mesh) {
    if (mesh.mid_nodes.empty()) return {mesh.corners(), 1, 0, mesh.corners()};
    return mesh.dimension == 2 ? MeanRule{3, 0, 1, 3} : MeanRule{4, -1, 4, 20};
}

/// The integral of the numbers values[first + step * entity]. Exact, and rounded once.
std::pair<double, std::uint64_t> integral(const Mesh& mesh, const std::vector<double>& values, std::size_t first,
                                          std::size_t step, const MeanRule& rule) {
    const check::ExactVolumes volumes(mesh.dimension, mesh.points);
    core::Unit unit;
    for (std::size_t i = first; i < values.size(); i += step) {
        if (std::isfinite(values[i])) unit.add(values[i]);
    }
    const std::size_t corners = mesh.corners(), mids = mesh.dimension == 2 ? 3 : 6;
    const auto add_cell = [&](std::size_t c, PartialIntegral& part) {
        const Integer volume = volumes.cell(check::corner_points(mesh, c).data());
        if (volume.sign() == 0) return;
        Integer sum;
        bool finite = true;
        const auto add = [&](std::int64_t weight, std::size_t entity) {
            if (weight == 0) return;
            const double value = values[first + step * entity];
            finite = finite && std::isfinite(value);
            if (!finite) return;
            const Integer factor(weight < 0, static_cast<std::uint64_t>(std::abs(weight)), 0);
            sum = sum + factor * unit.integer(value);
        };
        if (rule.corners == 0) add(1, c);
        for (std::size_t i = 0; i < rule.corners; ++i)
            add(rule.of_corner, static_cast<std::size_t>(mesh.cells[corners * c + i]));
        for (std::size_t i = 0; i < (rule.of_mid == 0 ? 0 : mids); ++i)
            add(rule.of_mid, static_cast<std::size_t>(mesh.mid_nodes[mids * c + i]));
        if (!finite) {
            ++part.left_out;
        } else {
            const Integer product = volume * sum;
            part.sum = volume.sign() < 0 ? part.sum - product : part.sum + product;
        }
    };
    const PartialIntegral whole = base::parallel_reduce(
        mesh.cell_count(), 1 << 12, PartialIntegral(),
        [&](std::size_t begin, std::size_t end, PartialIntegral& part) {
            for (std::size_t c = begin; c != end; ++c) add_cell(c, part);
        },
        [](PartialIntegral& all, const PartialIntegral& part) {
            all.sum = all.sum + part.sum;
            all.left_out += part.left_out;
        });
    const Integer denominator(false, (mesh.dimension == 2 ? 2 : 6) * rule.denominator, 0);
    return {core::round_quotient(whole.sum, denominator, volumes.unit() + unit.power()), whole.left_out};
}

/// The columns of cell fields that are sampled as they are; their integrals over the mesh go into the report.
std::vector<std::size_t> integrate_source(SampledMesh& mesh) {
    std::vector<std::size_t> columns;
    std::size_t first = 0;
    for (const TableField& field : mesh.sampler().fields()) {
        const auto components = static_cast<std::size_t>(field.components);
        const auto chosen = std::find_if(mesh.fields().begin(), mesh.fields().end(), [&](const FieldChoice& choice) {
            return choice.of_cells && choice.steps.empty() && name_of(choice) == field.name;
        });
        for (std::size_t k = 0; chosen != mesh.fields().end() && k < components; ++k) {
            FieldIntegral of;
            of.column = mesh.sampler().columns()[first + k];
            std::tie(of.source, of.source_left_out) =
                integral(mesh.mesh(), chosen->field->data, k, components, {0, 0, 0, 1});
            mesh.report.integrals.push_back(of);
            columns.push_back(first + k);
        }
        first += components;
    }
    return columns;
}

}  // namespace

void note_cell_fields(SampledMesh& mesh, bool of_series) {
    std::vector<std::string> names, made;
    for (const FieldChoice& choice : mesh.fields()) {
        if (choice.of_cells) names.push_back(name_of(choice));
        if (choice.of_cells && !choice.steps.empty()) made.push_back(name_of(choice));
    }
    if (names.empty()) return;
    std::string without;
    if (!made.empty()) without = "; integrals are printed of whole fields, not of " + listed(made, base::quoted);
    if (of_series) without = "; their integrals are printed for one step alone: job.step N";
    mesh.report.notes.push_back({Note::Kind::converted,
                                 counted(names.size(), "field") +
                                     " of cells into values at nodes, each that of the cell that owns the node: " +
                                     listed(names, base::quoted) + without,
                                 mesh.job.mesh, true, of_series ? "job.step" : ""});
}

Sink with_integrals(SampledMesh& mesh, const Mesh& other, const std::function<Sink()>& open) {
    const std::vector<std::size_t> columns = integrate_source(mesh);
    if (columns.empty()) return open();
    struct Kept {
        Mesh geometry;
        std::vector<double> values;  ///< of these columns, node after node
        Sink sink;
    };
    const auto kept = std::make_shared<Kept>();
    kept->geometry.dimension = other.dimension;
    kept->geometry.points = other.points;
    kept->geometry.cells = other.cells;
    kept->geometry.mid_nodes = other.mid_nodes;
    kept->sink = open();
    const auto write = [kept, columns](const TableView& rows) {
        const std::size_t all = rows.row_count() == 0 ? 0 : rows.values.size() / rows.row_count();
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            for (const std::size_t column : columns) kept->values.push_back(rows.values[all * i + column]);
        }
        return kept->sink->write(rows);
    };
    return sink_of(write, [kept, count = columns.size(), &report = mesh.report] {
        for (std::size_t k = 0; k < count; ++k) {
            FieldIntegral& of = report.integrals[k];
            std::tie(of.target, of.target_left_out) =
                integral(kept->geometry, kept->values, k, count, rule_of_nodes(kept->geometry));
        }
        return kept->sink->commit();
    });
}

}  // namespace barycert::jobs
