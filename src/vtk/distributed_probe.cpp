#include "vtk/distributed_probe.hpp"

#include <cstring>

#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include "barycert/environment.hpp"
#include "mesh/pieces/distribution.hpp"
#include "vtk/probe_arrays.hpp"

namespace barycert::in_vtk {
namespace {

using pieces::ArrayKind;

// Bytes of a tuple, where it stands in one piece; 0 elsewhere.
std::size_t width(vtkAbstractArray& array) {
    if (array.IsNumeric() == 0 || array.GetDataType() == VTK_BIT) return 0;
    return static_cast<std::size_t>(array.GetDataTypeSize()) * static_cast<std::size_t>(array.GetNumberOfComponents());
}

// Kinds of all arrays but the one of that name, and that of ghosts.
std::vector<ArrayKind> kinds_of(vtkDataSetAttributes& attributes, const char* but) {
    std::vector<ArrayKind> kinds;
    for (int i = 0; i < attributes.GetNumberOfArrays(); ++i) {
        vtkAbstractArray& array = *attributes.GetAbstractArray(i);
        const char* const name = array.GetName();
        if (name == nullptr && attributes.IsArrayAnAttribute(i) < 0) continue;
        // Flags of ghosts tell of the pieces, and not of the mesh.
        if (name != nullptr &&
            (std::string_view(name) == but || vtkDataSetAttributes::GhostArrayName() == std::string_view(name)))
            continue;
        ArrayKind kind{.name = name != nullptr ? name : "",
                       .named = name != nullptr,
                       .type = array.GetDataType(),
                       .type_name = vtkImageScalarTypeNameMacro(array.GetDataType()),
                       .components = array.GetNumberOfComponents(),
                       .role = attributes.IsArrayAnAttribute(i)};
        if (array.HasAComponentName()) {
            for (int c = 0; c < kind.components; ++c) {
                const char* const of_component = array.GetComponentName(c);
                kind.component_names.emplace_back(of_component != nullptr ? of_component : "");
            }
        }
        kinds.push_back(std::move(kind));
    }
    return kinds;
}

// Why tuples of some array cannot be sent; empty if they can.
std::string fault_of(const std::vector<ArrayKind>& kinds) {
    for (const ArrayKind& kind : kinds) {
        const auto made = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(kind.type));
        if (made == nullptr || (made->IsNumeric() == 0 && kind.type != VTK_STRING))
            return "the source has what cannot be sent from rank to rank: " + kind.text();
    }
    return {};
}

// A new one; real numbers are `outside`, others zero.
vtkSmartPointer<vtkAbstractArray> make(const ArrayKind& kind, vtkIdType tuples, double outside) {
    auto array = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(kind.type));
    if (kind.named) array->SetName(kind.name.c_str());
    array->SetNumberOfComponents(kind.components);
    for (std::size_t c = 0; c < kind.component_names.size(); ++c)
        array->SetComponentName(static_cast<vtkIdType>(c), kind.component_names[c].c_str());
    prepare(*array, tuples, outside);
    return array;
}

// Tuples of arrays whose values stand one after the other, of bits (a byte each), and of texts (their size goes first).
struct ArrayTuples : pieces::Tuples {
    void put(std::size_t tuple, std::vector<char>& bytes) const override {
        const auto append = [&](const char* from, std::size_t count) { bytes.insert(bytes.end(), from, from + count); };
        for_each(tuple, append, [&](vtkAbstractArray* array, vtkIdType at) {
            if (auto* const texts = vtkStringArray::SafeDownCast(array)) {
                const std::string text = texts->GetValue(at);
                const std::uint64_t size = text.size();
                append(reinterpret_cast<const char*>(&size), sizeof size);
                append(text.data(), text.size());
            } else {
                bytes.push_back(vtkBitArray::SafeDownCast(array)->GetValue(at) != 0 ? 1 : 0);
            }
        });
    }

    const char* take(std::size_t tuple, const char* bytes, bool set) override {
        const auto copy = [&](char* to, std::size_t size) {
            if (set) std::memcpy(to, bytes, size);
            bytes += size;
        };
        for_each(tuple, copy, [&](vtkAbstractArray* array, vtkIdType at) {
            std::uint64_t size = 1;
            if (auto* const texts = vtkStringArray::SafeDownCast(array)) {
                std::memcpy(&size, bytes, sizeof size);
                bytes += sizeof size;
                if (set) texts->SetValue(at, vtkStdString(std::string(bytes, size)));
            } else if (set) {
                vtkBitArray::SafeDownCast(array)->SetValue(at, *bytes);
            }
            bytes += size;
        });
        return bytes;
    }

