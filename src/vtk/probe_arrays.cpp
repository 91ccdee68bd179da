#include "vtk/probe_arrays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include <vtkCellData.h>
#include <vtkCharArray.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "barycert/weights.hpp"
#include "vtk/closest.hpp"
#include "vtk/once_rounded.hpp"

namespace barycert::in_vtk {

namespace {

bool has_fast_tuples(vtkAbstractArray* a) {
    return a->HasStandardMemoryLayout() && a->IsNumeric() != 0 && a->GetDataType() != VTK_BIT;
}

// The array that `to` was made for: of the same name, or in the same role.
vtkAbstractArray* source_of(vtkDataSetAttributes* from, vtkDataSetAttributes* out, int i, vtkAbstractArray* to) {
    if (to->GetName() != nullptr) return from->GetAbstractArray(to->GetName());
    const int role = out->IsArrayAnAttribute(i);
    return role < 0 ? nullptr : from->GetAbstractAttribute(role);
}

Field field_of(vtkDataArray* array, std::size_t number, bool& exact) {
    Field field{.name = std::to_string(number), .components = array->GetNumberOfComponents(), .data = {}};
    const auto tuples = static_cast<std::size_t>(array->GetNumberOfTuples());
    const auto components = static_cast<std::size_t>(field.components);
    field.data.resize(tuples * components);
    exact = true;
    const auto take = [&](const auto* values) {
        for (std::size_t i = 0; i < field.data.size(); ++i) {
            field.data[i] = static_cast<double>(values[i]);
            if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(*values)>>)
                exact = exact && std::abs(field.data[i]) <= 0x1p53;
        }
    };
    if (has_fast_tuples(array)) {
        switch (array->GetDataType()) { vtkTemplateMacro(take(static_cast<const VTK_TT*>(array->GetVoidPointer(0)))); }
    } else {
        for (std::size_t i = 0; i < tuples; ++i)
            array->GetTuple(static_cast<vtkIdType>(i), field.data.data() + i * components);
    }
    return field;
}

}  // namespace

