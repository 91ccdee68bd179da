#include "tests/mesh/locate/ways.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <limits>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/fix.hpp"
#include "barycert/locator.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "tests/mesh/locate/points.hpp"

namespace barycert::testing {
namespace {

std::string text_of(Held h) {
    return std::string(name(h.feature)) + " of cell " + std::to_string(h.cell);
}

/// One mesh with points whose answers are known.
class Asking {
public:
    Asking(const Mesh& mesh, const std::vector<double>& points, const std::string& what, const Ways& ways)
        : mesh_(mesh), points_(points), d_(static_cast<std::size_t>(mesh.dimension)), what_(what), ways_(ways) {
        const PointJudge judge(mesh);
        for (std::size_t i = 0; i < count(); ++i) truth_.push_back(judge.holders(at(i)));
    }

    void batch(const Locator& locator, int threads, const std::string& how) {
        std::vector<Mesh::Index> cells(count(), -7);
        std::vector<Feature> features(count(), Feature::degenerate);
        LocationCounts counts;
        const Status status = locator.locate(points_, cells, features, &counts, threads);
        ASSERT_TRUE(status) << what_ << how << status.error().message();
        for (std::size_t i = 0; i < count(); ++i) expect(i, {cells[i], features[i]}, how);
        expect_counts(counts, how);
    }

    void all(const Locator& locator, int threads, const std::string& how) {
        const auto found = locator.locate_all(points_, threads);
        ASSERT_TRUE(found) << what_ << how;
        ASSERT_EQ(found->point_begin.size(), count() + 1) << what_ << how;
        ASSERT_EQ(found->point_begin.back(), found->cells.size()) << what_ << how;
        ASSERT_EQ(found->cells.size(), found->features.size()) << what_ << how;
        ASSERT_EQ(found->points.size(), d_ * found->cells.size()) << what_ << how;
        for (std::size_t i = 0; i < count(); ++i) {
            std::vector<Held> held;
            for (std::size_t j = found->point_begin[i]; j < found->point_begin[i + 1]; ++j) {
                held.push_back({found->cells[j], found->features[j]});
                ASSERT_TRUE(std::equal(at(i), at(i) + d_, &found->points[d_ * j])) << what_ << how;
            }
            if (held == std::vector<Held>{{-1, Feature::outside}}) held.clear();
            if (held == truth_[i] || told_++ >= ways_.max) continue;
            std::string text;
            for (const Held h : truth_[i]) text += " " + text_of(h);
            text += "; found";
            for (const Held h : held) text += " " + text_of(h);
            ADD_FAILURE() << what_ << how << ": point " << testing::text_of(at(i), mesh_.dimension) << " is in" << text;
        }
        expect_counts(found->counts.locations, how);
    }

    void single(const Locator& locator, base::Random& random, const std::string& how) {
        for (std::size_t i = 0; i < count(); ++i) {
            const auto cells = static_cast<Mesh::Index>(mesh_.cell_count());
            const Mesh::Index any = cells == 0 ? 0 : static_cast<Mesh::Index>(random.below(mesh_.cell_count()));
            for (const Mesh::Index hint : {-1, owner(i).cell, any, cells, std::numeric_limits<Mesh::Index>::max(),
                                           std::numeric_limits<Mesh::Index>::min()}) {
                const auto found = locator.locate(at(i), hint);
                ASSERT_TRUE(found) << what_ << how;
                expect(i, {found->cell, found->feature}, how + ", hint " + std::to_string(hint));
            }
        }
    }

private:
    std::size_t count() const { return points_.size() / d_; }
    const double* at(std::size_t i) const { return points_.data() + d_ * i; }
    Held owner(std::size_t i) const { return truth_[i].empty() ? Held{} : truth_[i].front(); }

    void expect(std::size_t i, Held found, const std::string& how) {
        if (found == owner(i) || told_++ >= ways_.max) return;
        ADD_FAILURE() << what_ << how << ": point " << testing::text_of(at(i), mesh_.dimension) << " is "
                      << text_of(owner(i)) << ", found " << text_of(found);
    }

    void expect_counts(const LocationCounts& counts, const std::string& how) {
        LocationCounts right;
        for (std::size_t i = 0; i < count(); ++i) right.add(owner(i).feature);
        EXPECT_EQ(counts.interior, right.interior) << what_ << how;
        EXPECT_EQ(counts.face, right.face) << what_ << how;
        EXPECT_EQ(counts.edge, right.edge) << what_ << how;
        EXPECT_EQ(counts.vertex, right.vertex) << what_ << how;
        EXPECT_EQ(counts.outside, right.outside) << what_ << how;
        EXPECT_EQ(counts.points(), count()) << what_ << how;
        EXPECT_EQ(counts.ways.points(), count()) << what_ << how;
        EXPECT_LE(counts.ways.no_cell_near, right.outside) << what_ << how;
        EXPECT_LE(counts.ways.contested, right.inside()) << what_ << how;
    }

    const Mesh& mesh_;
    const std::vector<double>& points_;
    std::size_t d_;
    std::string what_;
    Ways ways_;
    std::vector<std::vector<Held>> truth_;
    std::size_t told_ = 0;
};

}  // namespace

bool expect_right(const Mesh& mesh, const std::vector<double>& points, base::Random& random, const std::string& what,
                  const Ways& ways) {
    CheckOptions options;
    options.threads = 1;
    options.contacts = 0;
    const bool certified = check_mesh(mesh, options).certified();
    const std::vector<std::string> targets = ways.targets ? simd_targets() : std::vector<std::string>{simd_target()};
    const std::vector<int> threads = ways.threads ? std::vector<int>{1, 2, 8} : std::vector<int>{1};
    // As many as are asked for, also on a machine with fewer.
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 8);
    Asking asking(mesh, points, what, ways);
    for (const bool with : {true, false}) {
        const auto locator = with ? Locator::build(mesh) : Locator::build(mesh, {.prove = Prove::never});
        if (!locator) {
            ADD_FAILURE() << what << ": " << locator.error().message();
            return certified;
        }
        EXPECT_EQ(locator->method(), with ? Method::walk : Method::candidates) << what;
        EXPECT_EQ(locator->certified(), with && certified) << what;
        if (certified) {
            EXPECT_EQ(locator->contested_cells(), 0U) << what;
        }
        for (const std::string& target : targets) {
            EXPECT_TRUE(use_simd_target(target));
            for (const int n : threads) {
                const std::string how =
                    ": " + std::string(name(locator->method())) + ", " + target + ", threads " + std::to_string(n);
                asking.batch(*locator, n, how);
                asking.all(*locator, n, how + ", all");
            }
            if (ways.single) asking.single(*locator, random, ": single, " + target);
            if (::testing::Test::HasFatalFailure()) break;
        }
        EXPECT_TRUE(use_simd_target(""));
    }
    return certified;
}

}  // namespace barycert::testing
