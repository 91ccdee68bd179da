/// All that a Locator keeps.
#pragma once

#include "core/base/lists.hpp"
#include "core/grid_lanes.hpp"
#include "mesh/index/proof.hpp"
#include "mesh/locate/mapped/mapped_cells.hpp"
#include "mesh/locate/nearest.hpp"
#include "mesh/locate/occupancy.hpp"

namespace barycert::locate {

/// The cells at each node, to name all cells around a vertex or edge.
class NodeCells {
public:
    /// Without the cells `degenerate`, ascending.
    NodeCells(const CellIndex& index, std::span<const Place> degenerate) {
        std::vector<Place> place(index.cell_count());
        for (std::size_t c = 0; c < place.size(); ++c)
            place[static_cast<std::size_t>(index.original[c])] = static_cast<Place>(c);
        std::erase_if(place, [&](Place c) { return std::ranges::binary_search(degenerate, c); });
        cells_ = {index.original_node.size(), [&](const auto& add) {
                      for (const Place c : place) {
                          for (std::size_t i = 0; i < index.corners(); ++i)
                              add(static_cast<std::size_t>(index.cells[c].node[i]), c);
                      }
                  }};
    }

    /// The cells at a node, ascending by their numbers in the mesh.
    std::span<const Place> of(Place node) const { return cells_[static_cast<std::size_t>(node)]; }
    std::size_t bytes() const { return cells_.bytes(); }

    /// The lowest cell of the mesh that has the vertex, edge or face on which a point with these signs lies. In a
    /// simplicial complex it is the lowest that holds the point. Requires: the signs are those of a point in the
    /// closed cell, which is not degenerate.
    Place lowest_around(const CellIndex& index, Place cell, WeightSigns signs) const {
        const CellRecord& record = index.cells[cell];
        std::array<Place, 4> support;
        std::size_t count = 0;
        for (std::size_t i = 0; i < index.corners(); ++i) {
            if (signs.sign(static_cast<int>(i)) != Sign::zero) support[count++] = record.node[i];
        }
        return *std::ranges::find_if(of(support[0]), [&](Place candidate) {
            const auto& nodes = index.cells[candidate].node;
            return std::all_of(support.begin() + 1, support.begin() + static_cast<std::ptrdiff_t>(count),
                               [&](Place node) { return std::ranges::find(nodes, node) != nodes.end(); });
        });
    }

private:
    base::Lists<Place> cells_;
};

/// The cells that others may meet beside common faces (doc/theorem.md), to find who else holds a point.
class ContestedCells {
public:
    /// The contested cells that are not degenerate. `index` must stay.
    ContestedCells(const CellIndex& index, const Proof& proof, std::span<const Place> degenerate);

    /// A list costs about as much as asking the tree for so many points.
    static constexpr std::size_t cost_of_list = 4;

    /// Makes the lists. Before threads share the points: results are the same with them, counts of tests are not.
    void prepare() const {
        lists_.get([this] { return make_lists(); });
    }
    /// One more of points that come one by one.
    void prepare_for_one_more() const {
        if (cost_of_list * asked_.fetch_add(1, std::memory_order_relaxed) > cells_.size()) prepare();
    }

    /// For points[which[i]], i < count, each inside the contested cell owner[which[i]], certainly not on its faces:
    /// sets the owner and the feature. Others that hold the point are contested, for in one that is not, every cell
    /// that holds a point has the face on which it lies.
    void find_owners(const PointRecord* points, const std::uint32_t* which, std::size_t count, Place* owner,
                     Feature* feature, TierCounts& tests) const;

    std::size_t bytes() const { return cells_.size() * sizeof(Place) + tree_.bytes() + bytes_of(lists_); }

private:
    /// For cells_[i], those of lower number in the mesh that may overlap it. Empty if there would be too many.
    using Lists = base::Lists<Place>;
    Lists make_lists() const;

    const CellIndex& index_;
    std::vector<Place> cells_;  ///< ascending
    BoxGroups tree_;            ///< of their boxes
    Lazy<Lists> lists_;
    mutable std::atomic<std::size_t> asked_ = 0;  ///< one by one
};

/// A block of points in the order of the bins, near ones side by side. Keeps its memory from block to block.
class SortedPoints {
public:
    /// d coordinates a point. Sorted by the first bits of their bins alone: what lies together in one of those fits the
    /// nearest caches. Points that find_bins knows to be outside are left out. Returns whether all coordinates are
    /// finite. The points must stay where they are.
    bool sort(const CellIndex& index, const Occupancy* occupancy, std::span<const double> points);

