#include "mesh_object.hpp"

#include <utility>

namespace barycert::python {
namespace {

/// `choices` may lie in `fields`.
std::shared_ptr<BoundSampler> made(std::shared_ptr<Geometry> geometry, std::shared_ptr<const Mesh> fields,
                                   const std::vector<FieldChoice>& choices, const Progress& progress) {
    const py::gil_scoped_release unlocked;
    Sampler sampler = take(Sampler::build(geometry->locator(progress), choices));
    return std::make_shared<BoundSampler>(BoundSampler{std::move(geometry), std::move(fields), std::move(sampler)});
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

std::vector<Field>& MeshObject::fields(bool of_cells) {
    last_ = nullptr;
    // Samplers and arrays that look at the fields keep them as they are.
    if (fields_.use_count() > 1) fields_ = std::make_shared<Mesh>(*fields_);
    return of_cells ? fields_->cell_fields : fields_->point_fields;
}

Mesh MeshObject::whole() const {
    Mesh all = mesh();
    all.point_fields = fields_->point_fields;
    all.cell_fields = fields_->cell_fields;
    return all;
}

std::shared_ptr<BoundSampler> MeshObject::sampler(const std::vector<std::string>& names, const Progress& progress) {
    if (last_ && last_names_ == names) return last_;
    const std::shared_ptr<const Mesh> fields = fields_;
    std::shared_ptr<BoundSampler> sampler = made(geometry_, fields, take(choose_fields(*fields, names)), progress);
    if (fields == fields_) {
        last_names_ = names;
        last_ = sampler;
    }
    return sampler;
}

std::shared_ptr<BoundSampler> MeshObject::sampler_of(std::optional<Field> field, const Progress& progress) const {
    const auto fields = std::make_shared<Mesh>();
    if (field) fields->point_fields.push_back(std::move(*field));
    std::vector<FieldChoice> choices;
    for (const Field& one : fields->point_fields) choices.push_back({.field = &one});
    return made(geometry_, fields, choices, progress);
}

}  // namespace barycert::python
