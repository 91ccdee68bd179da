/// Parts of an index that are made on first need. When it pays to make them before is PreparationPolicy's to say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "barycert/locator.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/facet_links.hpp"
#include "mesh/index/proof.hpp"
#include "mesh/locate/contested_cells.hpp"
#include "mesh/locate/frozen_index.hpp"
#include "mesh/locate/lazy.hpp"
#include "mesh/locate/nearest.hpp"
#include "mesh/locate/node_cells.hpp"
#include "mesh/locate/occupancy.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::locate {

/// Each is made once, by one thread while others wait, and is the same whoever asks first.
class LazyParts {
public:
    /// Parts that walks need besides `index.cells[].next`.
    struct Proved {
        std::vector<Place> degenerate;
        Proof proof;
    };

    /// `frozen` must stay. Threads are those of BuildOptions.
    LazyParts(FrozenIndex& frozen, Method method, int threads) : frozen_(frozen), method_(method), threads_(threads) {}

    Method method() const { return method_; }
    int threads() const { return threads_; }

    /// Cells are linked and proved, unless they are or the method forbids it. Uses the threads of the calling arena.
    void prove(const std::function<void(const char*)>& stage = [](const char*) {}) const {
        if (method_ != Method::walk) return;
        proved_.get([&] {
            stage("linking cells");
            FacetLinks links = link_facets(frozen_.index);
            stage("proving the partition");
            Proof proof = index::prove(frozen_.index, links, [&]() -> const CellTree& { return tree(); });
            return Proved{std::move(links.degenerate), std::move(proof)};
        });
    }
    /// The same, in an arena of its own. Returns nothing proved if the method forbids it.
    const Proved& demand_proved() const {
        static const Proved nothing;
        if (proved() == nullptr) base::in_arena(threads_, frozen_.index.cell_count(), [&] { prove(); });
        return proved() == nullptr ? nothing : *proved();
    }
    /// nullptr if nothing is: then there are no walks.
    const Proved* proved() const { return proved_.made(); }

    /// nullptr if none was made.
    const Occupancy* occupancy() const { return fine_.made() != nullptr ? fine_.made() : coarse_.made(); }
    bool has_fine_occupancy() const { return fine_.made() != nullptr; }
    void make_occupancy(Occupancy::Detail detail) const {
        const Lazy<Occupancy>& one = detail == Occupancy::Detail::fine ? fine_ : coarse_;
        one.get([&] { return Occupancy(frozen_.index, filled(), detail); });
    }
    /// The share of the box of the mesh that its cells fill, about.
    double filled() const {
        return filled_.get([&] { return filled_share(frozen_.index); });
    }

    const CellTree& tree() const {
        return tree_.get([&] { return make_cell_tree(frozen_.index); });
    }
    /// Precondition: there is a cell.
    const NearestTree& nearest_tree() const {
        return nearest_tree_.get([&] { return NearestTree(frozen_.index, frozen_.mapped.get()); });
    }
    /// Precondition for these two: proved().
    const NodeCells& node_cells() const {
        return node_cells_.get([&] { return NodeCells(frozen_.index, proved()->degenerate); });
    }
    const ContestedCells& contested_cells() const {
        return contested_cells_.get(
            [&] { return ContestedCells(frozen_.index, proved()->proof, proved()->degenerate); });
    }
    /// Place of each cell of the mesh.
    const std::vector<Place>& places() const {
        return places_.get([&] {
            const CellIndex& index = frozen_.index;
            std::vector<Place> places(index.cell_count());
            for (std::size_t c = 0; c < places.size(); ++c)
                places[static_cast<std::size_t>(index.original[c])] = static_cast<Place>(c);
            return places;
        });
    }
    std::size_t bytes() const {
        const std::size_t bits = proved() != nullptr ? proved()->proof.contested.size() : 0;
        return bits * sizeof(std::uint64_t) +
               bytes_of(tree_, nearest_tree_, coarse_, fine_, node_cells_, contested_cells_) +
               (places_.made() != nullptr ? places_.made()->size() * sizeof(Place) : 0);
    }

private:
    FrozenIndex& frozen_;
    Method method_;
    int threads_;
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
