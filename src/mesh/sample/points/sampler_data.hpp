/// All that a Sampler keeps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/locator_data.hpp"
#include "mesh/locate/pool.hpp"
#include "mesh/sample/points/value_lanes.hpp"

namespace barycert::sample {

/// Rows of a block of points in the order in which they are found: to be read at random.
struct FoundRows {
    locate::Buffer<Mesh::Index> cells;
    locate::Buffer<Feature> features;
    locate::Buffer<double> values;
    std::vector<double> distances;
};

/// A quantity that no field has, computed for each point.
struct AtPoint {
    const Field* field = nullptr;  ///< of nodes
    std::size_t first = 0;         ///< its components in a row; of a gradient, none
    std::size_t components = 1;    ///< of the field, or of its gradient
    bool gradient = false;         ///< on cells of second order
    int component = -1;            ///< that one alone, unless -1
    bool length = false;           ///< of what is left
};

struct SamplerData {
    static const SamplerData& of(const Sampler& sampler) { return *sampler.data_; }

    std::unique_ptr<const Locator> own_locator;  ///< unless it is somebody else's
    const Locator* locator = nullptr;
    std::deque<Field> made;  ///< of others
    /// Numbers of a row, `width` in all: components of point fields, of which the first `hidden` are no columns, then
    /// those of cell fields, then what is computed for each point.
    std::vector<const Field*> point_fields, cell_fields;
    std::vector<AtPoint> at_points;
    std::vector<TableField> fields;
    std::vector<std::string> columns;
    std::size_t point_components = 0, hidden = 0, width = 0;
    bool quadratic = false;
    bool finite = true;  ///< all values of point fields are

    // Linear cells: values of point fields in the order of the locator's nodes.
    locate::Buffer<locate::NodeRecord> nodes;
    locate::Buffer<ValueRecord> more;
    // Quadratic ones: component c of node i of the mesh at values[point_components * i + c].
    std::vector<double> values;

    locate::Pool<FoundRows> rows;  ///< up to 16 MiB a thread for one column

    const locate::LocatorData& located() const { return locate::LocatorData::of(*locator); }
    const locate::CellIndex& index() const { return located().index; }
    /// Nodes without values where there are none, or cells are quadratic.
    NodeValues node_values() const {
        return {nodes.size() != 0 ? nodes.data() : index().nodes.data(), more.data(), index().original_node.size(),
                point_components};
    }
    /// Whether rows have more than the values of point fields.
    bool has_rest() const { return !cell_fields.empty() || !at_points.empty(); }
    /// Component c of the point fields at a node, by place.
    double value_at(std::size_t node, std::size_t c) const { return node_values().at(node, c); }
};

/// Sets cells, features, values and counts of rows as large as there are points, in a grid whose cells are not listed.
/// Error: a policy that asks for the nearest cell; Rounding::plain.
Status sample_on_grid(const SamplerData& data, std::span<const double> points, const SampleOptions& options,
                      Table& out);

/// Removes the hidden numbers from `count` rows of `width` numbers each, so that the columns follow row after row.
inline void leave_out_hidden(const SamplerData& data, double* rows, std::size_t count) {
    const std::size_t columns = data.columns.size();
    for (std::size_t i = 0; data.hidden != 0 && i < count; ++i)
        std::copy_n(rows + data.width * i + data.hidden, columns, rows + columns * i);
}

/// Sets the values of the rows, and returns their counts, by set(begin, end, counts) for parts of them: `width` numbers
/// a row, of which the columns are left in the end.
template <class Set>
SampleCounts set_values(const SamplerData& data, int threads, std::size_t grain, Table& out, const Set& set) {
    const std::size_t count = out.cells.size();
    out.values.resize(data.width * count);
    const SampleCounts counts = base::in_arena(threads, count, [&] {
        return base::parallel_reduce(count, grain, SampleCounts{}, set,
                                     [](SampleCounts& all, const SampleCounts& part) { all.add(part); });
    });
    leave_out_hidden(data, out.values.data(), count);
    out.values.resize(data.columns.size() * count);
    return counts;
}

}  // namespace barycert::sample
