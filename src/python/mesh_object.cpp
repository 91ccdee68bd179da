#include "mesh_object.hpp"

#include <algorithm>
#include <utility>

#include "errors.hpp"

namespace barycert::python {
namespace {

namespace py = pybind11;

auto place_of(std::vector<Field>& fields, const std::string& name) {
    return std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
}

}  // namespace

const Locator& Geometry::locator(const Progress& progress) {
    const std::lock_guard once(making_);
    if (!locator_) {
        BuildOptions options;
        options.progress = [&](const char* stage) { progress.tell(stage, 0, 0); };
        locator_ = take(Locator::build(mesh, options));
    }
    return *locator_;
}

MeshObject::MeshObject(Mesh mesh) : geometry_(std::make_shared<Geometry>()), fields_(std::make_shared<Mesh>()) {
    fields_->dimension = mesh.dimension;
    fields_->mid_nodes = mesh.mid_nodes;
    fields_->point_fields = std::exchange(mesh.point_fields, {});
    fields_->cell_fields = std::exchange(mesh.cell_fields, {});
    geometry_->mesh = std::move(mesh);
}

std::vector<Field>& MeshObject::fields_to_change(bool of_cells) {
    last_ = nullptr;
    // Samplers and arrays that look at the fields keep them as they are.
    if (fields_.use_count() > 1) fields_ = std::make_shared<Mesh>(*fields_);
    return of_cells ? fields_->cell_fields : fields_->point_fields;
}

void MeshObject::set_field(Field field, bool of_cells) {
    std::vector<Field>& fields = fields_to_change(of_cells);
    const auto place = place_of(fields, field.name);
    if (place == fields.end())
        fields.push_back(std::move(field));
    else
        *place = std::move(field);
}

void MeshObject::remove_field(const std::string& name, bool of_cells) {
    std::vector<Field>& fields = fields_to_change(of_cells);
    if (const auto place = place_of(fields, name); place != fields.end()) fields.erase(place);
}

Mesh MeshObject::whole() const {
    Mesh all = mesh();
    all.point_fields = fields_->point_fields;
    all.cell_fields = fields_->cell_fields;
    return all;
}

std::shared_ptr<const BoundSampler> MeshObject::sampler(const std::vector<std::string>& names,
                                                        const Progress& progress) {
    if (last_ && last_names_ == names) return last_;
    const std::shared_ptr<Geometry> geometry = geometry_;
    const std::shared_ptr<const Mesh> fields = fields_;
    const std::vector<FieldChoice> chosen = take(choose_fields(*fields, names));
    std::shared_ptr<const BoundSampler> made;
    {
        const py::gil_scoped_release unlocked;
        made = std::make_shared<const BoundSampler>(
            BoundSampler{geometry, fields, take(Sampler::build(geometry->locator(progress), chosen))});
    }
    if (fields == fields_) {
        last_names_ = names;
        last_ = made;
    }
    return made;
}

std::shared_ptr<const BoundSampler> MeshObject::sampler_of(Field field, bool of_cells, const Progress& progress) const {
    const std::shared_ptr<Geometry> geometry = geometry_;
    const auto fields = std::make_shared<Mesh>();
    fields->point_fields.push_back(std::move(field));
    const py::gil_scoped_release unlocked;
    return std::make_shared<const BoundSampler>(
        BoundSampler{geometry, fields,
                     take(Sampler::build(geometry->locator(progress), {{&fields->point_fields.front(), of_cells}}))});
}

std::shared_ptr<const BoundSampler> MeshObject::bare_sampler(const Progress& progress) const {
    const std::shared_ptr<Geometry> geometry = geometry_;
    const py::gil_scoped_release unlocked;
    return std::make_shared<const BoundSampler>(
        BoundSampler{geometry, nullptr, take(Sampler::build(geometry->locator(progress), {}))});
}

}  // namespace barycert::python