std::string fault_of_arrays(vtkDataSet& source) {
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

void prepare(vtkAbstractArray& array, vtkIdType count, double outside) {
    array.SetNumberOfTuples(count);
    if (auto* const data = vtkDataArray::SafeDownCast(&array)) {
        const bool real = data->GetDataType() == VTK_DOUBLE || data->GetDataType() == VTK_FLOAT;
        data->Fill(real ? outside : 0);
    }
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
    cells_.name = "cell";
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
        vtkAbstractArray* const its = source_of(from, out, i, to);
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
            fields_.push_back(field_of(numbers, fields_.size(), exact));
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

std::vector<FieldChoice> ProbeArrays::choices() const {
    std::vector<FieldChoice> all;
    for (const Field& field : fields_) all.push_back({.field = &field});
    if (!cells_.data.empty()) all.push_back({.field = &cells_, .of_cells = true});
    return all;
}

void ProbeArrays::number_cells() {
    cells_.data.resize(index_.mesh.cell_count());
    for (std::size_t i = 0; i < cells_.data.size(); ++i) cells_.data[i] = static_cast<double>(i);
}

void ProbeArrays::write(const TableView& rows, const vtkIdType* ids, vtkIdType first, const PlaceOfRow& place) {
    rows_.clear();
    const std::size_t stride = rows.row_count() == 0 ? 0 : rows.values.size() / rows.row_count();
    char* const valid = mask_->GetPointer(0);
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        const vtkIdType point = ids != nullptr ? ids[i] : first + static_cast<vtkIdType>(i);
        Row row{first_tuple_ + point, i, rows.cells[i], true};
        if (row.cell < 0 && !cells_.data.empty() && !std::isnan(rows.values[i * stride + columns_]))
            row = {row.point, i, static_cast<Mesh::Index>(rows.values[i * stride + columns_]), false};
        if (row.cell < 0) continue;
        valid[row.point] = 1;
        if (owners_ != nullptr) (*owners_)[static_cast<std::size_t>(row.point)] = row.cell;
        rows_.push_back(row);
    }
    for (const Sampled& array : sampled_) {
        if (has_fast_tuples(array.to)) {
            switch (array.to->GetDataType()) {
                vtkTemplateMacro(
                    write_values(array, rows, stride, place, static_cast<VTK_TT*>(array.to->GetVoidPointer(0))));
            }
        } else {
            write_slowly(array, rows, stride, place);
        }
    }
    write_nodes(place);
    write_cells();
}

// The sign of the exact value less a threshold, where rounding twice could make a difference.
Sign ProbeArrays::side(const Sampled& array, int component, const Row& row, const PlaceOfRow& place,
                       double threshold) const {
    if (!row.inside) return Sign::zero;  // a value at the nearest point, which is rounded itself
    const Field& field = fields_[array.field];
    const Mesh& mesh = index_.mesh;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::array<double, 3> point{};
    std::array<double, 12> vertices{};
    std::array<double, 4> values{};
    place(row.row, point.data());
    for (std::size_t k = 0; k <= d; ++k) {
        const auto node = static_cast<std::size_t>(mesh.cells[mesh.corners() * static_cast<std::size_t>(row.cell) + k]);
        std::copy_n(mesh.points.data() + d * node, d, vertices.data() + d * k);
        values[k] = field.data[static_cast<std::size_t>(field.components) * node + static_cast<std::size_t>(component)];
    }
    const Result<Sign> sign = compare_value(index_.simplex(), vertices.data(), point.data(), values.data(), threshold);
    return sign ? *sign : Sign::zero;
}

template <class T>
void ProbeArrays::write_values(const Sampled& array, const TableView& rows, std::size_t stride, const PlaceOfRow& place,
                               T* out) const {
    const int components = fields_[array.field].components;
    for (const Row& row : rows_) {
        const double* const values = rows.values.data() + row.row * stride + array.column;
        T* const to = out + row.point * components;
        for (int c = 0; c < components; ++c)
            to[c] = once_rounded<T>(values[c], [&](double t) { return side(array, c, row, place, t); });
    }
}

// Bits, and arrays that are laid out in another way.
void ProbeArrays::write_slowly(const Sampled& array, const TableView& rows, std::size_t stride,
                               const PlaceOfRow& place) const {
    const auto round = [&]<class T>(T, double value, int c, const Row& row) {
        return static_cast<double>(once_rounded<T>(value, [&](double t) { return side(array, c, row, place, t); }));
    };
    for (const Row& row : rows_) {
        for (int c = 0; c < fields_[array.field].components; ++c) {
            double value = rows.values[row.row * stride + array.column + static_cast<std::size_t>(c)];
            switch (array.to->GetDataType()) {
                vtkTemplateMacro(value = round(VTK_TT{}, value, c, row));
                default:
                    value = round(char{}, value, c, row);
            }
            array.to->SetComponent(row.point, c, value);
        }
    }
}

// What depends on the weights of the vertices alone.
void ProbeArrays::write_nodes(const PlaceOfRow& place) const {
    if (nearest_.empty() && mixed_.empty()) return;
    const std::size_t n = index_.mesh.corners();
    vtkNew<vtkIdList> nodes;
    nodes->SetNumberOfIds(static_cast<vtkIdType>(n));
    for (const Row& row : rows_) {
        std::array<double, 3> point{};
        place(row.row, point.data());
        std::array<double, 4> weights{};
        if (row.inside) {
            weights = weights_on_axes(index_, row.cell, point.data());
        } else {  // of the nearest point
            std::array<double, 3> x{};
            x[static_cast<std::size_t>(index_.axes[2])] = index_.plane;
            for (std::size_t a = 0; a + 1 < n; ++a) x[static_cast<std::size_t>(index_.axes[a])] = point[a];
            weights = closest(index_, x.data(), std::numeric_limits<double>::infinity()).weights;
        }
        for (std::size_t k = 0; k < n; ++k)
            nodes->SetId(static_cast<vtkIdType>(k), index_.mesh.cells[n * static_cast<std::size_t>(row.cell) + k]);
        const auto greatest = std::max_element(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(n));
        const vtkIdType node = nodes->GetId(greatest - weights.begin());
        for (const Copied& array : nearest_) array.to->SetTuple(row.point, node, array.from);
        for (const Copied& array : mixed_) array.to->InterpolateTuple(row.point, nodes, array.from, weights.data());
    }
}

void ProbeArrays::write_cells() const {
    for (const Copied& array : of_cells_) {
        if (!has_fast_tuples(array.from) || !has_fast_tuples(array.to)) {
            for (const Row& row : rows_) array.to->SetTuple(row.point, index_.id(row.cell), array.from);
            continue;
        }
        const auto bytes =
            static_cast<std::size_t>(array.from->GetDataTypeSize() * array.from->GetNumberOfComponents());
        const auto* const from = static_cast<const char*>(array.from->GetVoidPointer(0));
        auto* const to = static_cast<char*>(array.to->GetVoidPointer(0));
        for (const Row& row : rows_) {
            std::memcpy(to + bytes * static_cast<std::size_t>(row.point),
                        from + bytes * static_cast<std::size_t>(index_.id(row.cell)), bytes);
        }
    }
}

}  // namespace barycert::in_vtk
