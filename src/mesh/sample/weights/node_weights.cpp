#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "core/shape_functions.hpp"
#include "mesh/locate/batch.hpp"
#include "mesh/locate/mapped/mapped_cells.hpp"
#include "mesh/locate/mapped/nearest_side.hpp"
#include "mesh/locate/near_feature.hpp"
#include "mesh/sample/points/near_piece.hpp"

namespace barycert {
namespace {

constexpr std::size_t max_nodes_of_cell = core::isoparametric::max_nodes;

class WeightRows {
public:
    WeightRows(const Locator& locator, const TableView& rows, const OutsidePolicy& outside)
        : locator_(locator), rows_(rows), outside_(outside) {}

    Result<NodeWeights> all() {
        // Cases of second order have nodes of their own, with unit vectors as values: component c is the weight of c.
        for (std::size_t i = 0; quadratic() && i < nodes_ * chunk; ++i) {
            const auto node = static_cast<Mesh::Index>(i);
            if (i < chunk) own_.push_back(node);
            (i % nodes_ < corners_ ? corner_numbers_ : mid_numbers_).push_back(node);
            for (std::size_t c = 0; c < nodes_; ++c) units_.push_back(i % nodes_ == c ? 1 : 0);
        }
        const std::size_t step = mapped_ == nullptr ? chunk : 1;
        for (std::size_t first = 0; first < rows_.cells.size(); first += step) {
            const double* const point = rows_.points.data() + d_ * first;
            if (mapped_ != nullptr && rows_.cells[first] < 0 && add_outside_maps(point)) continue;
            const bool whole = mapped_ != nullptr && mapped_->evaluates(rows_.cells[first], point);
            Status done = whole ? add_mapped(first) : add(first, std::min(first + step, rows_.cells.size()));
            if (!done) return done.error();
        }
        return std::move(out_);
    }

private:
    static constexpr std::size_t chunk = 256;
    bool quadratic() const { return !mesh_.mid_nodes.empty(); }

    Status add(std::size_t first, std::size_t last) {
        cells_.clear();
        points_.clear();
        owners_.clear();
        for (std::size_t i = first; i < last; ++i) {
            const double* const point = rows_.points.data() + d_ * i;
            Mesh::Index cell = rows_.cells[i];
            // Extrapolates the function of the nearest cell.
            if (cell < 0 && outside_.kind == Outside::extrapolate && base::all_finite({point, d_}))
                cell = nearest(point, std::numeric_limits<double>::infinity()).cell;
            owners_.push_back(cell);
            if (cell < 0) continue;
            cells_.push_back(cell);
            points_.insert(points_.end(), point, point + d_);
        }
        weights_.resize(nodes_ * cells_.size());
        TierCounts tiers;
        const MeshQueries queries{simplex_, mesh_.points, mesh_.cells, cells_, points_};
        Status done = quadratic() ? second_order(tiers) : barycentric_weights(queries, weights_, &tiers);
        if (!done) return done;
        if (tiers.degenerate != 0)
            return Error{.code = "point.degenerate", .what = "a row names a degenerate cell, which has no weights"};
        for (std::size_t i = first, inside = 0; i < last; ++i) {
            const Mesh::Index owner = owners_[i - first];
            if (owner < 0) {
                add_outside(rows_.points.data() + d_ * i);
                continue;
            }
            const sample::CellNodes nodes(mesh_, static_cast<std::size_t>(owner));
            add_row(nodes.begin(), &weights_[nodes_ * inside++], nodes_);
        }
        return Done{};
    }

    Status add_mapped(std::size_t row) {
        std::array<double, max_nodes_of_cell> weights{};
        const auto nodes = mapped_->weights(rows_.cells[row], rows_.points.data() + d_ * row, weights.data());
        if (nodes.count == 0)
            return Error{.code = "point.degenerate",
                         .what = "the map of cell " + std::to_string(mesh_.cell_number(rows_.cells[row])) +
                                 " cannot be inverted at a point",
                         .remedy = "take the interpolation linear"};
        add_row(nodes.at.data(), weights.data(), nodes.count);
        return Done{};
    }

    /// The nearest point of cells with straight sides, where some cells have maps.
    Nearest nearest(const double* point, double limit) const {
        if (mapped_ == nullptr) return *locator_.nearest(point, limit);
        return locate::nearest_in_maps(locate::LocatorData::of(locator_), point, limit).nearest;
    }

    /// Adds the row of a point outside, and returns true, if its nearest point is that of a cell with a map.
    bool add_outside_maps(const double* point) {
        const bool beyond = outside_.kind == Outside::extrapolate;
        if ((!beyond && outside_.kind != Outside::nearest) || !base::all_finite({point, d_})) return false;
        const double limit = beyond ? std::numeric_limits<double>::infinity() : outside_.limit;
        const locate::NearestInMaps found = locate::nearest_in_maps(locate::LocatorData::of(locator_), point, limit);
        if (!found.on) return false;
        std::array<double, max_nodes_of_cell> weights{};
        const auto nodes = beyond ? mapped_->weights_beyond(found.nearest.cell, *found.on, point, weights.data())
                                  : mapped_->weights_on_side(*found.on, weights.data());
        add_row(nodes.at.data(), weights.data(), nodes.count);
        return true;
    }

