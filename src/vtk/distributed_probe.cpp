#include "vtk/distributed_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include "barycert/environment.hpp"
#include "barycert/sampler.hpp"
#include "vtk/global_ids.hpp"
#include "vtk/probe_rows.hpp"
#include "vtk/simplices.hpp"

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

Status DistributedProbe::run(const Status& ready, vtkDataSet* input, vtkDataSet* source, vtkDataSet* output) {
    const ExactEnvironment environment;
    input_ = input;
    source_ = source;
    if (Status done = agree_on_cells(ready); !done) return done;
    for (const auto step :
         {&DistributedProbe::agree_on_plane, &DistributedProbe::index_piece, &DistributedProbe::agree_on_arrays,
          &DistributedProbe::gather_pieces, &DistributedProbe::find_partners, &DistributedProbe::swap_boxes,
          &DistributedProbe::swap_points, &DistributedProbe::sample, &DistributedProbe::swap_values})
        if (Status done = (this->*step)(); !done) return done;
    return write_output(output);
}

Status DistributedProbe::agree_on_cells(const Status& ready) {
    int dimension = -1;
    Status mine = exchange_.everywhere([&]() -> Status {
        if (!ready) return ready;
        if (source_ == nullptr) source_ = vtkSmartPointer<vtkUnstructuredGrid>::New();
        if (std::string fault = cell_dimension(*source_, dimension); !fault.empty())
            return Error{.what = "the source cannot be probed exactly: " + fault};
        if (dimension >= 2 && has_global_ids(*source_)) {
            if (std::string fault = fault_of_global_ids(*source_); !fault.empty())
                return Error{.what = "the source cannot be probed by several processes: " + fault};
        }
        count_ = input_->GetNumberOfPoints();
        return Done{};
    });
    if (!mine) return mine;
    std::array<int, 1> highest{dimension};
    exchange_.greatest(highest);
    if (highest[0] >= 0 && highest[0] < 2)
        return Error{.what = "the source cannot be probed exactly: it has neither tetrahedra nor triangles"};
    shape_.dimension = std::max(highest[0], 0);
    std::array<int, 1> lack{dimension >= 2 && dimension == highest[0] && !has_global_ids(*source_) ? 1 : 0};
    exchange_.greatest(lack);
    shape_.by_global_ids = lack[0] == 0;
    return Done{};
}

// Triangles lie across one axis on all ranks, or the pieces are not those of one mesh.
Status DistributedProbe::agree_on_plane() {
    if (shape_.dimension != 2) return Done{};
    std::array<double, 6> ends{};
    Status read = exchange_.everywhere([&]() -> Status {
        const Bounds3 bounds = simplex_bounds(*source_, 2);
        for (std::size_t a = 0; a < 3; ++a) {
            ends[a] = bounds.low[a];
            ends[3 + a] = -bounds.high[a];
        }
        return Done{};
    });
    if (!read) return read;
    exchange_.least(ends);
    if (ends[0] > -ends[3]) return Done{};  // ghosts alone
    for (std::size_t a = 0; a < 3; ++a)
        if (ends[a] == -ends[3 + a]) shape_.normal = static_cast<int>(a);
    if (shape_.normal < 0)
        return Error{.what =
                         "the source cannot be probed exactly: its triangles do not lie in one plane across an axis"};
    return Done{};
}

Status DistributedProbe::index_piece() {
    return exchange_.everywhere([&]() -> Status {
        int dimension = -1;
        if (std::string fault = cell_dimension(*source_, dimension); !fault.empty()) return Error{.what = fault};
        SimplexShape shape = shape_;
        // Nothing is sorted where there is nothing to sort.
        if (dimension != shape_.dimension) shape.by_global_ids = false;
        index_ = exact_index(*source_, shape);
        if (!index_->exact()) return Error{.what = "the source cannot be probed exactly: " + index_->reason};
        if (exchange_.size() > 1 && shape.by_global_ids && index_->locator) numbers_ = global_ids(*source_, *index_);
        vtkDataArray* const scalars = source_->GetPointData()->GetScalars();
        if (settings_.categorical && index_->locator && (scalars == nullptr || scalars->GetNumberOfComponents() != 1))
            return Error{.what = "CategoricalData takes point scalars of one component, of the source"};
        if (std::string fault = fault_of_arrays(*source_); !fault.empty()) return Error{.what = fault};
        arrays_.emplace(*index_, *source_, *scratch_, settings_.categorical, settings_.mask.c_str());
        kinds_ = kinds_of(*scratch_->GetPointData(), settings_.mask.c_str());
        if (std::string fault = fault_of(kinds_); !fault.empty()) return Error{.what = fault};
        return Done{};
    });
}

