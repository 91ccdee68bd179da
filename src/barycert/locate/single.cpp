#include <cmath>

#include "barycert/environment.hpp"
#include "barycert/locate/batch.hpp"
#include "barycert/locate/locator_data.hpp"
#include "barycert/locate/walk_lanes.hpp"
#include "barycert/locate/walk_one.hpp"
#include "barycert/locator.hpp"

namespace barycert {

Result<Location> Locator::locate(const double* point, Mesh::Index hint) const {
    const ExactEnvironment environment;
    const locate::LocatorData& data = *data_;
    const locate::CellIndex& index = data.index;
    const std::size_t d = index.dimension();
    for (std::size_t k = 0; k < d; ++k) {
        if (!std::isfinite(point[k])) return locate::check_finite({point, d}, d).error();
    }
    if (!index.box_holds(point)) return Location{};
    const auto location = [&](locate::Place owner, Feature feature) {
        return owner < 0 ? Location{} : Location{index.original[static_cast<std::size_t>(owner)], feature};
    };
    locate::PointRecord record{};
    for (std::size_t k = 0; k < d; ++k) record.at[k] = point[k];
    locate::Place stuck = 0;
    if (data.method == Method::walk) {
        const locate::End end = locate::walk_one(data, point, hint);
        if (end.inside && !data.proof.is_contested(end.cell)) return location(end.cell, Feature::interior);
        if (end.inside) {
            locate::Place lowest = end.cell;
            Feature on = Feature::interior;
            TierCounts tests;
            constexpr std::uint32_t which = 0;
            data.contested_cells().find_owners(&record, &which, 1, &lowest, &on, tests);
            return location(lowest, on);
        }
        stuck = end.outside ? ~end.cell : end.cell;
    }
    if (data.occupancy() != nullptr && !data.occupancy()->may_hold(index, point)) return Location{};
    locate::Finder finder(data, index.nodes.data(), 1);
    locate::Place owner = -1;
    Feature feature = Feature::outside;
    LocationCounts ignored;
    if (data.method == Method::walk) {
        finder.settle(record, stuck, owner, feature);
    } else {
        finder.find(&record, 1, &owner, &feature, ignored);
    }
    return location(owner, feature);
}

}  // namespace barycert
