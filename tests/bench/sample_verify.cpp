#include "sample_verify.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>

#include "barycert/grid.hpp"
#include "barycert/oracle.hpp"
#include "barycert/predicates.hpp"
#include "barycert/weights.hpp"

namespace barycert::bench {
namespace {

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

void require_same(const Table& a, const Table& b, const std::string& what) {
    require(a.cells == b.cells && a.features == b.features, "owners or features differ: " + what);
    require(std::equal(a.values.begin(), a.values.end(), b.values.begin(), b.values.end(), same_bits),
            "values differ: " + what);
}

Case case_of(const Subject& subject, std::size_t cell, const double* point) {
    Case c;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto node = static_cast<std::size_t>(subject.mesh.cells[4 * cell + i]);
        for (std::size_t k = 0; k < 3; ++k) c.vertices[3 * i + k] = subject.mesh.points[3 * node + k];
        c.values[i] = subject.linear.data[node];
    }
    for (std::size_t k = 0; k < 3; ++k) c.point[k] = point[k];
    return c;
}

/// The points whose cell is not -1, with these cells as a mesh of their own.
struct Queries {
    Queries(const Subject& subject, std::span<const std::array<Mesh::Index, 4>> cells) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (cells[i][0] < 0) continue;
            corners.insert(corners.end(), cells[i].begin(), cells[i].end());
            for (std::size_t k = 0; k < 3; ++k) points.push_back(subject.points[3 * i + k]);
            number.push_back(i);
        }
        each.resize(number.size());
        std::iota(each.begin(), each.end(), 0);
        all = {Simplex::tetrahedron, subject.mesh.points, corners, each, points};
    }
    std::vector<Mesh::Index> corners, each;
    std::vector<double> points;
    std::vector<std::size_t> number;  // of the point
    MeshQueries all;
};

void verify_owners(const Subject& subject, const Table& rows) {
    const auto cells = corners_of(subject, rows.cells);
    const Queries queries(subject, cells);
    std::vector<WeightSigns> signs(queries.number.size());
    demand_done(weight_signs(queries.all, signs));
    for (std::size_t i = 0; i < signs.size(); ++i) {
        require(signs[i].contains() && signs[i].feature(Simplex::tetrahedron) == rows.features[queries.number[i]],
                "owner or feature of point " + std::to_string(queries.number[i]));
    }
    const std::vector<double> values = exact_values(subject, cells);
    require(std::equal(values.begin(), values.end(), rows.values.begin(), rows.values.end(), same_bits),
            "values are not those of core");
}

/// So many points, evenly chosen, by asking every cell.
std::size_t verify_by_all_cells(const Subject& subject, const Table& rows) {
    const std::size_t cells = subject.mesh.cell_count();
    const std::size_t count =
        std::clamp<std::size_t>(20'000'000 / cells, 5, std::min<std::size_t>(1000, subject.point_count()));
    std::vector<Mesh::Index> all(cells);
    std::iota(all.begin(), all.end(), 0);
    std::vector<double> points(3 * cells);
    std::vector<WeightSigns> signs(cells);
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t i = n * (subject.point_count() / count);
        for (std::size_t k = 0; k < points.size(); ++k) points[k] = subject.points[3 * i + k % 3];
        demand_done(weight_signs(
            MeshQueries{Simplex::tetrahedron, subject.mesh.points, subject.mesh.cells, all, points}, signs));
        const auto first = std::find_if(signs.begin(), signs.end(), [](WeightSigns s) { return s.contains(); });
        const auto owner = first == signs.end() ? -1 : static_cast<Mesh::Index>(first - signs.begin());
        require(owner == rows.cells[i], "point " + std::to_string(i) + " has another owner");
    }
    return count;
}

std::size_t verify_by_oracle(const Subject& subject, const Table& rows) {
    const std::size_t step = std::max<std::size_t>(1, subject.point_count() / 100'000);
    std::size_t asked = 0;
    for (std::size_t i = 0; i < subject.point_count(); i += step) {
        if (rows.cells[i] < 0) continue;
        const OracleAnswer answer =
            ask_oracle(case_of(subject, static_cast<std::size_t>(rows.cells[i]), subject.points.data() + 3 * i));
        require(answer.feature == rows.features[i], "the oracle has another feature of point " + std::to_string(i));
        require(same_bits(answer.value, rows.values[i]), "the oracle has another value at point " + std::to_string(i));
        ++asked;
    }
    return asked;
}

/// How many values of plain rounding are not the correct ones.
std::size_t verify_plain(const Subject& subject, const Table& rows, const Table& plain) {
    require(plain.cells == rows.cells && plain.features == rows.features, "owners of plain rounding");
    std::size_t differing = 0;
    for (std::size_t i = 0; i < rows.values.size(); ++i) {
        if (same_bits(plain.values[i], rows.values[i])) continue;
        ++differing;
        const Case c = case_of(subject, static_cast<std::size_t>(rows.cells[i]), subject.points.data() + 3 * i);
        const double kappa = condition_number(Simplex::tetrahedron, c.vertices.data());
        require(std::abs(plain.values[i] - rows.values[i]) <= 200 * kappa * 0x1p-53 * subject.max_value,
                "plain value at point " + std::to_string(i));
    }
    return differing;
}

}  // namespace

