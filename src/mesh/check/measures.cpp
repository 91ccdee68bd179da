#include "barycert/measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/not_finite.hpp"
#include "core/base/finite.hpp"

namespace barycert {

Distribution distribution(const std::vector<double>& values) {
    const ExactEnvironment environment;
    Distribution d;
    std::vector<double> known;
    known.reserve(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double x = values[i];
        const auto cell = static_cast<std::int64_t>(i);
        if (std::isnan(x)) continue;
        if (known.empty() || x < d.min) std::tie(d.min, d.min_cell) = std::pair(x, cell);
        if (known.empty() || x > d.max) std::tie(d.max, d.max_cell) = std::pair(x, cell);
        known.push_back(x);
    }
    if (known.empty()) return d;
    const auto middle = known.begin() + static_cast<std::ptrdiff_t>((known.size() - 1) / 2);
    std::ranges::nth_element(known, middle);
    d.median = *middle;
    return d;
}

std::vector<Field> measure_fields(const CellMeasures& measures) {
    std::vector<Field> all{{"orientation", 1, {measures.orientation.begin(), measures.orientation.end()}}};
    for (const auto& [name, values] : cell_measures) all.push_back({std::string(name), 1, measures.*values});
    if (!measures.jacobian.empty())
        all.push_back({"jacobian", 1, {measures.jacobian.begin(), measures.jacobian.end()}});
    all.push_back({"problems", 1, {measures.defects.begin(), measures.defects.end()}});
    return all;
}

void count_not_finite(const Field& field, bool of_cells, std::vector<NotFinite>& to) {
    if (base::all_finite(field.data)) return;
    const auto is_known = [&](const NotFinite& n) { return n.field == field.name && n.of_cells == of_cells; };
    if (std::ranges::any_of(to, is_known)) return;
    const auto count = std::ranges::count_if(field.data, [](double x) { return !std::isfinite(x); });
    to.push_back({field.name, of_cells, static_cast<std::uint64_t>(count), field.data.size()});
}

std::vector<NotFinite> not_finite_values(const Mesh& mesh) {
    std::vector<NotFinite> all;
    for (const Field& field : mesh.point_fields) count_not_finite(field, false, all);
    for (const Field& field : mesh.cell_fields) count_not_finite(field, true, all);
    return all;
}

}  // namespace barycert