    Status second_order(TierCounts& tiers) {
        const std::size_t count = cells_.size();
        places_.assign(d_ * nodes_ * count, 0);
        for (std::size_t j = 0; j < count; ++j) {
            const sample::CellNodes nodes(mesh_, static_cast<std::size_t>(cells_[j]));
            for (std::size_t i = 0; i < corners_; ++i)
                std::copy_n(mesh_.point(nodes.at[i]), d_, &places_[d_ * (nodes_ * j + i)]);
        }
        const auto some = [&](const auto& all, std::size_t each) { return std::span(all).first(each * count); };
        const MeshQueries queries{simplex_, places_, some(corner_numbers_, corners_), some(own_, 1), points_};
        const NodalValues<double> values{some(units_, nodes_ * nodes_), static_cast<int>(nodes_)};
        return interpolate_quadratic(queries, some(mid_numbers_, nodes_ - corners_), values, weights_, &tiers);
    }

    void add_outside(const double* point) {
        Nearest nearest;
        if (outside_.kind == Outside::nearest && base::all_finite({point, d_}))
            nearest = this->nearest(point, outside_.limit);
        const locate::NearFeature feature = locate::near_feature(nearest.nodes, mesh_.points, d_);
        std::array<double, 3> at{};
        std::copy_n(point, d_, at.begin());
        if (nearest.cell < 0) {
            add_row(nullptr, nullptr, 0);
        } else if (feature.count != 1 && quadratic()) {
            add_second_order(static_cast<std::size_t>(nearest.cell), feature, at);
        } else {
            const std::array<double, 3> weights = locate::weights_of(at, feature);
            add_row(feature.nodes.data(), weights.data(), static_cast<std::size_t>(feature.count));
        }
    }

    void add_second_order(std::size_t cell, const locate::NearFeature& feature, const std::array<double, 3>& point) {
        const sample::ReferencePoint at =
            sample::reference_point(mesh_, cell, feature, locate::weights_of(point, feature));
        std::array<double, max_nodes_of_cell> weights{};
        for (std::size_t c = 0; c < nodes_; ++c) {
            std::array<double, max_nodes_of_cell> unit{};
            unit[c] = 1;
            weights[c] = interpolate_quadratic(simplex_, at.vertices.data(), at.at.data(), unit.data())->value;
        }
        add_row(sample::CellNodes(mesh_, cell).begin(), weights.data(), nodes_);
    }

    void add_row(const Mesh::Index* nodes, const double* weights, std::size_t count) {
        std::array<std::size_t, max_nodes_of_cell> order{};
        std::size_t used = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (weights[i] != 0) order[used++] = i;
        }
        std::ranges::sort(order.begin(), order.begin() + used, {}, [&](std::size_t i) { return nodes[i]; });
        for (std::size_t i = 0; i < used; ++i) {
            out_.nodes.push_back(nodes[order[i]]);
            out_.weights.push_back(weights[order[i]]);
        }
        out_.begin.push_back(out_.nodes.size());
    }

    const Locator& locator_;
    const Mesh& mesh_ = locator_.mesh();
    const locate::MappedCells* mapped_ = locate::LocatorData::of(locator_).mapped.get();
    const TableView& rows_;
    const OutsidePolicy& outside_;
    std::size_t d_ = static_cast<std::size_t>(mesh_.dimension), corners_ = mesh_.corners();
    Simplex simplex_ = d_ == 2 ? Simplex::triangle : Simplex::tetrahedron;
    /// Nodes of a cell.
    std::size_t nodes_ = corners_ + (quadratic() ? static_cast<std::size_t>(mid_node_count(simplex_)) : 0);
    NodeWeights out_{{0}, {}, {}};
    std::vector<Mesh::Index> owners_, cells_, corner_numbers_, mid_numbers_, own_;
    std::vector<double> points_, weights_, places_, units_;
};

}  // namespace

Result<NodeWeights> node_weights(const Locator& locator, const TableView& rows, const OutsidePolicy& outside) {
    const ExactEnvironment environment;
    if (!locator.mesh().is_listed()) return locate::not_listed("weights of nodes");
    const auto d = static_cast<std::size_t>(locator.mesh().dimension);
    if (rows.points.size() != d * rows.cells.size())
        return Error{.code = "argument.size",
                     .what = "size of the points",
                     .expected = std::to_string(d) + " coordinates a row",
                     .found = std::to_string(rows.points.size()) + " numbers for " + std::to_string(rows.cells.size())};
    if (Status good = locate::check_cells(rows.cells, locator.mesh().cell_count()); !good) return good.error();
    return WeightRows(locator, rows, outside).all();
}

}  // namespace barycert