// Those of the lowest rank that has cells. Ranks without cells need not have them.
Status DistributedProbe::agree_on_arrays() {
    const bool has_cells = index_->locator.has_value();
    std::array<double, 1> lowest{static_cast<double>(has_cells ? exchange_.rank() : exchange_.size())};
    exchange_.least(lowest);
    const int from = lowest[0] < exchange_.size() ? static_cast<int>(lowest[0]) : 0;
    std::vector<unsigned char> bytes;
    Status read = exchange_.everywhere([&]() -> Status {
        if (exchange_.rank() == from) bytes = to_bytes(kinds_);
        return Done{};
    });
    if (!read) return read;
    if (Status done = exchange_.broadcast(bytes, from); !done) return done;
    return exchange_.everywhere([&]() -> Status {
        std::vector<ArrayKind> kinds = kinds_from(bytes);
        if (has_cells) {
            if (std::string differs = difference(kinds_, kinds); !differs.empty())
                return Error{.what = "the source has other arrays than that of rank " + std::to_string(from) + ": " +
                                     differs};
        }
        kinds_ = std::move(kinds);
        return Done{};
    });
}

Status DistributedProbe::gather_pieces() {
    std::array<double, piece_size> mine{};
    std::vector<double> all;
    Status read = exchange_.everywhere([&]() -> Status {
        write(box_of_cells(*index_), mine.data());
        write(box_of_points(*input_), mine.data() + box_size);
        mine[2 * box_size] = index_->locator ? static_cast<double>(index_->mesh.cell_count()) : 0;
        mine[2 * box_size + 1] = static_cast<double>(count_);
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
        if (static_cast<int>(r) < exchange_.rank()) first_number_ += static_cast<std::int64_t>(pieces_[r].cell_count);
    }
    return Done{};
}

bool DistributedProbe::asks(int who, int whom) const {
    return who != whom &&
           pieces_[static_cast<std::size_t>(who)].points.meets(pieces_[static_cast<std::size_t>(whom)].cells);
}

// Whether finer boxes are likely to keep more bytes than they have: both ranks answer alike.
bool DistributedProbe::asks_much(int who, int whom) const {
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

Status DistributedProbe::find_partners() {
    return exchange_.everywhere([&]() -> Status {
        std::vector<int> partners;
        const int rank = exchange_.rank();
        for (int other = 0; other < exchange_.size(); ++other)
            if (asks(rank, other) || asks(other, rank)) partners.push_back(other);
        exchange_.set_partners(std::move(partners));
        return Done{};
    });
}

Status DistributedProbe::swap_boxes() {
    Parcels<double> out;
    Status room = exchange_.everywhere([&]() -> Status {
        const int rank = exchange_.rank();
        const auto size = [&](bool much) { return much ? fine * box_size : 0; };
        std::vector<double> mine;
        for (const int other : exchange_.partners()) {
            if (asks_much(other, rank) && mine.empty()) {
                Gathered gathered(pieces_[static_cast<std::size_t>(rank)].cells);
                for (std::size_t i = 0; i < index_->mesh.cell_count(); ++i) gathered.add(box_of(*index_, i));
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

// Sets asked_ and points_.
void DistributedProbe::read_points(const std::vector<Box>& boxes, const std::vector<int>& owners) {
    const std::size_t partners = exchange_.partners().size();
    const BoxTree tree(boxes, owners);
    std::vector<std::vector<vtkIdType>> of(partners);
    std::vector<vtkIdType> last(partners, -1);
    for (vtkIdType i = 0; i < count_; ++i) {
        std::array<double, 3> x{};
        input_->GetPoint(i, x.data());
        if (!finite(x.data())) continue;
        tree.holders(x.data(), [&](int k) {
            const auto partner = static_cast<std::size_t>(k);
            if (std::exchange(last[partner], i) != i) of[partner].push_back(i);
        });
    }
    for (std::vector<vtkIdType>& some : of) {
        for (const vtkIdType i : some) {
            std::array<double, 3> x{};
            input_->GetPoint(i, x.data());
            points_.values.insert(points_.values.end(), x.begin(), x.end());
        }
        points_.close();
        asked_.values.insert(asked_.values.end(), some.begin(), some.end());
        asked_.close();
        some = {};
    }
}

Status DistributedProbe::swap_points() {
    Status room = exchange_.everywhere([&]() -> Status {
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
        read_points(boxes, owners);
        return Done{};
    });
    if (!room) return room;
    if (Status done = exchange_.swap(points_, received_); !done) return done;
    points_sent_ = points_.values.size() / 3;
    points_received_ = received_.values.size() / 3;
    points_ = {};
    return Done{};
}

Status DistributedProbe::sample() {
    return exchange_.everywhere([&]() -> Status {
        const auto asked = static_cast<vtkIdType>(points_received_);
        const std::size_t tuples = static_cast<std::size_t>(count_) + points_received_;
        arrays_->allocate(count_ + asked, settings_.outside);
        owners_.assign(tuples, -1);
        arrays_->keep_owners(owners_);
        if (index_->locator) {
            const Result<Sampler> sampler = Sampler::build(*index_->locator, arrays_->choices());
            if (!sampler) return sampler.error();
            if (Status done = sample_data_set(*sampler, *index_, *input_, {}, 0, *arrays_); !done) return done;
            vtkNew<vtkDoubleArray> coordinates;
            coordinates->SetNumberOfComponents(3);
            coordinates->SetArray(received_.values.data(), 3 * asked, 1);
            vtkNew<vtkPoints> points;
            points->SetData(coordinates);
            vtkNew<vtkPolyData> data;
            data->SetPoints(points);
            arrays_->start_at(count_);
            if (Status done = sample_data_set(*sampler, *index_, *data, {}, 0, *arrays_); !done) return done;
        }
        received_.values = {};
        // Arrays of a rank without cells are not those of the others.
        for (const ArrayKind& kind : kinds_) {
            vtkAbstractArray* const own = index_->locator ? find(*scratch_->GetPointData(), kind) : nullptr;
            columns_.push_back(own != nullptr ? in_standard_layout(*own) : make(kind, count_, settings_.outside));
        }
        mask_ = arrays_->mask();
        return Done{};
    });
}

std::int64_t DistributedProbe::number(Mesh::Index cell) const {
    return numbers_.empty() ? first_number_ + cell : numbers_[static_cast<std::size_t>(cell)];
}

// For each point that the partner asked for a bit, set if it has an owner here; for each of these the number of the
// owner, and the tuples.
void DistributedProbe::append_values(std::size_t partner) {
    const std::size_t count = received_.size(partner) / 3,
                      first = static_cast<std::size_t>(count_) + received_.begin[partner] / 3;
    const std::size_t bits = answers_.values.size();
    answers_.values.resize(bits + (count + 7) / 8);
    for (std::size_t i = 0; i < count; ++i) {
        const Mesh::Index owner = owners_[first + i];
        if (owner < 0) continue;
        answers_.values[bits + i / 8] = static_cast<char>(answers_.values[bits + i / 8] | 1 << i % 8);
        const std::int64_t its = number(owner);
        const std::size_t at = answers_.values.size();
        answers_.values.resize(at + sizeof its);
        std::memcpy(answers_.values.data() + at, &its, sizeof its);
        for (const auto& column : columns_) put(*column, static_cast<vtkIdType>(first + i), answers_.values);
    }
    answers_.close();
}

Status DistributedProbe::swap_values() {
    Status room = exchange_.everywhere([&]() -> Status {
        for (std::size_t k = 0; k < exchange_.partners().size(); ++k) append_values(k);
        if (exchange_.partners().empty()) return Done{};
        best_.resize(static_cast<std::size_t>(count_));
        for (std::size_t i = 0; i < best_.size(); ++i)
            if (owners_[i] >= 0) best_[i] = number(owners_[i]);
        return Done{};
    });
    if (!room) return room;
    return exchange_.swap(answers_, answered_);
}

// Answers come by rank, from the next lower one down and from the next higher one up: of equal numbers, which are those
// of copies of one cell, that of the lowest rank stays.
void DistributedProbe::merge_values(std::size_t partner) {
    const bool lower = exchange_.partners()[partner] < exchange_.rank();
    const std::span<const vtkIdType> asked = asked_.of(partner);
    const char* const bits = answered_.of(partner).data();
    const char* bytes = bits + (asked.size() + 7) / 8;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        if ((bits[i / 8] >> i % 8 & 1) == 0) continue;
        std::int64_t its = 0;
        std::memcpy(&its, bytes, sizeof its);
        bytes += sizeof its;
        char& valid = *mask_->GetPointer(asked[i]);
        std::int64_t& best = best_[static_cast<std::size_t>(asked[i])];
        const bool better = valid == 0 || its < best || (its == best && lower);
        if (better) {
            valid = 1;
            best = its;
        }
        for (const auto& column : columns_) bytes = better ? take(*column, asked[i], bytes) : skip(*column, bytes);
    }
}

Status DistributedProbe::write_output(vtkDataSet* output) {
    return exchange_.everywhere([&]() -> Status {
        answers_ = {};
        owners_ = {};
        // Tuples of others' points go.
        mask_->Resize(count_);
        for (const auto& column : columns_) column->Resize(count_);
        std::vector<std::size_t> order(exchange_.partners().size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
        const auto place = [&](std::size_t k) {
            const int other = exchange_.partners()[k], rank = exchange_.rank();
            return other < rank ? rank - other : other;
        };
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
        for (const std::size_t k : order) merge_values(k);
        vtkPointData& out = *output->GetPointData();
        for (std::size_t i = 0; i < kinds_.size(); ++i) {
            const int at = out.AddArray(columns_[i]);
            if (kinds_[i].role >= 0) out.SetActiveAttribute(at, kinds_[i].role);
        }
        out.AddArray(mask_);
        return Done{};
    });
}

}  // namespace barycert::in_vtk
