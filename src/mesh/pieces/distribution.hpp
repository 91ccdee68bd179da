/// Values at the points of all ranks, from the pieces of a mesh that they have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "mesh/pieces/exchange.hpp"
#include "mesh/pieces/piece.hpp"

namespace barycert::pieces {

/// The points of a rank.
struct Points {
    std::size_t count = 0;
    std::function<void(std::size_t, double*)> at;  ///< sets the three coordinates of a point; they need not be finite
};

/// Data that an engine has of each point, as bytes: first of this rank's points, then of those that it is asked for.
class Tuples {
public:
    virtual ~Tuples() = default;
    /// Appends a tuple.
    virtual void put(std::size_t tuple, std::vector<char>& bytes) const = 0;
    /// Sets a tuple from what `put` appended, or leaves it, and returns what comes after that.
    virtual const char* take(std::size_t tuple, const char* bytes, bool set) = 0;
};

/// Every rank makes one, and calls these in this order. Each is agreed on before it ends:
///   ask          tells all ranks the box of each piece and the box of each rank's points. A rank that is asked for
///                many points sends finer boxes to those who ask. Then each point goes to every rank that has a box
///                around it
///   swap_values  sends back, for each point, the number of its owner on that rank and its values
///   merge        keeps the owner with the lowest number. Copies of one cell have the same number: then it keeps the
///                one of the lowest rank
class Distribution {
public:
    /// All stay as they are.
    Distribution(Exchange& exchange, const Piece& piece, Points points)
        : exchange_(exchange), piece_(piece), points_(std::move(points)) {}

    Status ask();
    /// Coordinates, three each, of the points that this rank is asked for; they are given away.
    std::vector<double> points_of_others() { return std::move(received_.values); }

    /// `owners`: the cell of each tuple's point in the piece; -1: none. `numbers`: of the cells of the piece in the
    /// whole mesh; empty: as they come, after those of lower ranks.
    Status swap_values(std::span<const Mesh::Index> owners, const std::vector<std::int64_t>& numbers,
                       const Tuples& tuples);
    /// Sets tuples of this rank's points that others own, and valid[point] to 1. Called by this rank alone.
    void merge(Tuples& tuples, char* valid);

    int ranks_with_cells() const { return ranks_with_cells_; }
    std::uint64_t points_sent() const { return asked_.values.size(); }
    std::uint64_t points_received() const { return received_.begin.back() / 3; }

private:
    using Owner = std::pair<std::int64_t, int>;  ///< number and rank
    struct RankBoxes {
        Box cells = empty_box, points = empty_box;
        double cell_count = 0, point_count = 0;
    };
    const RankBoxes& of(int rank) const { return parts_[static_cast<std::size_t>(rank)]; }
    bool asks(int who, int whom) const { return who != whom && of(who).points.meets(of(whom).cells); }
    bool asks_much(int who, int whom) const;
    /// The box of one of this rank's points.
    Box box_at(std::size_t point) const;

    // The steps of `ask`. The first sets the partners of the exchange; coordinates are three each.
    Status gather();
    Status refine();
    void choose_points(Parcels<double>& coordinates);

    Exchange& exchange_;
    const Piece& piece_;
    Points points_;
    std::vector<RankBoxes> parts_;  ///< of each rank
    int ranks_with_cells_ = 0;
    std::int64_t cells_before_ = 0;  ///< of ranks below this one
    Parcels<Box> fine_boxes_;
    Parcels<std::size_t> asked_;  ///< which of this rank's points partners are asked for
    Parcels<double> received_;
    Parcels<char> answered_;
    std::vector<Owner> best_;  ///< of each of this rank's points
};

// The arrays that ranks have at points, and what all of them have.

struct ArrayKind {
    std::string name;
    bool named = true;
    int type = 0;  ///< a number of the engine's
    std::string type_name;
    int components = 1;
    int role = -1;  ///< a number of the engine's; -1: none
    std::vector<std::string> component_names = {};

    /// Name, number of components and type, for messages.
    std::string text() const;
};

/// All call it. `kinds` become those of the lowest rank that has cells; ranks without cells need not have them. An
/// Error if a rank that has cells has others, whatever their order.
Status agree_on_arrays(Exchange& exchange, bool has_cells, std::vector<ArrayKind>& kinds);

}  // namespace barycert::pieces
