#include "vtk/distributed_probe.hpp"

#include <algorithm>
#include <array>
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

Status DistributedProbe::run(const Status& ready, vtkDataSet* input, vtkDataSet* source, vtkDataSet* output) {
    const ExactEnvironment environment;
    input_ = input;
    source_ = source;
    if (Status done = agree_on_cells(ready); !done) return done;
    for (const auto step : {&DistributedProbe::agree_on_plane, &DistributedProbe::index_piece,
                            &DistributedProbe::agree_on_arrays, &DistributedProbe::map_pieces,
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

Status DistributedProbe::map_pieces() {
    if (Status done = map_.gather(*index_, *input_); !done) return done;
    return map_.refine(*index_);
}

Status DistributedProbe::swap_points() {
    Status room = exchange_.everywhere([&]() -> Status {
        map_.points_to_ask(*input_, asked_, points_);
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
    return numbers_.empty() ? map_.cells_before() + cell : numbers_[static_cast<std::size_t>(cell)];
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
