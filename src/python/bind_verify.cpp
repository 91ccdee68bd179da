#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "barycert/verify.hpp"
#include "mesh_object.hpp"

namespace barycert::python {
namespace {

using namespace pybind11::literals;

template <class T>
std::span<const T> part(const std::optional<Given<T>>& array, std::size_t first, std::size_t n) {
    return array ? array->part(first, n) : std::span<const T>();
}

py::dict row_of(const WrongRow& row, std::size_t dimension, const std::vector<std::string>& columns) {
    const bool value = !columns.empty();
    const bool compared = value && (row.verdict == RowVerdict::wrong_value || row.verdict == RowVerdict::wrong_cell);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return py::dict("verdict"_a = name(row.verdict), "row"_a = row.row, "point"_a = tuple_of(row.point, dimension),
                    "claimed_cell"_a = row.claimed_cell, "cell"_a = row.exact.cell,
                    "feature"_a = static_cast<int>(row.exact.feature), "cells"_a = row.cells,
                    "column"_a = value ? columns[row.column] : std::string(), "claimed"_a = value ? row.claimed : none,
                    "value"_a = value ? row.value : none, "ulps"_a = compared ? row.ulps : none,
                    "relative"_a = compared ? row.relative : none, "distance"_a = row.distance);
}

py::dict dict_of(const Verdicts& v, const BoundSampler& bound, const std::vector<double>& ranges) {
    const std::vector<std::string>& names = bound.sampler.columns();
    py::list columns, examples;
    for (std::size_t c = 0; c < v.columns.size(); ++c) {
        const ValueErrors& e = v.columns[c];
        columns.append(py::dict("name"_a = names[c], "range"_a = ranges[c], "values"_a = e.values,
                                "identical"_a = e.identical, "over"_a = e.over, "missing"_a = e.missing,
                                "spurious"_a = e.spurious, "max_ulps"_a = e.max_ulps,
                                "max_relative"_a = e.max_relative));
    }
    for (const WrongRow& row : v.examples) examples.append(row_of(row, bound.geometry->mesh.corners() - 1, names));
    return py::dict("rows"_a = v.rows, "right"_a = v.right, "missed"_a = v.missed, "invented"_a = v.invented,
                    "wrong_cell"_a = v.wrong_cell, "wrong_value"_a = v.wrong_value, "inside"_a = v.inside,
                    "outside"_a = v.outside, "on_boundary"_a = v.on_boundary,
                    "invented_distance"_a = v.invented_distance, "columns"_a = columns, "examples"_a = examples);
}

/// points (n, dimension); cells (n), inside (n), values (n, columns), or None.
py::dict verify(const BoundSampler& bound, const Given<double>& points, const std::optional<Given<std::int64_t>>& cells,
                const std::optional<Given<std::uint8_t>>& inside, const std::optional<Given<double>>& values,
                double tolerance, bool exact, std::optional<double> outside_value, std::size_t examples, int threads,
                const Progress& progress, NonfinitePoints nonfinite) {
    const Verifier verifier(bound.sampler, {.tolerance = tolerance,
                                            .exact = exact,
                                            .outside_value = outside_value,
                                            .examples = examples,
                                            .threads = threads,
                                            .nonfinite_points = nonfinite});
    Verdicts verdicts;
    verdicts.columns.resize(bound.sampler.columns().size());
    in_blocks(progress, "rows", points.rows(), [&](std::size_t first, std::size_t n) {
        verdicts.add(take(verifier.verify({.points = points.part(first, n),
                                           .cells = part(cells, first, n),
                                           .inside = part(inside, first, n),
                                           .values = part(values, first, n),
                                           .first_row = first})),
                     examples);
    });
    {
        const py::gil_scoped_release unlocked;
        check(verifier.measure(verdicts));
    }
    return dict_of(verdicts, bound, verifier.ranges());
}

}  // namespace

void bind_verify(py::module_& module) {
    module.def("verify", &verify);
}

}  // namespace barycert::python
