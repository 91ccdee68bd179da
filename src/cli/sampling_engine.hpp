/// A mesh, what finds points in it, and what samples its fields.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "sampling.hpp"

namespace barycert::cli {

/// Holds the mesh, and therefore stays where it is.
class SamplingEngine {
public:
    /// Reads the mesh and the files of fields, and chooses fields.
    static Result<std::unique_ptr<SamplingEngine>> open(const SamplingArguments& arguments, Progress& progress);

    const Mesh& mesh() const { return mesh_; }
    const std::vector<FieldChoice>& fields() const { return fields_; }

    /// Prepares for points one by one, of which there are to be so many, or at least so many. Checks the mesh first if
    /// that is asked for or likely to pay. May be called again as more become known.
    Status prepare_for(std::uint64_t points, bool at_least, Progress& progress);

    /// Prepares where no owner is asked of a point alone: they are known, or the cells find their points.
    Status prepare_without_search(FoundBy method, const std::string& reason, Progress& progress);

    /// Precondition: prepared.
    const Locator& locator() const { return *locator_; }
    const Sampler& sampler() const { return *sampler_; }

    /// Tells of the mesh, the method and the times until now.
    void tell(SampleRun& run) const;

private:
    SamplingEngine() = default;
    Status build(const Certificate& certificate, Progress& progress);
    void check_mesh(Progress& progress);

    Mesh mesh_;
    std::vector<FieldChoice> fields_;
    Certify certify_ = Certify::automatic;
    int threads_ = 0;
    std::optional<Locator> locator_;
    std::optional<Sampler> sampler_;
    Certificate certificate_;
    FoundBy method_ = FoundBy::candidates;
    std::string reason_;
    double seconds_mesh_ = 0, seconds_certify_ = 0, seconds_build_ = 0;
};

}  // namespace barycert::cli
