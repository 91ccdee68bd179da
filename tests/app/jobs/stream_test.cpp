// Blocks on their way from a source to a sink: in their order, on any number of threads; and errors of any stage.
#include "app/jobs/stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <limits>

#include "core/base/random.hpp"
#include "tests/bench/generated_mesh.hpp"
#include "tests/io/tetgen/mesh_files.hpp"

namespace barycert::testing {
namespace {

/// Random points in a cube a little larger than the unit cube; an Error in place of one of them.
class RandomSource final : public PointSource {
public:
    RandomSource(std::uint64_t count, std::uint64_t fault, bool known)
        : count_(count), fault_(fault), known_(known), random_(11) {}

    int dimension() const override { return 3; }
    std::optional<std::uint64_t> count() const override {
        return known_ ? std::optional<std::uint64_t>(count_) : std::nullopt;
    }
    Result<std::size_t> read(std::size_t max, std::vector<double>& out) override {
        std::size_t taken = 0;
        for (; taken < max && next_ < count_; ++taken, ++next_) {
            if (next_ == fault_) return Error{.code = "file.changed", .what = "fault of the source"};
            for (int k = 0; k < 3; ++k) out.push_back(random_.uniform(low, 1));
        }
        return taken;
    }

    double low = 0;

private:
    std::uint64_t count_, fault_, next_ = 0;
    bool known_;
    base::Random random_;
};

struct Written {
    std::vector<double> points, values;
    std::vector<Mesh::Index> cells;
    bool committed = false;

    friend bool operator==(const Written&, const Written&) = default;
};

class Sink final : public TableSink {
public:
    Sink(Written& to, std::size_t fault) : to_(to), fault_(fault) {}
    Status write(const TableView& rows) override {
        if (to_.cells.size() + rows.row_count() > fault_)
            return Error{.code = "file.changed", .what = "fault of the sink"};
        to_.points.insert(to_.points.end(), rows.points.begin(), rows.points.end());
        to_.cells.insert(to_.cells.end(), rows.cells.begin(), rows.cells.end());
        to_.values.insert(to_.values.end(), rows.values.begin(), rows.values.end());
        return Done{};
    }
    Status commit() override {
        to_.committed = true;
        return Done{};
    }

private:
    Written& to_;
    std::size_t fault_;
};

constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();

struct How {
    std::uint64_t count = 100'000, source_fault = never, sink_fault = never;
    double low = 0;
    bool known = true;
    OutsidePolicy outside = {.kind = Outside::error};
    int threads = 0;
};

class Stream : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TemporaryFolder>();
        Mesh mesh = bench::jittered_cube(8, 3);
        mesh.point_fields = {{"t", 1, {}}};
        for (std::size_t i = 0; i < mesh.point_count(); ++i) mesh.point_fields[0].data.push_back(mesh.points[3 * i]);
        ASSERT_TRUE(write_tetgen(mesh, *folder_ / "cube"));
    }
    static void TearDownTestSuite() { folder_.reset(); }

    /// Returns what was written, and the error if there is one.
    static std::pair<Written, std::string> go(const How& how, SampleReport* summary = nullptr,
                                              const std::function<void(const JobProgress&)>& progress = {}) {
        SamplingJob job;
        job.mesh = *folder_ / "cube";
        job.options = {Rounding::correct, how.outside, how.threads};
        job.progress = progress;
        jobs::SampledMesh mesh(job, {}, "sample");
        mesh.report.points = "the points";
        mesh.open();
        auto source = std::make_unique<RandomSource>(how.count, how.source_fault, how.known);
        source->low = how.low;
        std::unique_ptr<PointSource> points = std::move(source);
        Written written;
        const auto open = [&](const std::string&) { return std::make_unique<Sink>(written, how.sink_fault); };
        std::string error;
        try {
            jobs::sample_rows(mesh, jobs::rows_of_points(points), open);
        } catch (const Exception& e) {
            error = e.error().message();
        }
        if (summary != nullptr) *summary = mesh.report;
        return {std::move(written), error};
    }

    static std::unique_ptr<TemporaryFolder> folder_;
};

std::unique_ptr<TemporaryFolder> Stream::folder_;