    /// How many are left, and how many not.
    std::size_t size() const { return size_; }
    std::size_t left_out() const { return count_ - size_; }
    /// Point i in the order of the caller.
    const double* point(std::size_t i) const { return points_.data() + d_ * i; }
    PointRecord record(std::size_t i, std::size_t number) const {
        const double* const from = point(i);
        return {{from[0], from[1], d_ == 3 ? from[d_ - 1] : 0}, static_cast<std::uint32_t>(number)};
    }
    struct Entry {
        std::uint32_t number;  ///< in the order of the caller
        std::uint32_t bin;
    };
    /// By place in this order.
    const Entry* entries() const { return order_.data(); }
    /// Copies the points at places [first, first + count) in this order. The number of each is its place.
    void copy(std::size_t first, std::size_t count, PointRecord* to) const;

    /// use(i, place of point i in this order) for every point, in the order of the caller; the place of a point left
    /// out is size(). Results are written in this order and read in that one: reading at random can be asked for ahead,
    /// by ahead(place); writing cannot.
    template <class Ahead, class Use>
    void for_each_in_callers_order(Ahead ahead, Use use) const {
        constexpr std::size_t distance = 16;
        for (std::size_t i = 0; i < count_; ++i) {
            if (i + distance < count_) ahead(place_[i + distance]);
            use(i, place_[i]);
        }
    }

private:
    std::span<const double> points_;
    std::size_t d_ = 3, count_ = 0, size_ = 0;
    Buffer<Entry> order_;
    std::vector<std::uint32_t> next_;
    Buffer<std::uint32_t> place_;  ///< of each point, in the order of the caller; before that, its bin
};

/// Things that are dear to make, kept for the next user.
template <class T>
class Pool {
public:
    /// One that nobody uses; give it back by put().
    std::unique_ptr<T> take() const {
        const std::lock_guard lock(mutex_);
        if (kept_.empty()) {
            kept_.reserve(++made_);  // so that put() needs no memory
            return std::make_unique<T>();
        }
        std::unique_ptr<T> one = std::move(kept_.back());
        kept_.pop_back();
        return one;
    }
    void put(std::unique_ptr<T> one) const noexcept {
        const std::lock_guard lock(mutex_);
        kept_.push_back(std::move(one));
    }

private:
    mutable std::mutex mutex_;
    mutable std::vector<std::unique_ptr<T>> kept_;
    mutable std::size_t made_ = 0;
};

struct LocatorData {
    static const LocatorData& of(const Locator& locator) { return *locator.data_; }

    /// Data that walks need besides `index.cells[].next`.
    struct Proved {
        std::vector<Place> degenerate;
        Proof proof;
    };

    const Mesh* mesh = nullptr;
    Method method = Method::candidates;
    int threads = 0;                             ///< of BuildOptions
    std::unique_ptr<const MappedCells> mapped;   ///< nullptr: cells are simplices, or their parts
    std::unique_ptr<const core::AxisGrid> grid;  ///< of a mesh that is not listed; then the index is empty
    bool multilinear = false;                    ///< that grid

    /// Its location, by that in straight simplices or parts of cells; none if it is not finite. Requires: mapped.
    Location settle(const double* point, Location in_parts) const;
    /// Asks memory for what is read of maps of the owners that follow the first, of these nodes.
    void fetch_maps(const Place* owner, std::size_t count, const NodeRecord* nodes) const {
        constexpr std::size_t apart = 8;
        for (std::size_t step = 0, ahead = MappedCells::fetch_steps * apart; ahead != 0; ++step, ahead -= apart)
            if (ahead < count && owner[ahead] >= 0) mapped->fetch(owner[ahead], step, nodes);
    }
    mutable CellIndex index;  ///< links of its cells are set by prove(), and read by those who found proved()

    /// Up to 12 MiB a thread: the system would have to clear as much for every block of points.
    Pool<SortedPoints> sorted;
    Pool<std::vector<Location>> locations;  ///< up to 8 MiB a thread

