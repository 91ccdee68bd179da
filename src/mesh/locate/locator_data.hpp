/// All that a Locator keeps: a frozen index, its lazy parts, one policy of when they pay, and work space.
#pragma once

#include <cstddef>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "mesh/locate/frozen_index.hpp"
#include "mesh/locate/lazy_parts.hpp"
#include "mesh/locate/pool.hpp"
#include "mesh/locate/preparation_policy.hpp"
#include "mesh/locate/sorted_points.hpp"

namespace barycert::locate {

struct LocatorData : FrozenIndex {
    static const LocatorData& of(const Locator& locator) { return *locator.data_; }

    template <class Stage>
    LocatorData(const Mesh& whole, const BuildOptions& options, const Stage& stage)
        : FrozenIndex(whole, options, stage),
          parts(*this, options.prove == Prove::never ? Method::candidates : Method::walk, options.threads),
          policy(parts, index) {}

    /// Its location, by that in straight simplices or parts of cells; none if it is not finite. Requires: mapped.
    Location settle(const double* point, Location in_parts) const;

    LazyParts parts;
    PreparationPolicy policy;

    /// Up to 12 MiB a thread: the system would have to clear as much for every block of points.
    Pool<SortedPoints> sorted;
    Pool<std::vector<Location>> locations;  ///< up to 8 MiB a thread

    std::size_t bytes() const { return index.bytes() + (mapped ? mapped->bytes() : 0) + parts.bytes(); }
};

}  // namespace barycert::locate
