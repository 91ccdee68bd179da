/// A subject of bench_sample: a certified mesh with fields, points, a grid, and what barycert makes of it.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/grid.hpp"
#include "barycert/locator.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/sampler.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "require.hpp"

namespace barycert::bench {

/// The value of a Result or Status, which must be there.
template <class T>
T demand_value(Result<T> result) {
    if (!result) require(false, result.error().message());
    return std::move(*result);
}
inline void demand_done(const Status& status) {
    if (!status) require(false, status.error().message());
}

struct Subject {
    /// Checks the mesh, which must be certified, on two threads. Its size is added to the name.
    Subject(const std::string& name, Mesh mesh, std::size_t point_count, std::int64_t grid_side);
    Subject(const Subject&) = delete;
    Subject& operator=(const Subject&) = delete;

    std::size_t point_count() const { return points.size() / 3; }

    std::string name;
    Mesh mesh;
    Field linear;                ///< 1.5 x + 2.5 y - z at the nodes, rounded
    Field three;                 ///< the same, and two that are not linear
    double max_value = 0;        ///< of `linear`
    std::vector<double> points;  ///< uniform in the box of the cells
    Grid grid;                   ///< over that box
};

/// The locators and samplers of a subject. They are on its mesh: the subject must outlive them.
struct Ours {
    explicit Ours(const Subject& subject);

    Locator walk, candidates;  ///< with the certificate, and without
    Sampler one, three, uncertified;
};

/// Bytes that malloc has handed out and not got back: the difference tells what something holds.
std::size_t handed_out();

/// A count in three digits, with k or M.
std::string in_thousands(std::size_t count);

SampleOptions options(int threads, Rounding rounding = Rounding::correct);

}  // namespace barycert::bench