    /// Makes what pays when so many points are located; calls with fewer points profit of it later. It does not change
    /// results, but which cells are asked.
    void prepare(std::size_t points) const {
        prove_for(points);
        if (proved() != nullptr && !proved()->proof.contested.empty() &&
            points > index.cell_count() / ContestedCells::cost_of_list)
            contested_cells().prepare();
        if (static_cast<double>(points) < cost_of_coarse * cells_of_occupancy()) return;
        expect_outside(static_cast<double>(points) * (1 - filled()));
    }
    /// A call for one point found it outside without an occupancy.
    void found_outside() const {
        const auto enough = static_cast<std::size_t>(std::ceil(cost_of_coarse * cells_of_occupancy()));
        if (outside_.load(std::memory_order_relaxed) >= enough) return;
        if (outside_.fetch_add(1, std::memory_order_relaxed) + 1 == enough)
            base::in_arena(threads, index.cell_count(), [&] { expect_outside(static_cast<double>(enough)); });
    }
    /// Cells are linked and proved, unless they are or `method` forbids it. Uses the threads of the calling arena.
    void prove(const std::function<void(const char*)>& stage = [](const char*) {}) const {
        if (method != Method::walk) return;
        proved_.get([&] {
            stage("linking cells");
            FacetLinks links = link_facets(index);
            stage("proving the partition");
            Proof proof = index::prove(index, links, [&]() -> const CellTree& { return tree(); });
            return Proved{std::move(links.degenerate), std::move(proof)};
        });
    }
    /// The same if it pays: when so many points more will be located.
    void prove_for(std::size_t points) const {
        // As measured: meshes of 2,400 and 39,000 cells are proved in the time that these save by walks.
        constexpr std::size_t enough = 50000;
        if (method != Method::walk || proved() != nullptr) return;
        if (asked_.fetch_add(points, std::memory_order_relaxed) + points >= enough) demand_proved();
    }
    /// The same in any case.
    const Proved& demand_proved() const {
        static const Proved nothing;
        if (proved() == nullptr) base::in_arena(threads, index.cell_count(), [&] { prove(); });
        return proved() == nullptr ? nothing : *proved();
    }
    /// nullptr if nothing is: then there are no walks.
    const Proved* proved() const { return proved_.made(); }

    /// nullptr if none was made.
    const Occupancy* occupancy() const { return fine_.made() != nullptr ? fine_.made() : coarse_.made(); }

    const CellTree& tree() const {
        return tree_.get([&] { return make_cell_tree(index); });
    }
    /// Requires: there is a cell.
    const NearestTree& nearest_tree() const {
        return nearest_tree_.get([&] { return NearestTree(index, mapped.get()); });
    }
    /// Both require proved().
    const NodeCells& node_cells() const {
        return node_cells_.get([&] { return NodeCells(index, proved()->degenerate); });
    }
    const ContestedCells& contested_cells() const {
        return contested_cells_.get([&] { return ContestedCells(index, proved()->proof, proved()->degenerate); });
    }
    /// Place of each cell of the mesh.
    const std::vector<Place>& places() const {
        return places_.get([&] {
            std::vector<Place> places(index.cell_count());
            for (std::size_t c = 0; c < places.size(); ++c)
                places[static_cast<std::size_t>(index.original[c])] = static_cast<Place>(c);
            return places;
        });
    }
    std::size_t bytes() const {
        const std::size_t bits = proved() != nullptr ? proved()->proof.contested.size() : 0;
        return index.bytes() + bits * sizeof(std::uint64_t) + (mapped ? mapped->bytes() : 0) +
               bytes_of(tree_, nearest_tree_, coarse_, fine_, node_cells_, contested_cells_) +
               (places_.made() != nullptr ? places_.made()->size() * sizeof(Place) : 0);
    }

private:
    double filled() const {
        return filled_.get([&] { return filled_share(index); });
    }
    /// The number of cells that the cost of an occupancy grows with: one of few cells takes as long as one of
    /// least_cells.
    double cells_of_occupancy() const {
        return static_cast<double>(std::max(index.cell_count(), Occupancy::least_cells));
    }
    /// Makes the occupancy that pays for so many points outside. As measured: one takes about 100 ns without; to make
    /// the coarse one takes about 60 ns a cell. The fine one takes about 600 and saves a few more nanoseconds a point:
    /// where there are so many points, they are taken not to be the last.
    void expect_outside(double points) const {
        if (!(filled() < max_filled) || points < cost_of_coarse * cells_of_occupancy()) return;
        if (points >= cost_of_fine * cells_of_occupancy()) {
            fine_.get([&] { return Occupancy(index, filled(), Occupancy::Detail::fine); });
        } else if (fine_.made() == nullptr) {
            coarse_.get([&] { return Occupancy(index, filled(), Occupancy::Detail::coarse); });
        }
    }

    static constexpr double cost_of_coarse = 0.6, cost_of_fine = 6;  ///< in points outside, a cell
    static constexpr double max_filled = 0.95;

    mutable std::atomic<std::size_t> asked_ = 0;    ///< points before the proof
    mutable std::atomic<std::size_t> outside_ = 0;  ///< points of calls for one, before an occupancy is made
    Lazy<Proved> proved_;
    Lazy<double> filled_;
    Lazy<Occupancy> coarse_, fine_;
    Lazy<CellTree> tree_;
    Lazy<NearestTree> nearest_tree_;
    Lazy<NodeCells> node_cells_;
    Lazy<ContestedCells> contested_cells_;
    Lazy<std::vector<Place>> places_;
};

}  // namespace barycert::locate
