/// A mesh as Python holds it: its geometry, shared and never changed; its locator, made when it is first needed; and
/// its fields, of which every sampler keeps those that it was made with.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "bindings.hpp"

namespace barycert::python {

struct Geometry {
    Mesh mesh;  ///< without fields

    /// Made once, by the thread that asks first; the others wait. To be called without the lock.
    const Locator& locator(const Progress& progress);

private:
    std::mutex making_;
    std::optional<Locator> locator_;
};

/// A sampler with all that it refers to.
struct BoundSampler {
    std::shared_ptr<Geometry> geometry;
    std::shared_ptr<const Mesh> fields;
    Sampler sampler;
};

class MeshObject {
public:
    explicit MeshObject(Mesh mesh);

    const std::shared_ptr<Geometry>& geometry() const { return geometry_; }
    const Mesh& mesh() const { return geometry_->mesh; }
    std::size_t dimension() const { return static_cast<std::size_t>(mesh().dimension); }
    Simplex simplex() const { return mesh().dimension == 2 ? Simplex::triangle : Simplex::tetrahedron; }
    const Locator& locator(const Progress& progress) const {
        const py::gil_scoped_release unlocked;
        return geometry_->locator(progress);
    }

    /// A mesh that has the fields alone, and what names of quantities need to know.
    std::shared_ptr<const Mesh> fields() const { return fields_; }
    /// To be changed.
    std::vector<Field>& fields(bool of_cells);

    /// The mesh with its fields: a copy.
    Mesh whole() const;

    /// Of the fields with these names, or all; the last one is kept.
    std::shared_ptr<BoundSampler> sampler(const std::vector<std::string>& names, const Progress& progress);
    /// Of a field of nodes that the mesh does not have; or of none.
    std::shared_ptr<BoundSampler> sampler_of(std::optional<Field> field, const Progress& progress) const;

private:
    std::shared_ptr<Geometry> geometry_;
    std::shared_ptr<Mesh> fields_;
    std::vector<std::string> last_names_;
    std::shared_ptr<BoundSampler> last_;
};

}  // namespace barycert::python
