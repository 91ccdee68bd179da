#include "vtk/piece_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <vtkDataSet.h>

namespace barycert::in_vtk {

namespace {

constexpr std::size_t fine = 64;     ///< boxes of a piece that is asked much
constexpr std::size_t box_size = 6;  ///< doubles of a box
constexpr std::size_t piece_size = 2 * box_size + 2;

void write(const Box& box, double* to) {
    std::copy(box.low.begin(), box.low.end(), to);
    std::copy(box.high.begin(), box.high.end(), to + 3);
}

Box read_box(const double* from) {
    Box box;
    std::copy_n(from, 3, box.low.begin());
    std::copy_n(from + 3, 3, box.high.begin());
    return box;
}

bool finite(const double* x) {
    return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

// Of a cell of the mesh, in space.
Box box_of(const ExactIndex& index, std::size_t cell) {
    const Mesh& mesh = index.mesh;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    Box box;
    for (std::size_t k = 0; k < mesh.corners(); ++k) {
        const auto node = static_cast<std::size_t>(mesh.cells[mesh.corners() * cell + k]);
        std::array<double, 3> x{};
        for (std::size_t a = 0; a < d; ++a) x[static_cast<std::size_t>(index.axes[a])] = mesh.points[d * node + a];
        if (index.normal >= 0) x[static_cast<std::size_t>(index.normal)] = index.plane;
        box.add(x.data());
    }
    return box;
}

Box box_of_cells(const ExactIndex& index) {
    Box all;
    if (!index.locator) return all;
    for (std::size_t i = 0; i < index.mesh.cell_count(); ++i) all.add(box_of(index, i));
    return all;
}

Box box_of_points(vtkDataSet& input) {
    Box all;
    for (vtkIdType i = 0; i < input.GetNumberOfPoints(); ++i) {
        std::array<double, 3> x{};
        input.GetPoint(i, x.data());
        if (finite(x.data())) all.add(x.data());
    }
    return all;
}

}  // namespace

Status PieceMap::gather(const ExactIndex& index, vtkDataSet& input) {
    std::array<double, piece_size> mine{};
    std::vector<double> all;
    Status read = exchange_.everywhere([&]() -> Status {
        write(box_of_cells(index), mine.data());
        write(box_of_points(input), mine.data() + box_size);
        mine[2 * box_size] = index.locator ? static_cast<double>(index.mesh.cell_count()) : 0;
        mine[2 * box_size + 1] = static_cast<double>(input.GetNumberOfPoints());
        all.resize(piece_size * static_cast<std::size_t>(exchange_.size()));
        pieces_.resize(static_cast<std::size_t>(exchange_.size()));
        return Done{};
    });
    if (!read) return read;
    exchange_.gather(mine, all);
    for (std::size_t r = 0; r < pieces_.size(); ++r) {
        const double* const from = all.data() + piece_size * r;
        pieces_[r] = {read_box(from), read_box(from + box_size), from[2 * box_size], from[2 * box_size + 1]};
        if (pieces_[r].cell_count > 0) ++ranks_with_cells_;
        if (static_cast<int>(r) < exchange_.rank()) cells_before_ += static_cast<std::int64_t>(pieces_[r].cell_count);
    }
    return exchange_.everywhere([&]() -> Status {
        std::vector<int> partners;
        const int rank = exchange_.rank();
        for (int other = 0; other < exchange_.size(); ++other)
            if (asks(rank, other) || asks(other, rank)) partners.push_back(other);
        exchange_.set_partners(std::move(partners));
        return Done{};
    });
}

bool PieceMap::asks(int who, int whom) const {
    return who != whom &&
           pieces_[static_cast<std::size_t>(who)].points.meets(pieces_[static_cast<std::size_t>(whom)].cells);
}

// Whether finer boxes are likely to keep more bytes than they have: both ranks answer alike.
bool PieceMap::asks_much(int who, int whom) const {
    if (!asks(who, whom)) return false;
    const Box& points = pieces_[static_cast<std::size_t>(who)].points;
    const Box& cells = pieces_[static_cast<std::size_t>(whom)].cells;
    double share = pieces_[static_cast<std::size_t>(who)].point_count;
    for (std::size_t a = 0; a < 3; ++a) {
        const double width = points.high[a] / 2 - points.low[a] / 2;
        const double common = std::min(points.high[a], cells.high[a]) / 2 - std::max(points.low[a], cells.low[a]) / 2;
        if (width > 0) share *= common / width;
    }
    return share * 3 * sizeof(double) > 2.0 * fine * box_size * sizeof(double);
}

Status PieceMap::refine(const ExactIndex& index) {
    Parcels<double> out;
    Status room = exchange_.everywhere([&]() -> Status {
        const int rank = exchange_.rank();
        const auto size = [&](bool much) { return much ? fine * box_size : 0; };
        std::vector<double> mine;
        for (const int other : exchange_.partners()) {
            if (asks_much(other, rank) && mine.empty()) {
                Gathered gathered(pieces_[static_cast<std::size_t>(rank)].cells);
                for (std::size_t i = 0; i < index.mesh.cell_count(); ++i) gathered.add(box_of(index, i));
                std::vector<Box> boxes = cover(gathered.boxes(), fine);
                boxes.resize(fine);
                mine.resize(fine * box_size);
                for (std::size_t i = 0; i < fine; ++i) write(boxes[i], mine.data() + box_size * i);
            }
            if (asks_much(other, rank)) out.values.insert(out.values.end(), mine.begin(), mine.end());
            out.close();
            fine_boxes_.values.resize(fine_boxes_.values.size() + size(asks_much(rank, other)));
            fine_boxes_.close();
        }
        return Done{};
    });
    if (!room) return room;
    return exchange_.swap(out, fine_boxes_, true);
}

void PieceMap::points_to_ask(vtkDataSet& input, Parcels<vtkIdType>& asked, Parcels<double>& points) const {
    std::vector<Box> boxes;
    std::vector<int> owners;
    for (std::size_t k = 0; k < exchange_.partners().size(); ++k) {
        const int other = exchange_.partners()[k];
        if (!asks(exchange_.rank(), other)) continue;
        const std::span<const double> given = fine_boxes_.of(k);
        for (std::size_t i = 0; i < given.size(); i += box_size) boxes.push_back(read_box(given.data() + i));
        if (given.empty()) boxes.push_back(pieces_[static_cast<std::size_t>(other)].cells);
        owners.resize(boxes.size(), static_cast<int>(k));
    }
    const std::size_t partners = exchange_.partners().size();
    const BoxTree tree(boxes, owners);
    std::vector<std::vector<vtkIdType>> of(partners);
    std::vector<vtkIdType> last(partners, -1);
    for (vtkIdType i = 0; i < input.GetNumberOfPoints(); ++i) {
        std::array<double, 3> x{};
        input.GetPoint(i, x.data());
        if (!finite(x.data())) continue;
        tree.holders(x.data(), [&](int k) {
            const auto partner = static_cast<std::size_t>(k);
            if (std::exchange(last[partner], i) != i) of[partner].push_back(i);
        });
    }
    for (std::vector<vtkIdType>& some : of) {
        for (const vtkIdType i : some) {
            std::array<double, 3> x{};
            input.GetPoint(i, x.data());
            points.values.insert(points.values.end(), x.begin(), x.end());
        }
        points.close();
        asked.values.insert(asked.values.end(), some.begin(), some.end());
        asked.close();
        some = {};
    }
}

}  // namespace barycert::in_vtk