TEST_F(Stream, LawRowsDoNotDependOnThreadsOrBlocks) {
    const How how{.count = 700'000, .low = -0.1, .outside = {}, .threads = 1};
    SampleReport first;
    const auto [rows, error] = go(how, &first);
    EXPECT_EQ(error, "");
    ASSERT_EQ(rows.cells.size(), how.count);
    EXPECT_TRUE(rows.committed);
    std::vector<double> points;
    RandomSource source(how.count, never, true);
    source.low = how.low;
    ASSERT_TRUE(source.read(how.count, points));
    EXPECT_EQ(rows.points, points) << "in their order";
    for (const int threads : {2, 3, 8}) {
        for (const bool known : {true, false}) {
            How other = how;
            other.threads = threads;
            other.known = known;
            SampleReport summary;
            const auto [more, fault] = go(other, &summary);
            EXPECT_EQ(fault, "");
            // NaN is not equal to itself.
            EXPECT_EQ(more.cells, rows.cells);
            EXPECT_EQ(more.points, rows.points);
            ASSERT_EQ(more.values.size(), rows.values.size());
            for (std::size_t i = 0; i < rows.values.size(); ++i)
                ASSERT_TRUE(more.values[i] == rows.values[i] ||
                            (rows.cells[i] < 0 && more.values[i] != more.values[i]));
            EXPECT_EQ(summary.rows, first.rows);
            EXPECT_EQ(summary.counts.locations.outside, first.counts.locations.outside);
            EXPECT_EQ(summary.counts.locations.interior, first.counts.locations.interior);
        }
    }
}

TEST_F(Stream, FewPointsAndNone) {
    for (const std::uint64_t count : {0, 1, 2, 16383, 16384, 16385, 32768}) {
        for (const bool known : {true, false}) {
            const auto [rows, error] = go({.count = count, .known = known});
            EXPECT_EQ(error, "");
            EXPECT_EQ(rows.cells.size(), count);
            EXPECT_TRUE(rows.committed);
        }
    }
}

TEST_F(Stream, TheFirstErrorInTheOrderOfPointsIsTold) {
    for (const int threads : {1, 2, 8}) {
        for (const std::uint64_t at : {0, 1, 20'000, 50'000, 99'999}) {
            const auto [rows, error] = go({.source_fault = at, .threads = threads});
            EXPECT_EQ(error, "fault of the source") << at;
            EXPECT_FALSE(rows.committed);
            EXPECT_LE(rows.cells.size(), at);
            const auto [other, sink] = go({.sink_fault = at, .threads = threads});
            EXPECT_EQ(sink, "fault of the sink") << at;
            EXPECT_FALSE(other.committed);
        }
        // By the time the sink fails, the block that fails next has been read.
        for (int i = 0; i < 20; ++i) {
            const How both{.count = 30'000, .source_fault = 9'000, .sink_fault = 7'000, .threads = threads};
            EXPECT_EQ(go(both).second, "fault of the sink");
        }
        // Points outside come long before the source fails, and the sink long after.
        const auto [rows, error] =
            go({.source_fault = 90'000, .sink_fault = 80'000, .low = -0.001, .threads = threads});
        std::vector<double> points;
        RandomSource source(100'000, never, true);
        source.low = -0.001;
        ASSERT_TRUE(source.read(100'000, points));
        const auto outside =
            std::find_if(points.begin(), points.end(), [](double x) { return x < 0; }) - points.begin();
        ASSERT_LT(outside, 30'000);
        EXPECT_EQ(error.find("the points: point " + std::to_string(outside / 3) + ", counted from 0, is outside"), 0U)
            << error;
        EXPECT_FALSE(rows.committed);
    }
}

TEST_F(Stream, ProgressCountsUpwardsAndMayDoWhatItWantsToItsThread) {
    std::uint64_t last = 0, calls = 0;
    const auto count = [&](const JobProgress& p) {
        if (p.stage != "points") return;
        EXPECT_GT(p.done, last);
        last = p.done;
        ++calls;
        std::fesetround(FE_UPWARD);
    };
    const How how{.count = 400'000, .threads = 2};
    const auto [rows, error] = go(how, nullptr, count);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(error, "");
    EXPECT_GT(calls, 0U);
    EXPECT_LT(last, how.count) << "the end is told by the job itself";
    EXPECT_EQ(rows, go({.count = how.count, .threads = 1}).first);
}

/// As pipes and parsers do.
TEST_F(Stream, WhatAStageThrowsReachesTheCaller) {
    const auto thrower = [](const JobProgress& p) {
        if (p.stage == "points") throw std::runtime_error("enough");
    };
    EXPECT_THROW(go({.count = 400'000, .threads = 2}, nullptr, thrower), std::runtime_error);
}

}  // namespace
}  // namespace barycert::testing
