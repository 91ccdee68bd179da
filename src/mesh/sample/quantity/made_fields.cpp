#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/text.hpp"
#include "mesh/consistency.hpp"
#include "mesh/sample/quantity/quantities.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::sample {
namespace {

using Kind = QuantityStep::Kind;

/// number(values of a row): of one component.
template <class Number>
Field field_of_rows(const Field& whole, Number number) {
    const auto n = static_cast<std::size_t>(whole.components);
    Field field{{}, 1, std::vector<double>(whole.data.size() / n)};
    for (std::size_t i = 0; i < field.data.size(); ++i) field.data[i] = number(std::span(whole.data).subspan(n * i, n));
    return field;
}

Field gradient_field(const Mesh& mesh, const Field& of_nodes) {
    const std::size_t d = static_cast<std::size_t>(mesh.dimension), cells = mesh.cell_count();
    const std::size_t per_cell = d * static_cast<std::size_t>(of_nodes.components);
    Field field{{}, static_cast<int>(per_cell), std::vector<double>(per_cell * cells)};
    const Simplex simplex = d == 2 ? Simplex::triangle : Simplex::tetrahedron;
    const NodalValues<double> values{of_nodes.data, of_nodes.components};
    constexpr std::size_t cells_of_task = std::size_t{1} << 13;
    base::parallel_for(cells, cells_of_task, [&](std::size_t begin, std::size_t end) {
        const auto corners = std::span(mesh.cells).subspan(mesh.corners() * begin, mesh.corners() * (end - begin));
        const auto out = std::span(field.data).subspan(per_cell * begin, per_cell * (end - begin));
        // Coordinates are finite, and sizes fit: there is no Error.
        gradients(simplex, mesh.points, corners, values, out).value();
    });
    return field;
}

}  // namespace

void make_fields(const Mesh& mesh, FieldChoice& choice, std::size_t count, std::deque<Field>& made, bool lengths) {
    const ExactEnvironment environment;
    std::size_t taken = 0;
    for (; taken < count; ++taken) {
        const QuantityStep& step = choice.steps[taken];
        const bool gradient = step.kind == Kind::gradient;
        const bool at_points =
            (step.kind == Kind::length && !choice.of_cells && !lengths) || (gradient && !mesh.mid_nodes.empty());
        if (at_points) break;
        const auto component = [&](const auto& row) { return row[static_cast<std::size_t>(step.component)]; };
        made.push_back(gradient                    ? gradient_field(mesh, *choice.field)
                       : step.kind == Kind::mean   ? nodal_mean(mesh, *choice.field)
                       : step.kind == Kind::length ? field_of_rows(*choice.field, euclidean_length)
                                                   : field_of_rows(*choice.field, component));
        choice.field = &made.back();
        choice.of_cells = gradient || (choice.of_cells && step.kind != Kind::mean);
    }
    choice.steps.erase(choice.steps.begin(), choice.steps.begin() + static_cast<std::ptrdiff_t>(taken));
}

Status make_all_fields(const Mesh& mesh, std::vector<FieldChoice>& choices, std::deque<Field>& made, Notes& notes) {
    for (FieldChoice& choice : choices) {
        if (choice.steps.empty()) continue;
        if (const char* const wrong = mesh::inconsistency_of_cells(mesh, mesh::FieldValues::any); wrong != nullptr)
            return Error{.code = "mesh.inconsistent", .what = std::string("the mesh is inconsistent: ") + wrong};
        const Result<QuantityShape> shape = shape_of(mesh, choice);
        if (!shape) return shape.error();
        make_fields(mesh, choice, choice.steps.size(), made, true);
        if (!choice.steps.empty())
            return Error{.code = "field.location",
                         .what = "no field has what differs from point to point in a cell",
                         .found = '"' + choice.name + '"',
                         .remedy = "on cells of second order draw the field itself, or sample its gradient at points"};
        made.back().name = choice.name;
        const Note note{Note::Kind::converted, choice.name + ": taken at the nodes, and interpolated between them"};
        if (shape->at_points && std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    }
    return Done{};
}

Result<FieldChoice> number_named(const Mesh& mesh, const std::string& name) {
    Result<std::vector<FieldChoice>> chosen = quantities_named(mesh, {name});
    if (!chosen) return chosen.error();
    if (chosen->size() != 1)
        return Error{.code = "field.ambiguous",
                     .what = "more than one field",
                     .expected = "one",
                     .found = base::quoted(name),
                     .remedy = "name one"};
    const std::size_t n = shape_of(mesh, chosen->front())->components;
    if (n == 1) return std::move(chosen->front());
    return Error{
        .code = "field.component",
        .what = "the field has several components",
        .expected = "one: " + name + ".0 to " + name + '.' + std::to_string(n - 1) + ", or the length |" + name + "|",
        .found = base::quoted(name),
        .remedy = "choose one of them"};
}

// u = 2^-53, n components, m the largest magnitude, scaled so that 2^-500 <= m <= 2^500. That is exact: where m is
// scaled down, what a small component loses is below 2^-1074, while m > 2^-100.
//
// The sum S of squares as high + low: products and sums of two terms are exact but for the remainders of products below
// 2^-969, each off by at most 2^-1074, where S >= 2^-1000: n 2^-74 S at most. `low` sums 2 n - 1 terms of at most u S
// in plain double: off by at most (2 n)^2 u^2 S. So (high + low) is S (1 + e) with |e| <= n 2^-74 + 4 n^2 u^2.
//
// r = sqrt(high) (1 + d), |d| <= u. The remainder high - r^2 is a double, and r + (high - r^2 + low) / (2 r), the first
// step of Newton's method, is off by (high - r^2 + low)^2 / (8 r^3) and the roundings of its second term, which is at
// most 3 u r: less than 16 u^2 r in all, before the last sum is rounded. With n <= 2^20 that is 2^-53 u r and what
// comes of e, less than 2^-20 units in the last place. Beyond the normal numbers the last product rounds once more, to
// the same unit: by half of it.
//
// A vector whose components are correctly rounded has each off by at most u of itself, or 2^-1075 where it is
// subnormal, so the length is off by u of itself, which is less than one unit in the last place, or sqrt(n) 2^-1075.
// With n <= 9 that is 1.5 subnormal units: together with the last rounding less than 1.51 units where the length is not
// subnormal, else at most 2.
double euclidean_length(std::span<const double> v) {
    double max = 0;
    bool nan = false;
    for (const double x : v) {
        nan = nan || std::isnan(x);
        max = std::max(max, std::abs(x));
    }
    if (nan) return std::numeric_limits<double>::quiet_NaN();
    if (max == 0 || std::isinf(max)) return max;
    const double scale = max < 0x1p-500 ? 0x1p600 : max > 0x1p500 ? 0x1p-600 : 1, back = 1 / scale;
    double high = 0, low = 0;
    for (const double x : v) {
        const double s = x * scale, square = s * s;
        const double sum = high + square, part = sum - high;
        low += (high - (sum - part)) + (square - part);
        low += std::fma(s, s, -square);
        high = sum;
    }
    const double r = std::sqrt(high);
    const double correction = (std::fma(-r, r, high) + low) / (2 * r);
    return (r + correction) * back;
}

}  // namespace barycert::sample
