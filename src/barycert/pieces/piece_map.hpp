/// Where the pieces of a mesh and the points of all ranks lie, in boxes, and whom a rank asks for which of its points.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "barycert/pieces/piece.hpp"

namespace barycert::pieces {

/// The points of a rank.
struct Points {
    std::size_t count = 0;
    std::function<void(std::size_t, double*)> at;  ///< sets the three coordinates of a point; they need not be finite
};

/// All ranks call `gather`, then `refine`, with their pieces.
class PieceMap {
public:
    explicit PieceMap(Exchange& exchange) : exchange_(exchange) {}

    /// The box of every piece and that of the points of every rank, to all. Sets the partners of the exchange.
    Status gather(const Piece& piece, const Points& points);
    /// Finer boxes of pieces that are asked much, to those who ask.
    Status refine(const Piece& piece);

    /// Which points each partner is to be asked for, and their coordinates, three each.
    void points_to_ask(const Points& points, Parcels<std::size_t>& asked, Parcels<double>& coordinates) const;

    int ranks_with_cells() const { return ranks_with_cells_; }
    std::int64_t cells_before() const { return cells_before_; }  ///< of ranks below this one

private:
    struct Part {
        Box cells = no_box, points = no_box;
        double cell_count = 0, point_count = 0;
    };
    const Part& of(int rank) const { return parts_[static_cast<std::size_t>(rank)]; }
    bool asks(int who, int whom) const { return who != whom && of(who).points.meets(of(whom).cells); }
    bool asks_much(int who, int whom) const;

    Exchange& exchange_;
    std::vector<Part> parts_;  ///< of each rank
    int ranks_with_cells_ = 0;
    std::int64_t cells_before_ = 0;
    Parcels<Box> fine_boxes_;
};

}  // namespace barycert::pieces
