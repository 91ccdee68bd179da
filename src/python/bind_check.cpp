#include "barycert/defect.hpp"
#include "barycert/report.hpp"
#include "bindings.hpp"

namespace barycert::python {
namespace {

using namespace pybind11::literals;

using Shared = std::shared_ptr<BoundReport>;

Shared check_of(const MeshObject& mesh, bool delaunay, std::size_t examples, std::size_t contacts, bool verdict_only,
                int threads, const Progress& progress) {
    const CheckOptions options{.threads = threads,
                               .delaunay = delaunay,
                               .examples = examples,
                               .contacts = contacts,
                               .verdict_only = verdict_only,
                               .progress = [&](const char* stage) { tell(progress, stage, 0, 0); }};
    const std::shared_ptr<const Mesh> fields = mesh.fields();
    const py::gil_scoped_release unlocked;
    auto report = std::make_shared<BoundReport>(BoundReport{mesh.geometry(), check_mesh(mesh.mesh(), options)});
    report->report.not_finite = not_finite_values(*fields);
    return report;
}

/// A tuple of the numbers that are used.
py::tuple used(const auto& all) {
    py::list list;
    for (const Mesh::Index i : all) {
        if (i >= 0) list.append(i);
    }
    return py::tuple(list);
}

py::list defects_of(const CheckReport& report) {
    const auto place_of = [](const DefectPlace& p) {
        return py::make_tuple(used(p.cells), used(p.nodes), p.detail, used(p.other_nodes), p.distance);
    };
    return list_of(report.defects, [&](const Defect& d) {
        const DefectText& text = defect_text(d.kind);
        return py::dict("kind"_a = text.name, "count"_a = d.count, "at_least"_a = d.at_least, "breaks"_a = d.breaks(),
                        "severity"_a = name(severity(d)), "condition"_a = text.condition, "text"_a = text.text,
                        "remedy"_a = d.remedy(), "places"_a = list_of(d.places, place_of));
    });
}

py::tuple fix_of(const MeshObject& mesh, double merge_within, bool nodes, bool cells, bool orientation, int threads) {
    const FixOptions options{
        .nodes = nodes, .merge_within = merge_within, .cells = cells, .orientation = orientation, .threads = threads};
    FixReport done;
    MeshObject fixed = unlocked([&] { return MeshObject(fix_mesh(mesh.whole(), options, done).value()); });
    py::list merged, dropped, fields;
    for (const MergedNode& m : done.merged) merged.append(py::make_tuple(m.node, m.into, m.moved));
    for (const DroppedCell& c : done.dropped) dropped.append(py::make_tuple(c.cell, defect_text(c.why).name));
    for (const MergedField& f : done.fields) fields.append(py::make_tuple(f.name, f.differ, f.max_difference));
    return py::make_tuple(std::move(fixed), py::dict("merged"_a = merged, "dropped"_a = dropped,
                                                     "turned"_a = done.turned, "fields"_a = fields));
}

py::list contacts_of(const CheckReport& report, std::size_t dimension) {
    return list_of(report.contacts, [&](const CellContact& c) {
        return py::dict("cells"_a = tuple_of(c.cells, 2), "overlap"_a = c.overlap, "dimension"_a = c.dimension,
                        "point"_a = tuple_of(c.common.point, dimension), "exact"_a = c.common.exact,
                        "fraction"_a = tuple_of(c.common.fraction, dimension));
    });
}

py::dict measures_of(const Shared& bound) {
    const CellMeasures& m = bound->report.measures;
    py::dict measures;
    if (!m.orientation.empty()) measures["orientation"] = view(m.orientation, bound);
    for (const auto& [name, numbers] : cell_measures)
        if (!(m.*numbers).empty()) measures[py::str(name)] = view(m.*numbers, bound);
    return measures;
}

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
    for (const WrongRow& row : v.examples) examples.append(row_of(row, bound.geometry->data.corners() - 1, names));
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
        const ClaimedRows rows{.points = points.part(first, n),
                               .cells = part(cells, first, n),
                               .inside = part(inside, first, n),
                               .values = part(values, first, n),
                               .first_row = first};
        verdicts.add(verifier.verify(rows).value(), examples);
    });
    unlocked([&] { return verifier.measure(verdicts); }).value();
    return dict_of(verdicts, bound, verifier.ranges());
}

}  // namespace

void bind_check(py::module_& module) {
    using Bound = const BoundReport&;
    using Text = const std::string&;
    py::class_<BoundReport, Shared>(module, "CheckReport")
        .def_property_readonly("verdict", [](Bound r) { return name(r.report.certificate.verdict()); })
        .def_property_readonly("certified", [](Bound r) { return r.report.certified(); })
        .def_property_readonly("defects", [](Bound r) { return defects_of(r.report); })
        .def_property_readonly("contacts",
                               [](Bound r) { return contacts_of(r.report, r.geometry->data.corners() - 1); })
        .def_property_readonly("measures", &measures_of)
        .def("text", [](Bound r, Text name) { return check_text(r.report, r.geometry->data, name, {}); })
        .def("json", [](Bound r, Text name) { return check_json(r.report, name, measure_environment()); })
        .def("html", [](Bound r, Text name) { return check_html(r.report, r.geometry->data, name); });
    module.def("check", &check_of);
    module.def("fix", &fix_of);
    module.def("verify", &verify);
}

}  // namespace barycert::python
