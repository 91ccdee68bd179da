#include "bindings.hpp"

namespace barycert::python {

template <>
inline constexpr Words<Curved> words<Curved>{"curved=",
                                             {{{"isoparametric", Curved::isoparametric},
                                               {"straight", Curved::straight},
                                               {"refuse", Curved::refuse},
                                               {"exact", Curved::exact}}}};
template <>
inline constexpr Words<CellInterpolation> words<CellInterpolation> = named("interpolation=", CellInterpolation::linear,
                                                                           CellInterpolation::multilinear);
template <>
inline constexpr Words<VtkData> words<VtkData> = named("encoding of VTK's files", VtkData::raw, VtkData::zlib,
                                                       VtkData::lz4, VtkData::lzma, VtkData::ascii);

namespace {

using namespace pybind11::literals;

/// `choices` may lie in `fields`.
std::shared_ptr<BoundSampler> made(std::shared_ptr<Geometry> geometry, std::shared_ptr<const Mesh> fields,
                                   const std::vector<FieldChoice>& choices, const Progress& progress) {
    const Locator& locator = geometry->locator(progress);
    const py::gil_scoped_release unlocked;
    Sampler sampler = Sampler::build(locator, choices).value();
    return std::make_shared<BoundSampler>(BoundSampler{std::move(geometry), std::move(fields), std::move(sampler)});
}

/// points (n, 2 or 3), finite; cells (m, 3 or 4) and mid_nodes (m, 3 or 6) with indices of nodes; cell_numbers (m).
/// Empty: none.
MeshObject make_mesh(const Given<double>& points, const Given<Mesh::Index>& cells, const Given<Mesh::Index>& mid_nodes,
                     const Given<Mesh::Index>& cell_numbers) {
    Mesh mesh;
    mesh.dimension = static_cast<int>(points.columns());
    mesh.points = points.copy();
    mesh.cells = cells.copy();
    mesh.mid_nodes = mid_nodes.copy();
    if (!mesh.mid_nodes.empty()) mesh.mid_edge_order = MidEdgeOrder::vtk;
    mesh.cell_numbers = cell_numbers.copy();
    return MeshObject(std::move(mesh));
}

/// The numbers of each cell or node, if the mesh has some; else None.
template <class T>
py::object if_any(const MeshObject& mesh, const std::vector<T>& numbers, std::size_t columns = 0) {
    if (numbers.empty()) return py::none();
    return view(numbers, mesh.geometry(), columns);
}

py::object field_named(const MeshObject& mesh, const std::string& name, bool of_cells) {
    const std::shared_ptr<const Mesh> fields = mesh.fields();
    for (const Field& field : of_cells ? fields->cell_fields : fields->point_fields) {
        if (field.name == name) return view(field.data, fields, static_cast<std::size_t>(field.components));
    }
    return py::none();
}

py::list field_names(const MeshObject& mesh, bool of_cells) {
    const std::shared_ptr<const Mesh> fields = mesh.fields();
    return list_of(of_cells ? fields->cell_fields : fields->point_fields, [](const Field& f) { return f.name; });
}

Field field_of(std::string name, const Given<double>& values) {
    return {std::move(name), static_cast<int>(values.columns()), values.copy()};
}

/// No values: takes the field out.
void set_field(MeshObject& mesh, const std::string& name, const std::optional<Given<double>>& values, bool of_cells) {
    std::vector<Field>& fields = mesh.fields(of_cells);
    const auto named = [&](const Field& f) { return f.name == name; };
    if (!values) {
        std::erase_if(fields, named);
        return;
    }
    const auto place = std::ranges::find_if(fields, named);
    (place == fields.end() ? fields.emplace_back() : *place) = field_of(name, *values);
}

/// values (nodes, components): (cells, components * dimension).
py::array gradients_of(const MeshObject& object, const Given<double>& values, const Progress& progress) {
    const Mesh& mesh = object.mesh();
    const std::size_t n = mesh.corners(), row = values.columns() * (n - 1);
    std::vector<double> all(row * mesh.cell_count());
    const NodalValues<double> nodal{values.all(), static_cast<int>(values.columns())};
    in_blocks(progress, "gradients", mesh.cell_count(), [&](std::size_t first, std::size_t count) {
        return gradients(object.simplex(), mesh.points, std::span(mesh.cells).subspan(n * first, n * count), nodal,
                         std::span(all).subspan(row * first, row * count));
    });
    return owned(std::move(all), row);
}

py::list notes_of(const MeshObject& mesh) {
    return list_of(mesh.mesh().notes, [](const Note& note) { return std::pair(message(note), note.important); });
}

py::dict curved_of(const MeshObject& object) {
    const CurvedCells c = curved_cells(object.mesh(), nullptr, object.geometry()->options.curved == Curved::exact);
    py::dict all("cells"_a = c.cells, "max_deviation"_a = c.max_deviation, "rounded_cells"_a = c.rounded_cells,
                 "max_rounded"_a = c.max_rounded);
    if (c.by_corners != 0) all["by_corners"] = c.by_corners;
    return all;
}

/// How points are located in cells that are no straight simplices: before anything is. Returns what to warn of: empty
/// if no cell is curved, or all are taken as they are.
std::string set_cells(const MeshObject& object, const std::string& file, Curved curved,
                      CellInterpolation interpolation) {
    object.geometry()->options.curved = curved;
    object.geometry()->options.interpolation = interpolation;
    const CurvedCells found = measure_curved(object.mesh(), file, curved).value();
    return found.cells == 0 || curved != Curved::straight ? std::string() : message(found);
}

/// In the order of pickles. A new member does not compile until it is one of them.
auto arrays_of(auto& shapes) {
    auto& [types, ends, nodes, face_ends, ring_ends, rings, parts, inside] = shapes;
    return std::tie(types, ends, nodes, face_ends, ring_ends, rings, parts, inside);
}

/// State to pickle besides points, cells and fields: how cells are taken, and the shapes that they are parts of.
py::tuple taken(const MeshObject& object) {
    const BuildOptions& how = object.geometry()->options;
    const auto with_arrays = [&]<class... T>(const std::vector<T>&... of) {
        const bool multilinear = how.interpolation == CellInterpolation::multilinear;
        return py::make_tuple(static_cast<int>(how.curved), multilinear, owned(std::vector<T>(of))...);
    };
    return std::apply(with_arrays, arrays_of(object.mesh().shapes));
}

void take(const MeshObject& object, const py::tuple& taken) {
    object.geometry()->options.curved = static_cast<Curved>(taken[0].cast<int>());
    if (taken[1].cast<bool>()) object.geometry()->options.interpolation = CellInterpolation::multilinear;
    std::size_t next = 2;
    const auto get = [&]<class T>(std::vector<T>& to) {
        const auto from = taken[next++].cast<py::array_t<T>>();
        to.assign(from.data(), from.data() + from.size());
    };
    std::apply([&](auto&... arrays) { (get(arrays), ...); }, arrays_of(object.geometry()->data.shapes));
}

MeshObject read(const std::string& path, std::optional<std::size_t> number, bool last, std::optional<double> time) {
    const py::gil_scoped_release unlocked;
    return MeshObject(read_mesh(path, {.step = {.number = number, .time = time, .last = last}}).value());
}

void write(const MeshObject& object, const std::string& path, const std::string& comment, VtkData data) {
    const py::gil_scoped_release unlocked;
    write_mesh(object.whole(), path, {.comment = comment, .data = data}).value();
}

}  // namespace

MeshObject::MeshObject(Mesh mesh) : geometry_(std::make_shared<Geometry>()), fields_(std::make_shared<Mesh>()) {
    fields_->dimension = mesh.dimension;
    fields_->mid_nodes = mesh.mid_nodes;
    fields_->point_fields = std::exchange(mesh.point_fields, {});
    fields_->cell_fields = std::exchange(mesh.cell_fields, {});
    geometry_->data = std::move(mesh);
}

std::vector<Field>& MeshObject::fields(bool of_cells) {
    last_ = nullptr;
    // Samplers and arrays that look at the fields keep them as they are.
    if (fields_.use_count() > 1) fields_ = std::make_shared<Mesh>(*fields_);
    return of_cells ? fields_->cell_fields : fields_->point_fields;
}

std::shared_ptr<BoundSampler> MeshObject::sampler(const std::vector<std::string>& names, const Progress& progress) {
    if (last_ && last_names_ == names) return last_;
    const std::shared_ptr<const Mesh> fields = fields_;
    std::shared_ptr<BoundSampler> sampler = made(geometry_, fields, choose_fields(*fields, names).value(), progress);
    if (fields == fields_) {
        last_names_ = names;
        last_ = sampler;
    }
    return sampler;
}

std::shared_ptr<BoundSampler> MeshObject::sampler_of(const std::optional<Given<double>>& values,
                                                     const Progress& progress) const {
    const auto fields = std::make_shared<Mesh>();
    std::vector<FieldChoice> choices;
    if (values) choices.push_back({.field = &fields->point_fields.emplace_back(field_of("value", *values))});
    return made(geometry_, fields, choices, progress);
}

void bind_mesh(py::module_& module) {
    using Object = const MeshObject&;
    py::class_<MeshObject>(module, "Mesh")
        .def(py::init(&make_mesh))
        .def_property_readonly("dimension", [](Object m) { return m.mesh().dimension; })
        .def_property_readonly("points", [](Object m) { return view(m.mesh().points, m.geometry(), m.dimension()); })
        .def_property_readonly("cells", [](Object m) { return view(m.mesh().cells, m.geometry(), m.mesh().corners()); })
        .def_property_readonly("mid_nodes",
                               [](Object m) { return if_any(m, m.mesh().mid_nodes, 3 * m.dimension() - 3); })
        .def_property_readonly("cell_numbers", [](Object m) { return if_any(m, m.mesh().cell_numbers); })
        .def_property_readonly("point_markers", [](Object m) { return if_any(m, m.mesh().point_markers); })
        .def_property_readonly("notes", &notes_of)
        .def("set_cells", &set_cells)
        .def("taken", &taken)
        .def("take", &take)
        .def("curved", &curved_of)
        .def("field_names", &field_names)
        .def("field", &field_named)
        .def("set_field", &set_field)
        .def("sampler", &MeshObject::sampler)
        .def("sampler_of", &MeshObject::sampler_of)
        .def("gradients", &gradients_of)
        .def("write", &write);
    module.def("read", &read);
}

}  // namespace barycert::python
