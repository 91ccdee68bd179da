#include <limits>

#include "barycert/check.hpp"
#include "barycert/surface_locator.hpp"
#include "bindings.hpp"

namespace barycert::python {
namespace {

/// A surface with its locator, which is made once.
class SurfaceObject {
public:
    explicit SurfaceObject(Surface surface) : surface_(std::move(surface)) {}

    const Surface& surface() const { return surface_; }
    /// To be called without the lock.
    const SurfaceLocator& locator() {
        const std::lock_guard lock(making_);
        if (!locator_) locator_ = SurfaceLocator::build(surface_).value();
        return *locator_;
    }

private:
    Surface surface_;
    std::mutex making_;
    std::optional<SurfaceLocator> locator_;
};
using Shared = std::shared_ptr<SurfaceObject>;

Shared made(const Given<double>& points, const Given<Mesh::Index>& triangles) {
    Surface surface;
    surface.points = points.copy();
    surface.cells = triangles.copy();
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
        BoundReport{std::make_shared<Geometry>(), check_surface(object.surface(), options)});
}

/// A member of each item, that many numbers as it has: (items), or (items, numbers).
template <class Number, class Item, class Owner, class T>
py::array member_of(const std::vector<Item>& items, T Owner::*member) {
    Shape shape{items.size()}, strides{sizeof(Item)};
    if (sizeof(T) > sizeof(Number)) {
        shape.push_back(sizeof(T) / sizeof(Number));
        strides.push_back(sizeof(Number));
    }
    return {py::dtype::of<Number>(), shape, strides, items.empty() ? nullptr : &(items.front().*member)};
}

/// triangle, feature, winding: one a point.
py::tuple locate(SurfaceObject& object, const Given<double>& points, int threads) {
    std::vector<SurfaceLocation> found(points.rows());
    check(unlocked([&] { return object.locator().locate(points.all(), found, threads); }));
    return py::make_tuple(member_of<Mesh::Index>(found, &SurfaceLocation::triangle),
                          member_of<std::uint8_t>(found, &SurfaceLocation::feature),
                          member_of<std::int32_t>(found, &SurfaceLocation::winding));
}

/// triangle, distance, point, nodes, weights: one a point; and the values of fields there.
py::tuple nearest(SurfaceObject& object, const Given<double>& points, double limit,
                  const std::vector<std::pair<Given<double>, bool>>& fields, int threads) {
    std::vector<SurfaceNearest> found(points.rows());
    check(unlocked([&] { return object.locator().nearest(points.all(), limit, found, threads); }));
    py::list arrays;
    for (const std::pair<Given<double>, bool>& given : fields) {
        const std::size_t columns = given.first.columns();
        const Field field{"", static_cast<int>(columns), given.first.copy()};
        std::vector<double> out(found.size() * columns);
        check(
            unlocked([&] { return object.locator().values(field, given.second, points.all(), found, out, threads); }));
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
    const auto found = unlocked([&] { return object.locator().hits(ends.data(), ends.data() + 3, ray).value(); });
    return list_of(
        found, [](const SurfaceHit& h) { return py::make_tuple(h.triangle, name(h.feature), h.parameter, h.side); });
}

const char* turned(SurfaceObject& object) {
    const py::gil_scoped_release unlocked;
    const Turned turned = object.locator().turned();
    return turned == Turned::alike ? "alike" : turned == Turned::even ? "even" : "open";
}

}  // namespace

void bind_surface(py::module_& module) {
    py::class_<SurfaceObject, Shared>(module, "Surface")
        .def(py::init(&made))
        .def_static("read", &read)
        .def_property_readonly("points", [](const Shared& s) { return view(s->surface().points, s, 3); })
        .def_property_readonly("triangles", [](const Shared& s) { return view(s->surface().cells, s, 3); })
        .def_property_readonly("point_fields", [](const Shared& s) { return fields_of(s->surface().point_fields); })
        .def_property_readonly("cell_fields", [](const Shared& s) { return fields_of(s->surface().cell_fields); })
        .def_property_readonly(
            "notes",
            [](const Shared& s) { return list_of(s->surface().notes, [](const Note& n) { return message(n); }); })
        .def_property_readonly("turned", &turned)
        .def("check", &check_of)
        .def("locate", &locate)
        .def("nearest", &nearest)
        .def("hits", &hits);
}

}  // namespace barycert::python
