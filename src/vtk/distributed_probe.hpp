/// A probe whose mesh and points lie in pieces on the ranks of a job.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vtkCharArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "vtk/array_kinds.hpp"
#include "vtk/exact_index.hpp"
#include "vtk/exchange.hpp"
#include "vtk/piece_map.hpp"
#include "vtk/probe_arrays.hpp"

class vtkAbstractArray;
class vtkDataSet;

namespace barycert::in_vtk {

/// The same on all ranks.
struct ProbeSettings {
    bool categorical = false;
    double outside = 0;
    std::string mask;
};

/// Every rank makes one, and calls `run` once. Steps, each agreed on before the next one begins:
///   1  what the pieces are pieces of: dimension, plane, numbering, arrays;
///   2  the box of every piece and that of the points of every rank, to all; of a piece that is asked much, finer boxes
///      to those who ask;
///   3  each point to every rank of which a box holds it;
///   4  its owner there, by number, and its values; the lowest number wins.
class DistributedProbe {
public:
    DistributedProbe(Exchange& exchange, const ProbeSettings& settings)
        : exchange_(exchange), settings_(settings), map_(exchange) {}

    /// Gives `output` the arrays of a probe at the points of `input`. An Error is the same on all ranks; `output` then
    /// may have some of the arrays. `ready`: an Error if this rank has no right input or source. A null source is an
    /// empty piece.
    Status run(const Status& ready, vtkDataSet* input, vtkDataSet* source, vtkDataSet* output);

    vtkCharArray* mask() const { return mask_; }
    /// Integers of this rank that become doubles first, by the names of their arrays.
    std::vector<std::string> inexact() const { return arrays_ ? arrays_->inexact() : std::vector<std::string>(); }
    /// Whether more than one rank has cells, and these have no numbers but those that follow from the ranks.
    bool numbered_by_ranks() const { return map_.ranks_with_cells() > 1 && !shape_.by_global_ids; }

    std::uint64_t points_sent() const { return points_sent_; }
    std::uint64_t points_received() const { return points_received_; }

private:
    Status agree_on_cells(const Status& ready);
    Status agree_on_plane();
    Status index_piece();
    Status agree_on_arrays();
    Status map_pieces();
    Status swap_points();
    Status sample();
    Status swap_values();
    Status write_output(vtkDataSet* output);

    std::int64_t number(Mesh::Index cell) const;
    void append_values(std::size_t partner);
    void merge_values(std::size_t partner);

    Exchange& exchange_;
    ProbeSettings settings_;
    vtkDataSet* input_ = nullptr;
    vtkSmartPointer<vtkDataSet> source_;
    vtkIdType count_ = 0;  ///< of this rank's points

    SimplexShape shape_;
    std::shared_ptr<const ExactIndex> index_;
    std::vector<std::int64_t> numbers_;  ///< of the mesh's cells; empty: as they come, after those of lower ranks
    vtkNew<vtkPolyData> scratch_;  ///< its point data has the arrays, of this rank's points and then of those asked for
    std::optional<ProbeArrays> arrays_;
    std::vector<ArrayKind> kinds_;
    std::vector<vtkSmartPointer<vtkAbstractArray>> columns_;  ///< of each kind
    vtkSmartPointer<vtkCharArray> mask_;
    std::vector<Mesh::Index> owners_;  ///< of each tuple

    PieceMap map_;
    Parcels<vtkIdType> asked_;           ///< which of this rank's points partners are asked for
    Parcels<double> points_, received_;  ///< three coordinates each
    Parcels<char> answers_, answered_;
    std::vector<std::int64_t> best_;  ///< number of the owner of each of this rank's points that has one
    std::uint64_t points_sent_ = 0, points_received_ = 0;
};

}  // namespace barycert::in_vtk
