#include "vtk/probe_arrays.hpp"

#include <cstring>

#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkCharArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>

#include "barycert/grid.hpp"

namespace barycert::in_vtk {
namespace {

// From a correctly rounded double to a value of another type, as if the exact value had been rounded once. `side(t)`
// tells the sign of the exact value less t, and is asked only where `value` lies in the middle between two values of T.
// To float: nearest, ties to even. To integers: nearest, halves away from zero, within the range of T, and 0 for NaN,
// as VTK rounds.
template <class T, class Side>
T once_rounded(double value, Side&& side) {
    if constexpr (std::is_same_v<T, double>) {
        return value;
    } else if constexpr (std::is_same_v<T, float>) {
        const auto near = static_cast<float>(value);
        if (static_cast<double>(near) == value || !std::isfinite(near)) return near;
        const float other = std::nextafter(near, static_cast<double>(near) < value ? HUGE_VALF : -HUGE_VALF);
        // Both have 24 bits: their mean is a double.
        if (!std::isfinite(other) || (static_cast<double>(near) + static_cast<double>(other)) / 2 != value) return near;
        const Sign rest = side(value);
        if (rest == Sign::zero) return near;
        return (rest == Sign::positive) == (other > near) ? other : near;
    } else {
        if (std::isnan(value)) return 0;
        double whole = std::round(value);
        if (std::abs(value - std::trunc(value)) == 0.5) {
            const Sign rest = side(value);
            if (rest == (value > 0 ? Sign::negative : Sign::positive)) whole = std::trunc(value);
        }
        // The bounds are powers of two, or one less: as doubles they are never below what T holds.
        if (whole <= static_cast<double>(std::numeric_limits<T>::min())) return std::numeric_limits<T>::min();
        if (whole >= static_cast<double>(std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
        return static_cast<T>(whole);
    }
}

bool is_real(vtkAbstractArray& array) {
    return array.GetDataType() == VTK_DOUBLE || array.GetDataType() == VTK_FLOAT;
}

// The numbers of the array as doubles, tuple after tuple. `exact`: whether they are the same numbers.
Field field_of(vtkDataArray& array, std::size_t number, bool& exact) {
    Field field{std::to_string(number), array.GetNumberOfComponents(), {}};
    field.data.resize(static_cast<std::size_t>(array.GetNumberOfValues()));
    if (!field.data.empty()) {
        vtkNew<vtkDoubleArray> doubles;
        doubles->SetNumberOfComponents(field.components);
        doubles->SetArray(field.data.data(), array.GetNumberOfValues(), 1);
        doubles->InsertTuples(0, array.GetNumberOfTuples(), 0, &array);
    }
    exact = is_real(array) ||
            std::all_of(field.data.begin(), field.data.end(), [](double x) { return std::abs(x) <= 0x1p53; });
    return field;
}

// The points of the data set where they are finite doubles already, on the axes of the mesh; else empty.
std::span<const double> own_coordinates(const ExactIndex& index, vtkDataSet& input) {
    auto* const set = vtkPointSet::SafeDownCast(&input);
    if (set == nullptr || index.normal >= 0 || input.GetNumberOfPoints() == 0) return {};
    auto* const doubles = vtkDoubleArray::FastDownCast(set->GetPoints()->GetData());
    if (doubles == nullptr) return {};
    const std::span<const double> all(doubles->GetPointer(0), 3 * static_cast<std::size_t>(input.GetNumberOfPoints()));
    return pieces::all_finite(all) ? all : std::span<const double>();
}

// The points of an image as a grid that has them to the bit, x fastest; none if it is no image along the axes.
std::optional<Grid> probe_grid(const ExactIndex& index, vtkDataSet& input) {
    auto* const image = vtkImageData::SafeDownCast(&input);
    if (image == nullptr || index.normal >= 0 || !image->GetDirectionMatrix()->IsIdentity()) return std::nullopt;
    const int* const extent = image->GetExtent();
    Grid grid;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        const int low = extent[2 * axis], high = extent[2 * axis + 1];
        if (high < low) return std::nullopt;
        const auto coordinate = [&](int i) {
            int ijk[3] = {extent[0], extent[2], extent[4]};
            double x[3];
            ijk[axis] = i;
            image->TransformIndexToPhysicalPoint(ijk, x);
            return x[axis];
        };
        grid.counts[k] = static_cast<std::int64_t>(high) - low + 1;
        grid.origin[k] = coordinate(low);
        grid.spacing[k] = image->GetSpacing()[axis];
        grid.last[k] = coordinate(high);
        if (!std::isfinite(grid.origin[k]) || !std::isfinite(grid.last[k]) || !(grid.spacing[k] > 0))
            return std::nullopt;
        for (int i = low; i <= high; ++i)
            if (grid.coordinate(k, i - low) != coordinate(i)) return std::nullopt;
    }
    return grid;
}

Status sample_grid(const Sampler& sampler, const Grid& grid, const SampleOptions& options, ProbeArrays& arrays) {
    const auto nx = static_cast<std::uint64_t>(grid.counts[0]), ny = static_cast<std::uint64_t>(grid.counts[1]);
    const Result<SampleCounts> done = resample(sampler, grid, options, [&](const TableView& rows) -> Status {
        const auto place = [&](std::size_t row, double* point) {
            const std::uint64_t id = rows.first_row + row;
            point[0] = grid.coordinate(0, static_cast<std::int64_t>(id % nx));
            point[1] = grid.coordinate(1, static_cast<std::int64_t>(id / nx % ny));
            point[2] = grid.coordinate(2, static_cast<std::int64_t>(id / nx / ny));
        };
        arrays.write(rows, nullptr, static_cast<vtkIdType>(rows.first_row), place);
        return Done{};
    });
    return done ? Status(Done{}) : done.error();
}

// sample(points, number of the first, rows) sets cells and values. Points that are not finite, or farther off the plane
// of the mesh than the tolerance, are left out.
template <class Sample>
Status sample_points(const ExactIndex& index, vtkDataSet& input, double tolerance, ProbeArrays& arrays,
                     const Sample& sample) {
    constexpr vtkIdType block = vtkIdType{1} << 20;
    const std::size_t d = index.in_space() ? 3 : static_cast<std::size_t>(index.mesh.dimension);
    const std::span<const double> all = own_coordinates(index, input);
    std::vector<double> copied;
    std::vector<vtkIdType> ids;
    Table rows;
    for (vtkIdType first = 0, count = input.GetNumberOfPoints(); first < count; first += block) {
        const vtkIdType last = first + std::min(block, count - first);
        copied.clear();
        ids.clear();
        for (vtkIdType i = first; all.empty() && i < last; ++i) {
            std::array<double, 3> x{}, point{};
            input.GetPoint(i, x.data());
            if (!pieces::all_finite(x)) continue;
            if (!index.project(x.data(), point.data()) &&
                !(std::abs(x[static_cast<std::size_t>(index.normal)] - index.plane) <= tolerance))
                continue;
            copied.insert(copied.end(), point.begin(), point.begin() + static_cast<std::ptrdiff_t>(d));
            ids.push_back(i);
        }
        const auto from = static_cast<std::size_t>(first), size = static_cast<std::size_t>(last - first);
        const std::span<const double> some =
            all.empty() ? std::span<const double>(copied) : all.subspan(d * from, d * size);
        if (Status done = sample(some, from, rows); !done) return done;
        const auto place = [&](std::size_t row, double* point) { std::copy_n(some.data() + d * row, d, point); };
        arrays.write(rows.view(), all.empty() ? ids.data() : nullptr, first, place);
    }
    return Done{};
}

}  // namespace

std::string fault_of_arrays(vtkDataSet& source, bool categorical) {
    vtkDataArray* const scalars = source.GetPointData()->GetScalars();
    if (categorical && (scalars == nullptr || scalars->GetNumberOfComponents() != 1))
        return "CategoricalData takes point scalars of one component, of the source";
    const auto look = [](vtkDataSetAttributes& attributes, vtkIdType count, const char* what) {
        for (int i = 0; i < attributes.GetNumberOfArrays(); ++i) {
            vtkAbstractArray& array = *attributes.GetAbstractArray(i);
            if (array.GetNumberOfTuples() == count) continue;
            return std::string("the source has an array ") + (array.GetName() != nullptr ? array.GetName() : "") +
                   " of " + std::to_string(array.GetNumberOfTuples()) + " tuples, and " + std::to_string(count) + what;
        }
        return std::string();
    };
    const std::string fault = look(*source.GetPointData(), source.GetNumberOfPoints(), " points");
    return fault.empty() ? look(*source.GetCellData(), source.GetNumberOfCells(), " cells") : fault;
}

vtkAbstractArray* array_in(vtkDataSetAttributes& attributes, const char* name, int role) {
    if (name != nullptr) return attributes.GetAbstractArray(name);
    return role < 0 ? nullptr : attributes.GetAbstractAttribute(role);
}

void prepare(vtkAbstractArray& array, vtkIdType count, double outside) {
    array.SetNumberOfTuples(count);
    if (auto* const data = vtkDataArray::SafeDownCast(&array)) data->Fill(is_real(array) ? outside : 0);
}

ProbeArrays::ProbeArrays(const ExactIndex& index, vtkDataSet& source, vtkDataSet& output, bool categorical,
                         const char* mask_name)
    : index_(index) {
    vtkNew<vtkCharArray> mask;
    mask->SetName(mask_name);
    mask_ = mask;
    add_point_arrays(source, output, categorical);
    add_cell_arrays(source, output);
    output.GetPointData()->AddArray(mask);
}

void ProbeArrays::allocate(vtkIdType points, double outside) {
    for (vtkAbstractArray* const array : made_) prepare(*array, points, outside);
    prepare(*mask_, points, 0);
}

void ProbeArrays::add_point_arrays(vtkDataSet& source, vtkDataSet& output, bool categorical) {
    vtkPointData* const out = output.GetPointData();
    vtkPointData* const from = source.GetPointData();
    if (categorical) out->SetCopyAttribute(vtkDataSetAttributes::SCALARS, 2, vtkDataSetAttributes::INTERPOLATE);
    // In the order of vtkProbeFilter: attributes come first.
    vtkDataSetAttributes::FieldList list(1);
    list.InitializeFieldList(from);
    out->InterpolateAllocate(list, 1, 1);
    out->RemoveArray(mask_->GetName());  // the mask of an earlier probe would be replaced by this one's
    for (int i = 0; i < out->GetNumberOfArrays(); ++i) {
        vtkAbstractArray* const to = out->GetAbstractArray(i);
        vtkAbstractArray* const its = array_in(*from, to->GetName(), out->IsArrayAnAttribute(i));
        if (its == nullptr) continue;
        made_.push_back(to);
        auto* const numbers = vtkDataArray::SafeDownCast(its);
        if (numbers == nullptr) {
            mixed_.push_back({its, to});
        } else if (categorical && out->IsArrayAnAttribute(i) == vtkDataSetAttributes::SCALARS) {
            nearest_.push_back({its, to});
        } else {
            bool exact = true;
            sampled_.push_back({vtkDataArray::SafeDownCast(to), fields_.size(), columns_});
            columns_ += static_cast<std::size_t>(numbers->GetNumberOfComponents());
            fields_.push_back(field_of(*numbers, fields_.size(), exact));
            if (!exact) inexact_.emplace_back(numbers->GetName() != nullptr ? numbers->GetName() : "(without a name)");
        }
    }
}

void ProbeArrays::add_cell_arrays(vtkDataSet& source, vtkDataSet& output) {
    vtkNew<vtkCellData> made;
    made->CopyAllOn(vtkDataSetAttributes::COPYTUPLE);
    vtkDataSetAttributes::FieldList list(1);
    list.InitializeFieldList(source.GetCellData());
    made->CopyAllocate(list, 1, 1);
    for (int i = 0; i < made->GetNumberOfArrays(); ++i) {
        vtkDataArray* const to = made->GetArray(i);
        if (to == nullptr || to->GetName() == nullptr || output.GetPointData()->HasArray(to->GetName()) != 0) continue;
        if (std::strcmp(to->GetName(), mask_->GetName()) == 0) continue;
        vtkAbstractArray* const from = source.GetCellData()->GetAbstractArray(to->GetName());
        if (from == nullptr) continue;
        made_.push_back(to);
        output.GetPointData()->AddArray(to);
        of_cells_.push_back({from, to});
    }
}

void ProbeArrays::write(const TableView& rows, const vtkIdType* ids, vtkIdType first, const PlaceOfRow& place) {
    rows_.clear();
    const std::size_t stride = rows.row_count() == 0 ? 0 : rows.values.size() / rows.row_count();
    char* const valid = mask_->GetPointer(0);
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        const vtkIdType point = ids != nullptr ? ids[i] : first + static_cast<vtkIdType>(i);
        ProbedPoint row{first_tuple_ + point, i, rows.cells[i], true};
        if (row.cell < 0 && !cells_.data.empty() && !std::isnan(rows.values[i * stride + columns_]))
            row = {row.point, i, static_cast<Mesh::Index>(rows.values[i * stride + columns_]), false};
        if (row.cell < 0) continue;
        valid[row.point] = 1;
        if (owners_ != nullptr) (*owners_)[static_cast<std::size_t>(row.point)] = row.cell;
        rows_.push_back(row);
    }
    for (const Sampled& array : sampled_) {
        // Arrays that FieldList makes have their values one after the other, except arrays of bits.
        if (auto* const bits = vtkBitArray::SafeDownCast(array.to)) {
            write_values<char>(array, rows, stride, place, [&](vtkIdType at, char bit) { bits->SetValue(at, bit); });
            continue;
        }
        const auto write_to = [&]<class T>(T* out) {
            write_values<T>(array, rows, stride, place, [&](vtkIdType at, T value) { out[at] = value; });
        };
        switch (array.to->GetDataType()) {
            vtkTemplateMacro(write_to(static_cast<VTK_TT*>(array.to->GetVoidPointer(0))));
        }
    }
    write_nodes(place);
    write_cells();
}

// The sign of the exact value less a threshold, where rounding twice could make a difference.
Sign ProbeArrays::side(const Sampled& array, int component, const ProbedPoint& row, const PlaceOfRow& place,
                       double threshold) const {
    // A value at the nearest point, which is rounded itself; or one that is not linear.
    if (!row.inside || !index_.straight(row.cell)) return Sign::zero;
    const Field& field = fields_[array.field];
    const Mesh& mesh = index_.mesh;
    std::array<double, 3> point{};
    std::array<double, 4> values{};
    place(row.row, point.data());
    for (std::size_t k = 0; k < mesh.corners(); ++k) {
        const auto node = static_cast<std::size_t>(mesh.cells[mesh.corners() * static_cast<std::size_t>(row.cell) + k]);
        values[k] = field.data[static_cast<std::size_t>(field.components) * node + static_cast<std::size_t>(component)];
    }
    const Result<Sign> sign =
        compare_value(index_.simplex(), index_.vertices(row.cell).data(), point.data(), values.data(), threshold);
    return sign ? *sign : Sign::zero;
}

template <class T, class Set>
void ProbeArrays::write_values(const Sampled& array, const TableView& rows, std::size_t stride, const PlaceOfRow& place,
                               const Set& set) const {
    const int components = fields_[array.field].components;
    for (const ProbedPoint& row : rows_) {
        const double* const values = rows.values.data() + row.row * stride + array.column;
        for (int c = 0; c < components; ++c)
            set(row.point * components + c,
                once_rounded<T>(values[c], [&](double t) { return side(array, c, row, place, t); }));
    }
}

// Writes what depends on the weights of the vertices alone.
void ProbeArrays::write_nodes(const PlaceOfRow& place) const {
    if (nearest_.empty() && mixed_.empty()) return;
    vtkNew<vtkIdList> nodes;
    std::vector<double> weights;
    for (const ProbedPoint& row : rows_) {
        std::array<double, 3> point{}, x{};
        place(row.row, point.data());
        index_.place(point.data(), x.data());
        nodes->Reset();
        for (const Mesh::Index node : index_.nodes_of(index_.whole_of(row.cell))) nodes->InsertNextId(node);
        weights.resize(static_cast<std::size_t>(nodes->GetNumberOfIds()));
        index_.weights_of_nodes(row.cell, x.data(), row.inside, *nodes, weights.data());
        const auto greatest = std::max_element(weights.begin(), weights.end());
        const vtkIdType node = nodes->GetId(greatest - weights.begin());
        for (const Copied& array : nearest_) array.to->SetTuple(row.point, node, array.from);
        for (const Copied& array : mixed_) array.to->InterpolateTuple(row.point, nodes, array.from, weights.data());
    }
}

void ProbeArrays::write_cells() const {
    if (of_cells_.empty() || rows_.empty()) return;
    vtkNew<vtkIdList> points, cells;
    points->SetNumberOfIds(static_cast<vtkIdType>(rows_.size()));
    cells->SetNumberOfIds(static_cast<vtkIdType>(rows_.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        points->SetId(static_cast<vtkIdType>(i), rows_[i].point);
        cells->SetId(static_cast<vtkIdType>(i), index_.id(rows_[i].cell));
    }
    for (const Copied& array : of_cells_) array.to->InsertTuples(points, cells, array.from);
}

Status sample_data_set(const Sampler& sampler, const ExactIndex& index, vtkDataSet& input, double tolerance,
                       ProbeArrays& arrays) {
    SampleOptions options;
    if (tolerance > 0) options.outside = {.kind = Outside::nearest, .limit = tolerance};
    if (const std::optional<Grid> grid = probe_grid(index, input)) return sample_grid(sampler, *grid, options, arrays);
    return sample_points(index, input, tolerance, arrays, [&](auto points, std::size_t first, Table& rows) {
        return sampler.sample(points, options, rows, first);
    });
}

Status sample_surface(const ExactIndex& index, vtkDataSet& input, double tolerance, ProbeArrays& arrays) {
    const std::vector<FieldChoice> choices = arrays.choices();
    std::size_t width = 0;
    for (const FieldChoice& choice : choices) width += static_cast<std::size_t>(choice.field->components);
    return sample_points(index, input, tolerance, arrays, [&](auto points, std::size_t, Table& rows) -> Status {
        std::vector<SurfaceNearest> near(points.size() / 3);
        if (Status done = index.on_surface->nearest(points, tolerance, near); !done) return done;
        rows.cells.resize(near.size());
        for (std::size_t i = 0; i < near.size(); ++i) rows.cells[i] = near[i].on ? near[i].cell : -1;
        rows.values.resize(width * near.size());
        double* column = rows.values.data();
        for (const FieldChoice& choice : choices) {
            const auto n = static_cast<std::size_t>(choice.field->components);
            std::vector<double> some(n * near.size());
            Status done = index.on_surface->values(*choice.field, choice.of_cells, points, near, some);
            if (!done) return done;
            for (std::size_t i = 0; i < near.size(); ++i) std::copy_n(&some[n * i], n, column + width * i);
            column += n;
        }
        return Done{};
    });
}

}  // namespace barycert::in_vtk
