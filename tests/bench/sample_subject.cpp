#include "sample_subject.hpp"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "core/base/random.hpp"
#include "sample_table.hpp"

namespace barycert::bench {

std::size_t handed_out() {
    const auto info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

std::string in_thousands(std::size_t count) {
    const double n = static_cast<double>(count);
    return n < 1e6 ? with_unit(n / 1e3, "k") : with_unit(n / 1e6, "M");
}

SampleOptions options(int threads, Rounding rounding) {
    SampleOptions out;
    out.threads = threads;
    out.rounding = rounding;
    return out;
}

Subject::Subject(const std::string& name_, Mesh mesh_, std::size_t point_count, std::int64_t grid_side)
    : name(name_ + " " + in_thousands(mesh_.cell_count())), mesh(std::move(mesh_)) {
    CheckOptions how;
    how.threads = 2;
    const CheckReport report = check_mesh(mesh, how);
    require(report.certified(), "the mesh " + name + " is not certified");

    linear.name = "linear";
    three.name = "three";
    three.components = 3;
    for (std::size_t i = 0; i < mesh.point_count(); ++i) {
        const double x = mesh.points[3 * i], y = mesh.points[3 * i + 1], z = mesh.points[3 * i + 2];
        linear.data.push_back(x * 1.5 + y * 2.5 - z);
        three.data.insert(three.data.end(), {linear.data.back(), x * y + z * z, std::sin(5 * x) + std::cos(3 * y) * z});
        max_value = std::max(max_value, std::abs(linear.data.back()));
    }
    const Bounds3 box = bounds_of_cells(mesh);
    base::Random random(20);
    points.resize(3 * point_count);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = random.uniform(box.low[i % 3], box.high[i % 3]);
    grid = demand_value(grid_over(3, {grid_side, grid_side, grid_side}, box.low, box.high));
}

Ours::Ours(const Subject& subject)
    : walk(demand_value(Locator::build(subject.mesh))),
      candidates(demand_value(Locator::build(subject.mesh, {.prove = Prove::never}))),
      one(demand_value(Sampler::build(walk, {{&subject.linear}}))),
      three(demand_value(Sampler::build(walk, {{&subject.three}}))),
      uncertified(demand_value(Sampler::build(candidates, {{&subject.linear}}))) {
    require(walk.method() == Method::walk, "no walk on " + subject.name);
}

}  // namespace barycert::bench
