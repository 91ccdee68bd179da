/// Points through the sampler into rows, block by block: read, located and evaluated, written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/sampled_mesh.hpp"
#include "barycert/job.hpp"
#include "barycert/locator.hpp"
#include "barycert/map.hpp"
#include "barycert/mesh.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "barycert/verify.hpp"
#include "io/npz/weights_file.hpp"

namespace barycert::jobs {

/// Rows on their way, and what became of them.
struct BlockOfRows {
    Table rows;
    std::optional<LocationCounts> locations;  ///< of rows whose owners were known: what the source counts
    std::vector<Mesh::Index> located;         ///< cells of the locator, where they are to be known again
    NodeWeights weights;                      ///< where they are wanted
    std::uint64_t first = 0;                  ///< points, or rows of a map, that came before
    std::uint64_t size = 0;                   ///< points
    bool last = false;                        ///< as far as was known when it was read
    std::uint64_t nan_values = 0;
    std::optional<std::size_t> outside;  ///< the first row without a cell, where there may be none
    Verdicts found;                      ///< of results that are verified
};

struct RowSource {
    bool located = false;  ///< whether cells and features come with the points
    bool counted = false;  ///< whether the report has these rows already
    std::optional<std::uint64_t> count = {};
    /// Fills rows and size of the block: at most `most`, 0 at the end.
    std::function<void(std::size_t most, BlockOfRows& block)> read = {};
    /// From the beginning, for a step with another mesh.
    std::function<void(const SampledMesh& mesh)> begin_again = {};
};

/// Points that are to be located, to be read once. They must stay.
RowSource rows_of_points(std::unique_ptr<PointSource>& points);

/// The rows of a source, which must stay, in blocks: few enough that all `threads` (0: as many as the machine has) have
/// some, and enough points that sorting them brings near ones together. `seconds` gets those of reading and work.
class BlockPipeline {
public:
    using Stage = std::function<void(BlockOfRows& block)>;

    BlockPipeline(const RowSource& source, int threads, JobSeconds& seconds)
        : source_(source), threads_(threads), seconds_(seconds) {}

    /// Reads the first block, with which run() will begin.
    BlockOfRows& first() {
        read(first_.emplace());
        return *first_;
    }

    bool have_more() const { return more_; }

    /// Prepares the locator for all points; from now on blocks are as large as its mesh asks for.
    void locate_in(const Locator& locator);

    /// Three stages at once: blocks are read one after the other, worked on side by side, and written in their order.
    /// At most one block a thread, and two more, are in memory. An exception of the first block ends it all.
    void run(const Stage& work, const Stage& write);

private:
    void read(BlockOfRows& block);

    const RowSource& source_;
    int threads_;
    JobSeconds& seconds_;
    std::size_t cells_ = 0;  ///< among which points are looked for
    std::uint64_t taken_ = 0;
    bool more_ = true;
    std::optional<BlockOfRows> first_;
};

using Sink = std::unique_ptr<TableSink>;

/// Where rows go: to users, into a map and a matrix of weights; each may be absent.
struct RowOutputs {
    Sink sink = {};
    std::optional<MapWriter> map = {};
    std::unique_ptr<io::WeightsFile> weights = {};

    /// `cells`: those of the map. `numbers`: those of the matrix.
    void write(const TableView& rows, std::span<const Mesh::Index> cells, const NodeWeights& of_nodes,
               std::span<const Mesh::Index> numbers);
    void commit();
};

/// Opens what takes rows of the mesh's format, into an output of that name; nullptr: they go nowhere.
using OpenRows = std::function<Sink(const std::string& path)>;

/// All rows of the source into the output, and into a map and a matrix of weights where these are named; of a job that
/// goes step by step, those of all steps, each into an output of its own. Rows come in the order of the points. Adds to
/// the report. Refused, besides what its parts refuse: a point outside where the policy is `error`; the error names it.
void sample_rows(SampledMesh& mesh, const RowSource& source, const OpenRows& open, const std::string& map = {});

// Rows as users know them.

using OpenFormat = std::function<Sink(const TableFormat& format)>;

/// A column of the points that the rows cannot have, too.
[[noreturn]] void refuse_kept(const std::string& name);

/// Opens an output by open(format of its rows) and returns what takes rows whose cells are those of the mesh, and gives
/// it what users are to see: cells by their numbers in the file, labels that the job asked for, and `carried` columns
/// of the points. The report gets the names of these. The mesh must stay. A carried column that has the name of another
/// one is refused; with `all`, one that rows have anyway, as those of another run, is left out, and noted.
Sink open_user_rows(SampledMesh& mesh, const std::vector<ColumnFormat>& carried, bool all, const OpenFormat& open);

template <class Write, class Commit>
Sink sink_of(Write write, Commit commit) {
    struct Functions final : TableSink {
        Functions(Write w, Commit c) : write_rows(std::move(w)), commit_all(std::move(c)) {}
        Status write(const TableView& rows) override { return write_rows(rows); }
        Status commit() override { return commit_all(); }
        Write write_rows;
        Commit commit_all;
    };
    return std::make_unique<Functions>(std::move(write), std::move(commit));
}

/// Takes rows, lets change(rows) put others in their place, which it keeps, and gives these to the sink.
template <class Change>
Sink changed(std::shared_ptr<TableSink> sink, Change change) {
    const auto write = [sink, change](TableView rows) mutable {
        change(rows);
        return sink->write(rows);
    };
    return sink_of(write, [sink = std::move(sink)] { return sink->commit(); });
}

/// An output of rows; a terminal shows names and texts without control characters.
Sink open_rows(const std::string& path, const TableFormat& format);

/// The policy `error` is looked at where the point and its file are known: options without it.
inline SampleOptions without_refusal(SampleOptions options) {
    if (options.outside.kind == Outside::error) options.outside = {};
    return options;
}

/// Returns the error that `what` ("point 7"), at `where`, is outside, and none may be.
Error outside_error(const std::string& what, std::span<const double> where, const std::string& file);

std::uint64_t count_nan(const TableView& rows);

}  // namespace barycert::jobs
