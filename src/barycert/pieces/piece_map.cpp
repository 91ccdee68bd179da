#include "barycert/pieces/distribution.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "barycert/base/finite.hpp"

namespace barycert::pieces {

namespace {

constexpr std::size_t fine = 64;  ///< boxes of a piece that is asked much

/// The box of that one point.
Box box_at(const Points& points, std::size_t i) {
    std::array<double, 3> x{};
    points.at(i, x.data());
    return base::all_finite(x) ? Box{x, x} : no_box;
}

}  // namespace

Status PieceMap::gather(const Piece& piece, const Points& points) {
    Part mine;
    Status read = exchange_.everywhere([&] {
        mine.cell_count = static_cast<double>(piece.mesh.cell_count());
        mine.point_count = static_cast<double>(points.count);
        for (std::size_t i = 0; i < piece.mesh.cell_count(); ++i) mine.cells.add(piece.box_of(i));
        for (std::size_t i = 0; i < points.count; ++i) mine.points.add(box_at(points, i));
        parts_.resize(static_cast<std::size_t>(exchange_.size()));
    });
    if (!read) return read;
    exchange_.gather(mine, parts_);
    return exchange_.everywhere([&] {
        std::vector<int> partners;
        const int rank = exchange_.rank();
        for (int other = 0; other < exchange_.size(); ++other) {
            if (of(other).cell_count > 0) ++ranks_with_cells_;
            if (other < rank) cells_before_ += static_cast<std::int64_t>(of(other).cell_count);
            if (asks(rank, other) || asks(other, rank)) partners.push_back(other);
        }
        exchange_.set_partners(std::move(partners));
    });
}

// Whether finer boxes are likely to keep more bytes than they have: both ranks answer alike.
bool PieceMap::asks_much(int who, int whom) const {
    if (!asks(who, whom)) return false;
    const Box &points = of(who).points, &cells = of(whom).cells;
    double share = of(who).point_count;
    for (std::size_t a = 0; a < 3; ++a) {
        const double width = points.high[a] / 2 - points.low[a] / 2;
        const double common = std::min(points.high[a], cells.high[a]) / 2 - std::max(points.low[a], cells.low[a]) / 2;
        if (width > 0) share *= common / width;
    }
    return share * 3 * sizeof(double) > 2.0 * fine * sizeof(Box);
}

Status PieceMap::refine(const Piece& piece) {
    Parcels<Box> out;
    Status room = exchange_.everywhere([&] {
        const int rank = exchange_.rank();
        std::vector<Box> mine;
        for (const int other : exchange_.partners()) {
            if (asks_much(other, rank)) {
                if (mine.empty()) {
                    mine = cover(
                        of(rank).cells, piece.mesh.cell_count(), [&](std::size_t i) { return piece.box_of(i); }, fine);
                    mine.resize(fine, no_box);
                }
                out.values.insert(out.values.end(), mine.begin(), mine.end());
            }
            out.close();
            fine_boxes_.values.resize(fine_boxes_.values.size() + (asks_much(rank, other) ? fine : 0));
            fine_boxes_.close();
        }
    });
    if (!room) return room;
    return exchange_.swap(out, fine_boxes_, true);
}

void PieceMap::points_to_ask(const Points& points, Parcels<std::size_t>& asked, Parcels<double>& coordinates) const {
    const std::size_t partners = exchange_.partners().size();
    std::vector<Box> boxes;
    std::vector<std::size_t> owners;
    for (std::size_t k = 0; k < partners; ++k) {
        const int other = exchange_.partners()[k];
        if (!asks(exchange_.rank(), other)) continue;
        const std::span<const Box> given = fine_boxes_.of(k);
        std::copy_if(given.begin(), given.end(), std::back_inserter(boxes), [](const Box& box) { return !empty(box); });
        if (given.empty()) boxes.push_back(of(other).cells);
        owners.resize(boxes.size(), k);
    }
    const index::BoxTree tree(std::move(boxes));
    std::vector<std::vector<std::size_t>> of_partner(partners);
    for (std::size_t i = 0; i < points.count; ++i) {
        tree.for_each(box_at(points, i), [&](std::uint32_t box) {
            std::vector<std::size_t>& some = of_partner[owners[box]];
            if (some.empty() || some.back() != i) some.push_back(i);
            return true;
        });
    }
    for (std::vector<std::size_t>& some : of_partner) {
        for (const std::size_t i : some) {
            std::array<double, 3> x{};
            points.at(i, x.data());
            coordinates.values.insert(coordinates.values.end(), x.begin(), x.end());
        }
        coordinates.close();
        asked.values.insert(asked.values.end(), some.begin(), some.end());
        asked.close();
        some = {};
    }
}

}  // namespace barycert::pieces
