/// All that a Sampler keeps.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "barycert/locate/locator_data.hpp"
#include "barycert/sample/points/value_lanes.hpp"
#include "barycert/sampler.hpp"

namespace barycert::sample {

/// Rows of a block of points in the order in which they are found, each a Location and its values side by side: to be
/// read at random.
struct PackedRows {
    locate::Buffer<double> numbers;
    std::vector<double> distances;
};

struct SamplerData {
    std::unique_ptr<const Locator> own_locator;  ///< unless it is somebody else's
    const Locator* locator = nullptr;
    std::vector<const Field*> point_fields, cell_fields;  ///< columns are those of the former, then of the latter
    std::vector<TableField> fields;
    std::vector<std::string> columns;
    std::size_t point_components = 0;
    bool quadratic = false;

    // Linear cells: values of point fields in the order of the locator's nodes.
    locate::Buffer<locate::NodeRecord> nodes;
    locate::Buffer<ValueRecord> more;
    // Quadratic ones: component c of node i of the mesh at values[point_components * i + c].
    std::vector<double> values;

    locate::Pool<PackedRows> rows;  ///< up to 16 MiB a thread for one column

    const locate::LocatorData& located() const { return locator->data(); }
    const locate::CellIndex& index() const { return locator->data().index; }
    NodeValues node_values() const {
        return {nodes.data(), more.data(), index().original_node.size(), point_components};
    }
    /// Component c of the point fields at a node, by place.
    double value_at(std::size_t node, std::size_t c) const {
        if (c == 0) return nodes[node].value;
        return more[(c - 1) / 4 * index().original_node.size() + node].value[(c - 1) % 4];
    }
};

}  // namespace barycert::sample
