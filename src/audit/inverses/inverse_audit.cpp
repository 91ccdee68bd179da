// Inverse maps of cells, compared with barycert's own, which are proved case by case.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "audit/inverses/reference.hpp"
#include "audit/rule_loop.hpp"
#include "barycert/environment.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "core/base/ulp.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/shape_functions.hpp"
#include "core/vtk_cell.hpp"
#include "mesh/pulling.hpp"

namespace barycert {

using namespace audit;

ExactInverse exact_inverse(const InverseCase& c) {
    const ExactEnvironment environment;
    const iso::Reference& of = *iso::linear_reference(c.type);
    const std::size_t d = of.dimension();
    Mesh mesh;
    mesh.dimension = static_cast<int>(d);
    mesh.points = c.nodes;
    mesh.shapes.types = {c.type};
    mesh.shapes.ends = {static_cast<std::int64_t>(of.nodes)};
    mesh.shapes.nodes.resize(of.nodes);
    std::iota(mesh.shapes.nodes.begin(), mesh.shapes.nodes.end(), 0);
    mesh::pull(mesh);
    mesh.cell_numbers.assign(mesh.cell_count(), 0);
    const Locator locator =
        Locator::build(mesh, {.prove = Prove::never, .interpolation = CellInterpolation::multilinear, .threads = 1})
            .value();
    if (locator.unmapped_cells() != 0) return {};
    const Feature feature = locator.locate(c.point, 1).value().features.front();
    ExactInverse exact{.region = feature == Feature::interior  ? Region::interior
                                 : feature == Feature::outside ? Region::outside
                                                               : Region::boundary};
    if (feature == Feature::outside) return exact;
    // The reference cell's own coordinates are fields that the map carries over; of a pyramid r and s are not, as they
    // lose their meaning towards the apex.
    std::array<double, 4 * 8> fields{};
    for (std::size_t i = 0; i < of.nodes; ++i) {
        std::array<double, 3> x = reference_node(c.type, i);
        if (c.type == vtk_pyramid) x[0] = x[1] = 0;
        std::copy_n(x.begin(), d, &fields[4 * i]);
        fields[4 * i + 3] = c.values[i];
    }
    std::array<double, 4> out{};
    const auto found = iso::evaluate(of, places_of(c), c.point.data(), ~std::uint64_t{0}, fields.data(), 4, out.data());
    if (found.certainty != iso::Certainty::proved) out.fill(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < of.nodes; ++i) {  // at the apex of a pyramid the Jacobian is 0
        if (std::equal(c.point.begin(), c.point.end(), &c.nodes[d * i])) std::copy_n(&fields[4 * i], 4, out.begin());
    }
    std::copy_n(out.begin(), 3, exact.x.begin());
    exact.value = out[3];
    return exact;
}

std::uint64_t InverseTally::wrong_cases() const {
    return told[0][1] + told[0][2] + told[1][1] + told[1][2] + told[2][0];
}

void InverseTally::add(const InverseAnswer& answer, const ExactInverse& exact, const InverseCase& c,
                       std::uint64_t index) {
    const ExactEnvironment environment;
    const bool found = answer.found && std::isfinite(answer.value + answer.x[0] + answer.x[1] + answer.x[2]);
    const bool outside = exact.region == Region::outside, inside = found && answer.inside;
    ++cases;
    ++told[static_cast<std::size_t>(exact.region)][!found ? 2 : inside ? 0 : 1];
    if (inside == outside) wrong.include(1, index);
    if (!inside || outside || !std::isfinite(exact.value)) return;
    double most = -1;
    for (std::size_t k = 0; k < 3; ++k) {
        if (exact.x[k] != 0) most = std::max(most, base::ulp_error_here(answer.x[k], exact.x[k]));
    }
    if (most >= 0) x_ulps.add(most);
    x_ulp.include(most, index);
    if (exact.value != 0) {
        const double error = base::ulp_error_here(answer.value, exact.value);
        value_ulps.add(error);
        value_ulp.include(error, index);
    }
    const auto [low, high] = std::ranges::minmax(c.values);
    if (low < high) errors.add(std::fabs(answer.value - exact.value) / (high - low), index);
}

void InverseTally::merge(const InverseTally& other) {
    cases += other.cases;
    for (std::size_t i = 0; i < 9; ++i) told[i / 3][i % 3] += other.told[i / 3][i % 3];
    x_ulps.merge(other.x_ulps);
    value_ulps.merge(other.value_ulps);
    errors.merge(other.errors);
    using T = InverseTally;
    for (const auto worst : {&T::x_ulp, &T::value_ulp, &T::wrong})
        (this->*worst).include((other.*worst).value, (other.*worst).index);
}

void audit_inverses(InverseAudit& audit) {
    const ExactEnvironment environment;
    if (audit.rules.empty()) audit.rules = inverse_rules();
    const std::vector<InverseFamily>& families = inverse_families();
    constexpr std::array<std::uint8_t, 4> types{vtk_quad, vtk_hexahedron, vtk_wedge, vtk_pyramid};
    const auto fits = [&](std::size_t group, const InverseRule& rule) {
        return rule.type == types[group / families.size()];
    };
    audit_rules(audit, families, types.size(), fits, [&](std::size_t group, std::uint64_t i, const auto& each) {
        const std::uint8_t type = types[group / families.size()];
        const InverseCase c = make_inverse_case(families[group % families.size()], type, audit.seed, i);
        const ExactInverse exact = exact_inverse(c);
        if (exact.region == Region::degenerate) return;
        each([&](const InverseRule& rule, InverseTally& tally) { tally.add(rule.answer(c), exact, c, i); });
    });
}

}  // namespace barycert
