/// A mesh, what finds points in it, and what samples its fields.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/pipeline/run.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"

namespace barycert::pipeline {

/// Writes what it does into the summary of the run. Holds the mesh, and therefore stays where it is.
class Engine {
public:
    /// Reads the mesh and the files of fields, and chooses fields. The run must stay.
    static Result<std::unique_ptr<Engine>> open(Run& run);

    const Mesh& mesh() const { return mesh_; }

    /// Prepares for points one by one. A second call does nothing.
    Status prepare();

    /// Prepares where no owner is asked of a point alone: they are known, or the cells find their points.
    Status prepare_without_search(FoundBy method, const std::string& reason);

    /// Precondition: prepared.
    const Locator& locator() const { return *locator_; }
    const Sampler& sampler() const { return *sampler_; }

    /// What the rows of this job have.
    TableFormat format() const;

private:
    explicit Engine(Run& run) : run_(run) {}
    Status build(bool prove);

    Run& run_;
    Mesh mesh_;
    std::vector<FieldChoice> fields_;
    std::optional<Locator> locator_;
    std::optional<Sampler> sampler_;
};

}  // namespace barycert::pipeline
