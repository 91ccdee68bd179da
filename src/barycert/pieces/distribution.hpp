/// Values at the points of all ranks, from the pieces of a mesh that they have.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
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

/// What an engine has of each point, as bytes: those of this rank's points first, then those of the points that it is
/// asked for.
class Tuples {
public:
    virtual ~Tuples() = default;
    /// Appends a tuple.
    virtual void put(std::size_t tuple, std::vector<char>& bytes) const = 0;
    /// Sets a tuple from what `put` appended, or leaves it, and returns what comes after that.
    virtual const char* take(std::size_t tuple, const char* bytes, bool set) = 0;
};

/// Every rank makes one, and calls these in this order. Each is agreed on before it ends:
///   ask          the box of every piece and that of the points of every rank, to all; of a piece that is asked much,
///                finer boxes to those who ask; then each point to every rank of which a box holds it
///   swap_values  its owner there, by number, and its values
///   merge        the lowest number wins; of equal ones, which are those of copies of one cell, that of the lowest rank
class Distribution {
public:
    /// All stay as they are.
    Distribution(Exchange& exchange, const Piece& piece, Points points)
        : exchange_(exchange), piece_(piece), points_(std::move(points)), map_(exchange) {}

    Status ask();
    /// Coordinates, three each, of the points that this rank is asked for; they are given away.
    std::vector<double> points_of_others() { return std::move(received_.values); }

    /// `owners`: the cell of each tuple's point in the piece; -1: none. `numbers`: of the cells of the piece in the
    /// whole mesh; empty: as they come, after those of lower ranks.
    Status swap_values(std::span<const Mesh::Index> owners, const std::vector<std::int64_t>& numbers,
                       const Tuples& tuples);
    /// Sets tuples of this rank's points that others own, and valid[point] to 1. Of this rank alone.
    void merge(Tuples& tuples, char* valid);

    int ranks_with_cells() const { return map_.ranks_with_cells(); }
    std::uint64_t points_sent() const { return sent_; }
    std::uint64_t points_received() const { return received_.begin.back() / 3; }

private:
    using Owner = std::pair<std::int64_t, int>;  ///< number and rank

    Exchange& exchange_;
    const Piece& piece_;
    Points points_;
    PieceMap map_;
    Parcels<std::size_t> asked_;  ///< which of this rank's points partners are asked for
    Parcels<double> received_;
    Parcels<char> answered_;
    std::vector<Owner> best_;  ///< of each of this rank's points
    std::uint64_t sent_ = 0;
};

}  // namespace barycert::pieces
