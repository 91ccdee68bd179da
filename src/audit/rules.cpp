// Rules that answer cases of their own: all families of cases, on threads. Rules on triangles in space are compared
// with the oracle; inverse maps with barycert's own, which are proved case by case.

#include <cmath>

#include "audit/asking.hpp"
#include "audit/inverses/reference.hpp"
#include "barycert/locator.hpp"
#include "core/base/ulp.hpp"
#include "core/vtk_cell.hpp"
#include "mesh/pulling.hpp"

namespace barycert {

using namespace audit;

namespace {

/// Fills audit.results, and sets audit.threads. Groups of cases are the families, once for each of `variants`, in turn.
/// fits(group, rule): it answers these cases. judge(group, index, each) makes a case and calls each(use) for use(rule,
/// tally) of these rules, unless nothing is right.
template <class Rule, class Tally, class Families, class Fits, class Judge>
void audit_rules(RuleAudit<Rule, Tally>& audit, const Families& families, std::size_t variants, const Fits& fits,
                 const Judge& judge) {
    constexpr std::uint64_t block = 256;  // cases that a thread takes at once
    audit.threads = base::threads_for(audit.threads);
    const std::vector<Rule>& rules = audit.rules;
    const std::size_t groups = variants * families.size();
    const auto blocks = static_cast<std::size_t>((audit.count + block - 1) / block);
    // Threads merge into them, in any order.
    std::vector<std::vector<Tally>> tallies(groups, std::vector<Tally>(rules.size()));
    std::mutex merging;
    std::uint64_t done = 0;
    on_threads(audit.threads, groups * blocks, [&](std::size_t work) {
        const std::size_t group = work / blocks;
        std::vector<Tally> found(rules.size());
        const auto each = [&](const auto& use) {
            for (std::size_t r = 0; r < rules.size(); ++r) {
                if (fits(group, rules[r])) use(rules[r], found[r]);
            }
        };
        const std::uint64_t first = work % blocks * block;
        for (std::uint64_t i = first; i < std::min(first + block, audit.count); ++i) judge(group, i, each);
        const std::lock_guard lock(merging);
        for (std::size_t r = 0; r < rules.size(); ++r) tallies[group][r].merge(found[r]);
        done += std::min(block, audit.count - first);
        if (audit.progress) audit.progress({done, groups * audit.count, families[group % families.size()].name});
    });
    audit.results.clear();
    for (std::size_t r = 0; r < rules.size(); ++r) {
        RuleResult<Rule, Tally>& result = audit.results.emplace_back();
        result.rule = rules[r];
        for (std::size_t group = 0; group < groups; ++group) {
            if (!fits(group, rules[r])) continue;
            tallies[group][r].family = group % families.size();
            result.total.merge(tallies[group][r]);
            result.families.push_back(tallies[group][r]);
        }
    }
}

/// The right answer; nothing where either answer is right.
std::optional<double> exact_answer(SurfaceQuestion question, const SurfaceCase& c) {
    if (question == SurfaceQuestion::distance) return oracle_distance(c.triangles[0], c.point.data());
    if (question == SurfaceQuestion::meet) return oracle_meet(c.triangles[0], c.triangles[1]);
    const int side = oracle_side(c.triangles, c.point.data());
    return side == 0 ? std::nullopt : std::optional<double>(side > 0);
}

}  // namespace

void SurfaceTally::add(SurfaceQuestion question, double answer, double exact, std::uint64_t index) {
    const ExactEnvironment environment;
    const bool is_distance = question == SurfaceQuestion::distance;
    const bool is_yes = is_distance ? exact == 0 : exact != 0, says_yes = is_distance ? answer == 0 : answer != 0;
    const std::uint64_t before = wrong_cases();
    ++cases;
    yes += is_yes;
    if (std::isfinite(answer)) {
        false_yes += says_yes && !is_yes;
        false_no += !says_yes && is_yes;
    } else {
        ++not_finite;
    }
    if (is_distance && !is_yes && std::isfinite(answer)) {
        const double error = base::ulp_error_here(answer, exact);
        ulps.add(error);
        worst.include(error, index);
    }
    if (wrong_cases() != before) wrong.include(1, index);
}

void SurfaceTally::merge(const SurfaceTally& other) {
    using S = SurfaceTally;
    for (const auto count : {&S::cases, &S::yes, &S::false_yes, &S::false_no, &S::not_finite})
        this->*count += other.*count;
    ulps.merge(other.ulps);
    worst.include(other.worst.value, other.worst.index);
    wrong.include(other.wrong.value, other.wrong.index);
}

void audit_surfaces(SurfaceAudit& audit) {
    const ExactEnvironment environment;
    if (audit.rules.empty()) audit.rules = surface_rules();
    const std::vector<SurfaceFamily>& families = surface_families();
    const auto fits = [&](std::size_t f, const SurfaceRule& rule) { return rule.question == families[f].question; };
    audit_rules(audit, families, 1, fits, [&](std::size_t f, std::uint64_t i, const auto& each) {
        const SurfaceCase c = make_surface_case(families[f], audit.seed, i);
        const std::optional<double> exact = exact_answer(families[f].question, c);
        if (!exact) return;
        each(
            [&](const SurfaceRule& rule, SurfaceTally& tally) { tally.add(rule.question, rule.answer(c), *exact, i); });
    });
}

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
