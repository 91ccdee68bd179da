/// Where the pieces of a mesh and the points of all ranks lie, in boxes, and whom a rank asks for which of its points.
#pragma once

#include <cstdint>
#include <vector>

#include <vtkType.h>

#include "vtk/boxes.hpp"
#include "vtk/exact_index.hpp"
#include "vtk/exchange.hpp"

class vtkDataSet;

namespace barycert::in_vtk {

/// All ranks call `gather`, then `refine`, with their pieces.
class PieceMap {
public:
    explicit PieceMap(Exchange& exchange) : exchange_(exchange) {}

    /// The box of every piece and that of the points of every rank, to all. Sets the partners of the exchange.
    Status gather(const ExactIndex& index, vtkDataSet& input);
    /// Finer boxes of pieces that are asked much, to those who ask.
    Status refine(const ExactIndex& index);

    /// Which points of the input each partner is to be asked for, and their coordinates, three each.
    void points_to_ask(vtkDataSet& input, Parcels<vtkIdType>& asked, Parcels<double>& points) const;

    int ranks_with_cells() const { return ranks_with_cells_; }
    std::int64_t cells_before() const { return cells_before_; }  ///< of ranks below this one

private:
    struct Piece {
        Box cells, points;
        double cell_count = 0, point_count = 0;
    };
    bool asks(int who, int whom) const;
    bool asks_much(int who, int whom) const;

    Exchange& exchange_;
    std::vector<Piece> pieces_;  ///< of each rank
    int ranks_with_cells_ = 0;
    std::int64_t cells_before_ = 0;
    Parcels<double> fine_boxes_;
};

}  // namespace barycert::in_vtk
