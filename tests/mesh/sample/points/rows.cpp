#include "tests/mesh/sample/points/rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "barycert/oracle.hpp"
#include "core/base/text.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/points.hpp"

namespace barycert::testing {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

bool same(double x, double y) {
    return (std::isnan(x) && std::isnan(y)) || std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
}

bool same(const Table& a, const Table& b) {
    const auto all = [](const std::vector<double>& x, const std::vector<double>& y) {
        bool equal = x.size() == y.size();
        for (std::size_t i = 0; equal && i < x.size(); ++i) equal = same(x[i], y[i]);
        return equal;
    };
    return a.cells == b.cells && a.features == b.features && all(a.values, b.values) && all(a.distances, b.distances);
}

double true_value(const Mesh& mesh, const Field& field, std::size_t c, Mesh::Index cell, const double* point) {
    Case question = case_of(mesh, cell, point);
    const auto components = static_cast<std::size_t>(field.components), k = static_cast<std::size_t>(cell);
    const auto at = [&](Mesh::Index node) { return field.data[components * static_cast<std::size_t>(node) + c]; };
    const bool quadratic = !mesh.mid_nodes.empty();
    const unsigned support = ask_oracle(question).support;
    bool finite = true;
    // Nodes that have no part are left out: l = 0, and on quadratic cells l = 1/2 and edges of corners with l = 0.
    const auto take = [&](double f, bool has_part) {
        finite &= std::isfinite(f) || (!has_part && support != 0);
        return std::isfinite(f) ? f : 0;
    };
    for (std::size_t i = 0; i < mesh.corners(); ++i) {
        bool has_part = (support >> i & 1) != 0;
        if (quadratic) {
            Case half = question;
            half.values.fill(-0.5);
            half.values[i] = 0.5;
            has_part &= ask_oracle(half).value != 0;
        }
        question.values[i] = take(at(mesh.cells[mesh.corners() * k + i]), has_part);
    }
    const std::size_t edges = mesh.dimension == 2 ? 3 : 6;
    static constexpr std::size_t ends[6][2]{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    std::vector<double> mids;
    for (std::size_t e = 0; quadratic && e < edges; ++e) {
        const bool has_part = (support >> ends[e][0] & 1) != 0 && (support >> ends[e][1] & 1) != 0;
        mids.push_back(take(at(mesh.mid_nodes[edges * k + e]), has_part));
    }
    if (!finite) return nan;
    return mids.empty() ? ask_oracle(question).value : oracle_quadratic_value(question, mids);
}

std::vector<Field> random_fields(std::size_t entities, const std::vector<int>& components, bool awkward,
                                 base::Random& random) {
    std::vector<Field> fields;
    static constexpr std::array<double, 9> some{
        0.0, -0.0, 5e-324, -1e-310, 1.7976931348623157e308, -1.7976931348623157e308, 1.0, -1.0, 1e-300};
    for (const int n : components) {
        Field field{"f" + std::to_string(fields.size()), n, {}};
        for (std::size_t i = 0; i < entities * static_cast<std::size_t>(n); ++i) {
            const bool special = awkward && random.coin();
            field.data.push_back(special ? some[random.below(some.size())] : random.uniform(-3, 5));
        }
        fields.push_back(field);
    }
    return fields;
}

std::vector<FieldChoice> all_fields(const Mesh& mesh) {
    std::vector<FieldChoice> all;
    for (const Field& f : mesh.point_fields) all.push_back({&f, false});
    for (const Field& f : mesh.cell_fields) all.push_back({&f, true});
    return all;
}

std::size_t expect_true_values(const Mesh& mesh, const std::vector<double>& points, const Table& samples,
                               const std::string& what) {
    std::size_t columns = 0, inside = 0, told = 0;
    for (const FieldChoice& f : all_fields(mesh)) columns += static_cast<std::size_t>(f.field->components);
    const std::size_t rows = points.size() / static_cast<std::size_t>(mesh.dimension);
    if (samples.values.size() != columns * rows || samples.cells.size() != rows) {
        ADD_FAILURE() << what << ": " << samples.values.size() << " values in " << samples.cells.size() << " rows";
        return 0;
    }
    for (std::size_t i = 0; i < rows; ++i) {
        const Mesh::Index cell = samples.cells[i];
        if (cell < 0) continue;
        ++inside;
        const double* found = samples.values.data() + columns * i;
        const double* const point = points.data() + i * static_cast<std::size_t>(mesh.dimension);
        for (const FieldChoice& f : all_fields(mesh)) {
            const auto n = static_cast<std::size_t>(f.field->components);
            for (std::size_t c = 0; c < n; ++c, ++found) {
                const double right = f.of_cells ? f.field->data[n * static_cast<std::size_t>(cell) + c]
                                                : true_value(mesh, *f.field, c, cell, point);
                if (same(*found, right) || told++ >= 3) continue;
                ADD_FAILURE() << what << ": " << f.field->name << "." << c << " at " << text_of(point, mesh.dimension)
                              << " in cell " << cell << " is " << base::hexadecimal(right) << ", found "
                              << base::hexadecimal(*found);
            }
        }
    }
    return inside;
}

void expect_true_owners(const Mesh& mesh, const std::vector<double>& points, const Table& samples,
                        const std::string& what) {
    const PointJudge judge(mesh);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    ASSERT_EQ(samples.features.size(), points.size() / d) << what;
    for (std::size_t i = 0; i < samples.cells.size(); ++i) {
        const std::vector<Held> all = judge.holders(&points[d * i]);
        const Held owner = all.empty() ? Held{} : all.front();
        ASSERT_EQ(samples.cells[i], owner.cell) << what << text_of(&points[d * i], mesh.dimension);
        ASSERT_EQ(samples.features[i], owner.feature) << what << text_of(&points[d * i], mesh.dimension);
    }
}

}  // namespace barycert::testing