void verify_points(const Subject& subject, const Ours& ours, Table& rows) {
    demand_done(ours.one.sample(subject.points, options(1), rows));
    const SampleCounts& counts = rows.counts;
    verify_owners(subject, rows);
    const std::size_t by_all = verify_by_all_cells(subject, rows), by_oracle = verify_by_oracle(subject, rows);
    Table other;
    demand_done(ours.one.sample(subject.points, options(2), other));
    require_same(rows, other, "two threads");
    demand_done(ours.uncertified.sample(subject.points, options(2), other));
    require_same(rows, other, "without a certificate");
    std::vector<Mesh::Index> cells(subject.point_count());
    std::vector<Feature> features(subject.point_count());
    demand_done(ours.walk.locate(subject.points, cells, features, nullptr, 1));
    other.cells = std::move(cells);
    other.features = std::move(features);
    demand_done(ours.one.evaluate(subject.points, options(1), other));
    require_same(rows, other, "locate and evaluate");
    demand_done(ours.three.sample(subject.points, options(1), other));
    for (std::size_t i = 0; i < rows.values.size(); ++i)
        require(same_bits(rows.values[i], other.values[3 * i]), "values differ: three components");
    demand_done(ours.one.sample(subject.points, options(1, Rounding::plain), other));
    const std::size_t differing = verify_plain(subject, rows, other);
    const auto at = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::printf("%s: %zu cells, %zu nodes; %zu points, %llu inside, %llu of them on faces, edges or vertices\n",
                subject.name.c_str(), subject.mesh.cell_count(), subject.mesh.point_count(), subject.point_count(),
                at(counts.locations.inside()), at(counts.locations.inside() - counts.locations.interior));
    std::printf("  verified: owners by exact signs, %zu by asking all cells; %zu values by the oracle\n", by_all,
                by_oracle);
    std::printf("  correct values: %llu by double-double, %llu by integers; plain rounding has %zu of them wrong\n",
                at(counts.values.filter + counts.values.double_double), at(counts.values.exact), differing);
}

void verify_grid(const Subject& subject, const Ours& ours, std::vector<double>& values) {
    const Grid& grid = subject.grid;
    values.clear();
    Table rows;
    std::vector<double> points;
    const auto nx = static_cast<std::uint64_t>(grid.counts[0]), ny = static_cast<std::uint64_t>(grid.counts[1]);
    const auto look = [&](const TableView& block) -> Status {
        points.clear();
        for (std::uint64_t i = block.first_row; i < block.first_row + block.cells.size(); ++i) {
            const std::array<std::uint64_t, 3> at{i % nx, i / nx % ny, i / nx / ny};
            for (std::size_t k = 0; k < 3; ++k) points.push_back(grid.coordinate(k, static_cast<std::int64_t>(at[k])));
        }
        demand_done(ours.one.sample(points, options(2), rows));
        require(
            std::equal(rows.cells.begin(), rows.cells.end(), block.cells.begin(), block.cells.end()) &&
                std::equal(rows.features.begin(), rows.features.end(), block.features.begin(), block.features.end()) &&
                std::equal(rows.values.begin(), rows.values.end(), block.values.begin(), block.values.end(), same_bits),
            "resample differs from sample");
        values.insert(values.end(), block.values.begin(), block.values.end());
        return Done{};
    };
    const SampleCounts counts = demand_value(resample(ours.one, grid, options(1), look));
    require(values.size() == grid.point_count(), "points of the grid are missing");
    std::printf("  grid of %zu points, %llu inside: resample gives what sample does, bit for bit\n", values.size(),
                static_cast<unsigned long long>(counts.locations.inside()));
}

void verify_rows(const Subject& subject, const Table& rows) {
    verify_owners(subject, rows);
    verify_by_oracle(subject, rows);
}

Comparison compare(const Subject& subject, std::span<const double> right, std::span<const double> theirs) {
    require(right.size() == theirs.size(), "a peer has another number of answers");
    Comparison out;
    for (std::size_t i = 0; i < right.size(); ++i) {
        const bool inside = !std::isnan(right[i]), found = !std::isnan(theirs[i]);
        out.missed += inside && !found ? 1 : 0;
        out.found_outside += !inside && found ? 1 : 0;
        if (!inside || !found) continue;
        const double apart = std::abs(right[i] - theirs[i]) / subject.max_value;
        out.off += apart > 1e-12 ? 1 : 0;
        out.worst = std::max(out.worst, apart);
    }
    return out;
}

std::uint64_t not_held(const Subject& subject, std::span<const std::array<Mesh::Index, 4>> cells) {
    const Queries queries(subject, cells);
    std::vector<WeightSigns> signs(queries.number.size());
    demand_done(weight_signs(queries.all, signs));
    return static_cast<std::uint64_t>(
        std::count_if(signs.begin(), signs.end(), [](WeightSigns s) { return !s.contains(); }));
}

std::vector<double> exact_values(const Subject& subject, std::span<const std::array<Mesh::Index, 4>> cells) {
    const Queries queries(subject, cells);
    std::vector<double> some(queries.number.size());
    demand_done(interpolate(queries.all, NodalValues<double>{subject.linear.data}, some));
    std::vector<double> values(cells.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < some.size(); ++i) values[queries.number[i]] = some[i];
    return values;
}

std::vector<std::array<Mesh::Index, 4>> corners_of(const Subject& subject, std::span<const Mesh::Index> cells) {
    std::vector<std::array<Mesh::Index, 4>> out(cells.size(), {-1, -1, -1, -1});
    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (std::size_t k = 0; k < 4 && cells[i] >= 0; ++k)
            out[i][k] = subject.mesh.cells[4 * static_cast<std::size_t>(cells[i]) + k];
    }
    return out;
}

}  // namespace barycert::bench