    std::vector<vtkSmartPointer<vtkAbstractArray>> arrays;

private:
    // whole(memory, bytes) where the tuple stands in one piece, else item(array, index of a value).
    template <class Whole, class Item>
    void for_each(std::size_t tuple, const Whole& whole, const Item& item) const {
        for (vtkAbstractArray* const array : arrays) {
            const auto components = static_cast<vtkIdType>(array->GetNumberOfComponents());
            if (const std::size_t size = width(*array); size > 0) {
                whole(static_cast<char*>(array->GetVoidPointer(0)) + size * tuple, size);
                continue;
            }
            for (vtkIdType c = 0; c < components; ++c) item(array, components * static_cast<vtkIdType>(tuple) + c);
        }
    }
};

class Probe {
public:
    Probe(pieces::Exchange& exchange, const ProbeSettings& settings, vtkDataSet* input, vtkDataSet* source,
          ProbeReport& report)
        : exchange_(exchange), settings_(settings), input_(input), source_(source), report_(report) {}

    Status run(const Status& ready, vtkDataSet* output) {
        if (Status done = agree_on_cells(ready); !done) return done;
        if (Status done = index_piece(); !done) return done;
        if (Status done = agree_on_arrays(exchange_, index_->locator.has_value(), kinds_); !done) return done;
        pieces::Distribution distribution(exchange_, *index_, {count_, [&](std::size_t i, double* x) {
                                                                   input_->GetPoint(static_cast<vtkIdType>(i), x);
                                                               }});
        if (Status done = distribution.ask(); !done) return done;
        report_.points_sent = distribution.points_sent();
        report_.points_received = distribution.points_received();
        if (Status done = sample(distribution); !done) return done;
        if (Status done = distribution.swap_values(owners_, numbers_, columns_); !done) return done;
        return exchange_.everywhere([&]() -> Status {
            note(distribution, shape_.by_numbers,
                 "the cells of some source have no global ids: they are numbered by process, and owners of points on "
                 "seams depend on how the mesh is cut");
            note(distribution, shape_.nodes_by_numbers,
                 "the points of some source have no global ids: cells are cut as each process numbers their nodes, and "
                 "values in them depend on how the mesh is cut");
            owners_ = {};
            // Tuples of others' points go.
            report_.mask->Resize(static_cast<vtkIdType>(count_));
            for (const auto& column : columns_.arrays) column->Resize(static_cast<vtkIdType>(count_));
            distribution.merge(columns_, report_.mask->GetPointer(0));
            vtkPointData& out = *output->GetPointData();
            for (std::size_t i = 0; i < kinds_.size(); ++i) {
                const int at = out.AddArray(columns_.arrays[i]);
                if (kinds_[i].role >= 0) out.SetActiveAttribute(at, kinds_[i].role);
            }
            out.AddArray(report_.mask);
            return Done{};
        });
    }

private:
    static Error not_exact(const std::string& why) {
        return Error{.code = "rank.source", .what = "the source cannot be probed exactly: " + why};
    }

    void note(const pieces::Distribution& distribution, bool has_numbers, const char* text) {
        if (!has_numbers && distribution.ranks_with_cells() > 1 && exchange_.rank() == 0)
            report_.notes.push_back({Note::Kind::guessed, text, {}, true});
    }

    Status agree_on_cells(const Status& ready) {
        Status read = exchange_.everywhere([&]() -> Status {
            if (!ready) return ready;
            if (source_ == nullptr) source_ = vtkSmartPointer<vtkUnstructuredGrid>::New();
            if (std::string fault = look_at_cells(*source_, facts_); !fault.empty()) return not_exact(fault);
            if (facts_.dimension >= 2 && facts_.numbered) {
                vtkCellData& cells = *source_->GetCellData();
                if (std::string fault = fault_of_global_ids(cells, source_->GetNumberOfCells(), "cell"); !fault.empty())
                    return Error{.code = "rank.source",
                                 .what = "the source cannot be probed by several processes: " + fault};
            }
            count_ = static_cast<std::size_t>(input_->GetNumberOfPoints());
            return Done{};
        });
        if (!read) return read;
        const Result<pieces::Shape> shape = agree_on_shape(exchange_, facts_);
        if (!shape) return not_exact(shape.error().what);
        shape_ = *shape;
        shape_.interpolation = settings_.cells.interpolation;
        shape_.curved = settings_.cells.curved;
        return Done{};
    }

