#include "barycert/surface_locator.hpp"
#include "bindings.hpp"

namespace barycert::python {
namespace {

using SurfaceObject = Located<Surface, SurfaceLocator>;
using Shared = std::shared_ptr<SurfaceObject>;

/// points (n, 3); triangles (m, 3); facets (m), or none.
Shared made(const Given<double>& points, const Given<Mesh::Index>& triangles, const Given<Mesh::Index>& facets) {
    Surface surface;
    surface.points = points.copy();
    surface.cells = triangles.copy();
    surface.facets = facets.copy();
    return std::make_shared<SurfaceObject>(std::move(surface));
}

Shared read(const std::string& path) {
    const py::gil_scoped_release unlocked;
    return std::make_shared<SurfaceObject>(read_surface(path).value());
}

py::dict fields_of(const std::vector<Field>& fields) {
    py::dict all;
    for (const Field& f : fields)
        all[py::str(f.name)] =
            owned(std::vector<double>(f.data), f.components == 1 ? 0 : static_cast<std::size_t>(f.components));
    return all;
}

std::shared_ptr<BoundReport> check_of(const SurfaceObject& object, std::size_t examples, std::size_t contacts,
                                      bool verdict_only, double near, int threads, const Progress& progress) {
    const CheckOptions options{.threads = threads,
                               .examples = examples,
                               .contacts = contacts,
                               .near = near,
                               .verdict_only = verdict_only,
                               .progress = [&](const char* stage) { tell(progress, stage, 0, 0); }};
    const py::gil_scoped_release unlocked;
    return std::make_shared<BoundReport>(
        BoundReport{std::make_shared<Geometry>(), check_surface(object.data, options)});
}

/// A member of each item, that many numbers as it has: (items), or (items, numbers).
template <class Number, class Item, class Owner, class T>
py::array member_of(const std::vector<Item>& items, T Owner::*member) {
    constexpr std::size_t whole = sizeof(T), one = sizeof(Number);
    Shape shape{items.size()}, strides{sizeof(Item)};
    if (whole > one) {
        shape.push_back(whole / one);
        strides.push_back(one);
    }
    return {py::dtype::of<Number>(), shape, strides, items.empty() ? nullptr : &(items.front().*member)};
}

/// triangle, feature, winding: one a point.
py::tuple locate(SurfaceObject& object, const Given<double>& points, int threads) {
    const SurfaceLocator& locator = object.locator(Progress());
    std::vector<SurfaceLocation> found(points.rows());
    // The locator has a map of sides for more points than a fourth of the triangles: then no part has fewer.
    const std::size_t many = object.data.cell_count() / 4 + 1;
    const bool map = locator.turned() != Turned::open && found.size() >= many;
    const std::size_t least = map ? std::max(few, many) : few;
    const auto block = [&](std::size_t first, std::size_t n) {
        return locator.locate(points.part(first, n), std::span(found).subspan(first, n), threads);
    };
    in_blocks(Progress(), "points", found.size(), block, least, least);
    return py::make_tuple(member_of<Mesh::Index>(found, &SurfaceLocation::triangle),
                          member_of<std::uint8_t>(found, &SurfaceLocation::feature),
                          member_of<std::int32_t>(found, &SurfaceLocation::winding));
}

/// triangle, distance, point, nodes, weights: one a point; and the values of fields there.
py::tuple nearest(SurfaceObject& object, const Given<double>& points, double limit,
                  const std::vector<std::pair<Given<double>, bool>>& fields, int threads) {
    const SurfaceLocator& locator = object.locator(Progress());
    std::vector<SurfaceNearest> found(points.rows());
    const auto block = [&](std::size_t first, std::size_t n) {
        return locator.nearest(points.part(first, n), limit, std::span(found).subspan(first, n), threads);
    };
    // Parts are sorted: fewer points would lie farther from each other, and take longer.
    in_blocks(Progress(), "points", found.size(), block, std::size_t{1} << 16, std::size_t{1} << 14);
    py::list arrays;
    for (const std::pair<Given<double>, bool>& given : fields) {
        const std::size_t columns = given.first.columns();
        const Field field{"", static_cast<int>(columns), given.first.copy()};
        std::vector<double> out(found.size() * columns);
        in_blocks(Progress(), "values", found.size(), [&](std::size_t first, std::size_t n) {
            return locator.values(field, given.second, points.part(first, n), std::span(found).subspan(first, n),
                                  std::span(out).subspan(columns * first, columns * n), threads);
        });
        arrays.append(owned(std::move(out), columns));
    }
    for (SurfaceNearest& one : found) {
        if (one.cell >= 0) continue;
        one.distance = std::numeric_limits<double>::quiet_NaN();
        one.point.fill(one.distance);
    }
    return py::make_tuple(
        member_of<Mesh::Index>(found, &SurfaceNearest::cell), member_of<double>(found, &SurfaceNearest::distance),
        member_of<double>(found, &SurfaceNearest::point), member_of<Mesh::Index>(found, &SurfaceNearest::nodes),
        member_of<double>(found, &SurfaceNearest::weights), arrays);
}

py::list hits(SurfaceObject& object, const Given<double>& ends, bool ray) {
    const SurfaceLocator& locator = object.locator(Progress());
    const auto found = unlocked([&] { return locator.hits(ends.data(), ends.data() + 3, ray).value(); });
    return list_of(
        found, [](const SurfaceHit& h) { return py::make_tuple(h.triangle, name(h.feature), h.parameter, h.side); });
}

const char* turned(SurfaceObject& object) {
    const Turned turned = object.locator(Progress()).turned();
    return turned == Turned::alike     ? "alike"
           : turned == Turned::regions ? "regions"
           : turned == Turned::even    ? "even"
                                       : "open";
}

/// The lowest triangle of a shell that is open; -1: none.
Mesh::Index first_open(SurfaceObject& object) {
    return object.locator(Progress()).sides().open;
}

}  // namespace

void bind_surface(py::module_& module) {
    py::class_<SurfaceObject, Shared>(module, "Surface")
        .def(py::init(&made))
        .def_static("read", &read)
        .def_property_readonly("points", [](const Shared& s) { return view(s->data.points, s, 3); })
        .def_property_readonly("triangles", [](const Shared& s) { return view(s->data.cells, s, 3); })
        .def_property_readonly("facets", [](const Shared& s) { return view(s->data.facets, s); })
        .def_property_readonly("point_fields", [](const Shared& s) { return fields_of(s->data.point_fields); })
        .def_property_readonly("cell_fields", [](const Shared& s) { return fields_of(s->data.cell_fields); })
        .def_property_readonly(
            "notes", [](const Shared& s) { return list_of(s->data.notes, [](const Note& n) { return message(n); }); })
        .def_property_readonly("turned", &turned)
        .def_property_readonly("first_open", &first_open)
        .def("check", &check_of)
        .def("locate", &locate)
        .def("nearest", &nearest)
        .def("hits", &hits);
}

}  // namespace barycert::python
