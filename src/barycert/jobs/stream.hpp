/// Points through the sampler into rows, block by block: read, located and evaluated, written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/jobs/sampled_mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// Rows on their way, and what became of them.
struct Block {
    Table rows;
    std::vector<Mesh::Index> located;  ///< cells of the locator, where they are to be known again
    NodeWeights weights;               ///< where they are wanted
    std::uint64_t first = 0;           ///< points, or rows of a map, that came before
    std::uint64_t size = 0;            ///< points
    bool last = false;                 ///< as far as was known when it was read
    std::uint64_t nan_values = 0;
    std::optional<std::size_t> outside;  ///< the first row without a cell, where there may be none
};

/// Where rows come from.
class RowSource {
public:
    virtual ~RowSource() = default;

    /// Whether cells and features come with the points.
    virtual bool located() const = 0;
    virtual std::optional<std::uint64_t> count() const = 0;

    /// Fills rows and size of the block: at most `most`, 0 at the end.
    virtual Status read(std::size_t most, Block& block) = 0;

    /// From the beginning, for a step with another mesh.
    virtual Status begin_again(const SampledMesh& mesh) = 0;

    /// Counts a block that was written in the report.
    virtual void count(const Block& block, SampleReport& report) = 0;
};

/// Points that are to be located.
class PointRows : public RowSource {
public:
    explicit PointRows(std::unique_ptr<PointSource> points) : points_(std::move(points)) {}

    bool located() const override { return false; }
    std::optional<std::uint64_t> count() const override { return points_->count(); }
    Status read(std::size_t most, Block& block) override;
    void count(const Block& block, SampleReport& report) override;

protected:
    std::unique_ptr<PointSource> points_;
};

/// Where rows go.
class RowsOutput {
public:
    virtual ~RowsOutput() = default;

    /// Opens what takes rows of that format, into an output of that name; nullptr: nowhere.
    virtual Result<std::unique_ptr<TableSink>> open(const TableFormat& format, const std::string& path) = 0;
};

/// All rows of the source into the output, and into a map and a matrix of weights where these are named; of a job that
/// goes step by step, those of all steps, each into an output of its own. Rows come in the order of the points. Adds to
/// the report. Error besides those of its parts: the policy is `error`, and a point is outside; it names the point and
/// the file.
Status sample_rows(SampledMesh& mesh, RowSource& source, RowsOutput& output, const std::string& map = {});

/// The policy `error` is looked at where the point and its file are known: options without it.
SampleOptions without_refusal(SampleOptions options);

/// That `what` ("point 7"), at `where`, is outside, and none may be.
Error outside_error(const std::string& what, std::span<const double> where, const std::string& file);

/// How many values of rows inside are NaN.
std::uint64_t count_nan(const TableView& rows);

}  // namespace barycert::jobs