    Status index_piece() {
        return exchange_.everywhere([&]() -> Status {
            index_ = exact_index(*source_, shape_);
            if (!index_->exact()) return not_exact(index_->reason);
            report_.notes = index_->notes;
            if (exchange_.size() > 1 && shape_.by_numbers && index_->locator) numbers_ = global_ids(*source_, *index_);
            const bool categorical = settings_.categorical && index_->locator;
            if (std::string fault = fault_of_arrays(*source_, categorical); !fault.empty())
                return Error{.code = "rank.source", .what = fault};
            arrays_.emplace(*index_, *source_, *scratch_, settings_.categorical, settings_.mask.c_str());
            report_.inexact = arrays_->inexact();
            kinds_ = kinds_of(*scratch_->GetPointData(), settings_.mask.c_str());
            if (std::string fault = fault_of(kinds_); !fault.empty())
                return Error{.code = "rank.source", .what = fault};
            return Done{};
        });
    }

    // At this rank's points, and then at those that it is asked for.
    Status sample(pieces::Distribution& distribution) {
        return exchange_.everywhere([&]() -> Status {
            std::vector<double> others = distribution.points_of_others();
            const std::size_t tuples = count_ + others.size() / 3;
            arrays_->allocate(static_cast<vtkIdType>(tuples), settings_.outside);
            owners_.assign(tuples, -1);
            arrays_->keep_owners(owners_);
            if (index_->locator) {
                const Result<Sampler> sampler = Sampler::build(*index_->locator, arrays_->choices());
                if (!sampler) return sampler.error();
                if (Status done = sample_data_set(*sampler, *index_, *input_, 0, *arrays_); !done) return done;
                vtkNew<vtkDoubleArray> coordinates;
                coordinates->SetNumberOfComponents(3);
                coordinates->SetArray(others.data(), static_cast<vtkIdType>(others.size()), 1);
                vtkNew<vtkPoints> points;
                points->SetData(coordinates);
                vtkNew<vtkPolyData> data;
                data->SetPoints(points);
                arrays_->start_at(static_cast<vtkIdType>(count_));
                if (Status done = sample_data_set(*sampler, *index_, *data, 0, *arrays_); !done) return done;
            }
            // Arrays of a rank without cells are not those of the others.
            for (const ArrayKind& kind : kinds_) {
                const char* const name = kind.named ? kind.name.c_str() : nullptr;
                vtkSmartPointer<vtkAbstractArray> own;
                if (index_->locator) own = array_in(*scratch_->GetPointData(), name, kind.role);
                if (own == nullptr) own = make(kind, static_cast<vtkIdType>(count_), settings_.outside);
                columns_.arrays.push_back(own);
            }
            report_.mask = arrays_->mask();
            return Done{};
        });
    }

    pieces::Exchange& exchange_;
    const ProbeSettings& settings_;
    vtkDataSet* input_;
    vtkSmartPointer<vtkDataSet> source_;
    ProbeReport& report_;
    std::size_t count_ = 0;  ///< of this rank's points

    pieces::PieceFacts facts_;
    pieces::Shape shape_;
    std::shared_ptr<const ExactIndex> index_;
    std::vector<std::int64_t> numbers_;  ///< of the mesh's cells; empty: as they come, after those of lower ranks
    vtkNew<vtkPolyData> scratch_;        ///< its point data has the arrays
    std::optional<ProbeArrays> arrays_;
    std::vector<ArrayKind> kinds_;
    ArrayTuples columns_;              ///< of each kind
    std::vector<Mesh::Index> owners_;  ///< of each tuple
};

}  // namespace

void Processes::least(std::span<double> values) {
    // A place of its own, for memory may be lacking.
    std::array<double, 16> mine{};
    for (; !values.empty(); values = values.subspan(std::min(mine.size(), values.size()))) {
        const std::size_t some = std::min(mine.size(), values.size());
        std::copy_n(values.begin(), some, mine.begin());
        controller_->AllReduce(mine.data(), values.data(), static_cast<vtkIdType>(some), vtkCommunicator::MIN_OP);
    }
}

Status probe_pieces(pieces::Exchange& exchange, const ProbeSettings& settings, const Status& ready, vtkDataSet* input,
                    vtkDataSet* source, vtkDataSet* output, ProbeReport& report) {
    const ExactEnvironment environment;
    return Probe(exchange, settings, input, source, report).run(ready, output);
}

}  // namespace barycert::in_vtk
