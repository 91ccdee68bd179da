// Inverse maps: the judge agrees with Newton's method in 100 digits, written apart; rules fail where their words say;
// broken ones are caught.

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <optional>
#include <string>

#include "barycert/audit_report.hpp"

namespace barycert {
namespace {

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

constexpr std::array<std::uint8_t, 4> types{9, 12, 13, 14};

template <class T>
std::vector<T> functions(std::uint8_t type, const std::array<T, 3>& x) {
    const T &r = x[0], &s = x[1], &t = x[2];
    const T a = 1 - r, b = 1 - s, c = 1 - t;
    switch (type) {
        case 9:
            return {a * b, r * b, r * s, a * s};
        case 13:
            return {(a - s) * c, r * c, s * c, (a - s) * t, r * t, s * t};
        case 14:
            return {a * b * c, r * b * c, r * s * c, a * s * c, t};
        default:
            return {a * b * c, r * b * c, r * s * c, a * s * c, a * b * t, r * b * t, r * s * t, a * s * t};
    }
}

/// The point, and the value in place 3.
template <class T>
std::array<T, 4> image(const InverseCase& c, const std::array<T, 3>& x) {
    const auto n = functions<T>(c.type, x);
    std::array<T, 4> sum{};
    for (std::size_t i = 0; i < n.size(); ++i) {
        for (std::size_t k = 0; k < c.point.size(); ++k) sum[k] += n[i] * T(c.nodes[c.point.size() * i + k]);
        sum[3] += n[i] * T(c.values[i]);
    }
    return sum;
}

/// Newton's method, derivatives by differences of `h`; steps of at most 1/2.
template <class T>
std::optional<std::array<T, 3>> newton(const InverseCase& c, std::array<T, 3> x, const T& h, const T& enough,
                                       int steps) {
    const std::size_t d = c.point.size();
    for (int step = 0; step < steps; ++step) {
        std::array<std::array<T, 4>, 3> a{};
        const auto here = image<T>(c, x);
        for (std::size_t j = 0; j < d; ++j) {
            auto moved = x;
            moved[j] += h;
            const auto there = image<T>(c, moved);
            for (std::size_t k = 0; k < d; ++k) a[k][j] = (there[k] - here[k]) / h;
        }
        for (std::size_t k = 0; k < d; ++k) a[k][d] = T(c.point[k]) - here[k];
        for (std::size_t column = 0; column < d; ++column) {
            std::size_t pivot = column;
            for (std::size_t i = column; i < d; ++i) {
                if (abs(a[i][column]) > abs(a[pivot][column])) pivot = i;
            }
            std::swap(a[pivot], a[column]);
            if (a[column][column] == 0) return std::nullopt;
            for (std::size_t i = 0; i < d; ++i) {
                if (i == column) continue;
                const T f = a[i][column] / a[column][column];
                for (std::size_t j = column; j <= d; ++j) a[i][j] -= f * a[column][j];
            }
        }
        T most = 0;
        for (std::size_t k = 0; k < d; ++k) {
            T by = a[k][d] / a[k][k];
            most = std::max(most, T(abs(by)));
            if (by > T(0.5)) by = 0.5;
            if (by < T(-0.5)) by = -0.5;
            x[k] += by;
        }
        if (most < enough) return x;
    }
    return std::nullopt;
}

/// The least of the numbers that are not negative inside.
template <class T>
T margin(const InverseCase& c, const std::array<T, 3>& x) {
    T least = c.type == 13 ? T(1 - x[0] - x[1]) : T(1);
    for (std::size_t k = 0; k < c.point.size(); ++k) least = std::min({least, x[k], T(1 - x[k])});
    return least;
}

struct Found {
    Region region = Region::outside;
    std::array<Digits, 3> x;
    Digits value;
};

/// From many starts, until one leads into the cell. An apex is a node, and no root that Newton's method could find.
Found in_100_digits(const InverseCase& c) {
    Found found;
    const std::size_t d = c.point.size();
    for (std::size_t i = 0; i < c.values.size(); ++i) {
        if (!std::equal(c.point.begin(), c.point.end(), c.nodes.begin() + static_cast<std::ptrdiff_t>(d * i))) continue;
        return {Region::boundary, {-1, -1, -1}, Digits(c.values[i])};
    }
    for (int start = 0; start < 64; ++start) {
        const std::array<int, 3> place{start % 4, start / 4 % 4, start / 16};
        if (d == 2 && place[2] != 0) break;
        std::array<long double, 3> about{};
        for (std::size_t k = 0; k < d; ++k) about[k] = static_cast<long double>(place[k]) / 3 * 0.98L + 0.01L;
        const auto near = newton<long double>(c, about, 1e-7L, 1e-6L, 200);
        if (!near || !(margin(c, *near) > -0.01L)) continue;
        auto exact = newton<Digits>(c, {Digits((*near)[0]), Digits((*near)[1]), Digits((*near)[2])}, Digits("1e-45"),
                                    Digits("1e-75"), 60);
        if (!exact) continue;
        for (Digits& own : *exact) {  // fractions of few bits: there are ties
            const Digits near_by = round(own * 1024) / 1024;
            if (abs(own - near_by) < Digits("1e-60")) own = near_by;
        }
        const Digits least = margin(c, *exact);
        if (least < 0) continue;
        return {least > 0 ? Region::interior : Region::boundary, *exact, image<Digits>(c, *exact)[3]};
    }
    return found;
}

TEST(Inverses, JudgeAgreesWithNewtonIn100Digits) {
    std::map<Region, int> seen;
    for (const std::uint8_t type : types) {
        for (const InverseFamily& family : inverse_families()) {
            for (std::uint64_t i = 0; i < 40; ++i) {
                const InverseCase c = make_inverse_case(family, type, 5, i);
                const ExactInverse exact = exact_inverse(c);
                const Found found = in_100_digits(c);
                ASSERT_EQ(exact.region, found.region) << int(type) << ' ' << family.name << ' ' << i;
                ++seen[exact.region];
                if (exact.region == Region::outside) continue;
                ASSERT_EQ(exact.value, found.value.convert_to<double>()) << int(type) << ' ' << family.name << ' ' << i;
                for (std::size_t k = type == 14 ? 2 : 0; k < c.point.size() && found.x[0] != -1; ++k) {
                    // Coordinates that are exactly 0 or 1 are so up to 1e-60.
                    const Digits off = abs(found.x[k] - Digits(exact.x[k])), size = abs(found.x[k]);
                    ASSERT_LE(off, size * Digits(0x1p-53) + Digits("1e-60")) << int(type) << ' ' << family.name << i;
                }
            }
        }
    }
    EXPECT_GT(seen[Region::interior], 500);
    EXPECT_GE(seen[Region::boundary], 160);
    EXPECT_GT(seen[Region::outside], 300);
}

InverseAudit audited(std::uint64_t count, std::vector<InverseRule> rules = inverse_rules(), int threads = 0) {
    InverseAudit audit{.seed = 3, .count = count, .threads = threads, .rules = std::move(rules)};
    audit_inverses(audit);
    return audit;
}

const InverseTally& tally(const InverseAudit& audit, const std::string& rule, const std::string& family) {
    for (const auto& r : audit.results) {
        for (const InverseTally& t : r.families) {
            if (r.rule.name == rule && inverse_families()[t.family].name == family) return t;
        }
    }
    ADD_FAILURE() << "no " << rule << " on " << family;
    return audit.results.front().total;
}

TEST(Inverses, RulesFailWhereTheirWordsSay) {
    const InverseAudit audit = audited(400);
    for (const char* rule : {"hexahedron.newton-1e-3", "wedge.newton-1e-3", "pyramid.newton-1e-3"}) {
        const InverseTally& flat = tally(audit, rule, "flat-corner");
        EXPECT_GT(flat.errors.worst.value, 1e-3) << rule << ": steps get small before the point is near";
        EXPECT_EQ(flat.told[0][1], 0U) << rule;
        EXPECT_GT(tally(audit, rule, "warped").errors.worst.value, 1e-8) << rule;
        EXPECT_GT(tally(audit, rule, "thin").told[0][2], 20U) << rule << ": Jacobians below 1e-20";
        EXPECT_GT(tally(audit, rule, "beyond").told[2][0], 100U) << rule;
    }
    EXPECT_GT(tally(audit, "quadrilateral.newton-1e-4", "flat-corner").errors.worst.value, 1e-5);
    EXPECT_GT(tally(audit, "hexahedron.newton-1e-5", "flat-corner").told[0][2], 100U);
    EXPECT_GT(tally(audit, "pyramid.newton-1e-8", "boundary").told[1][2], 50U) << "the apex";
    for (const auto& r : audit.results) {
        const std::string& rule = r.rule.name;
        EXPECT_GT(r.total.wrong_cases(), 0U) << rule;
        EXPECT_EQ(tally(audit, rule, "affine").wrong_cases(), 0U) << rule;
        EXPECT_EQ(tally(audit, rule, "warped").wrong_cases(), 0U) << rule;
        EXPECT_EQ(tally(audit, rule, "far").wrong_cases(), 0U) << rule;
        EXPECT_LT(tally(audit, rule, "affine").errors.worst.value, 1e-11) << rule;
        if (!rule.ends_with("1e-8")) continue;
        EXPECT_GT(tally(audit, rule, "boundary").told[1][1], 50U) << rule;
        EXPECT_GT(tally(audit, rule, "flat-corner").told[0][2], 100U) << rule << ": more than ten steps";
        EXPECT_EQ(tally(audit, rule, "beyond").wrong_cases(), 0U) << rule;
        EXPECT_LT(tally(audit, rule, "warped").value_ulps.quantile(0.5), 4) << rule;
        EXPECT_GT(tally(audit, rule, "moved").value_ulps.quantile(0.5), 1e5) << rule << ": coordinates lose 20 bits";
    }
}

TEST(Inverses, FamiliesAreWhatTheySay) {
    for (const std::uint8_t type : types) {
        for (const InverseFamily& family : inverse_families()) {
            std::map<Region, int> seen;
            for (std::uint64_t i = 0; i < 200; ++i) {
                const InverseCase c = make_inverse_case(family, type, 1, i);
                const ExactInverse exact = exact_inverse(c);
                ++seen[exact.region];
                ASSERT_FALSE(std::isnan(exact.value)) << family.name << ' ' << int(type) << ' ' << i;
            }
            const std::string& name = family.name;
            EXPECT_EQ(seen[Region::degenerate], 0) << name << ": the map is proved to be injective";
            const bool outside = name == "beyond" || name == "far";
            if (name == "beside") {
                EXPECT_TRUE(seen[Region::interior] > 50 && seen[Region::outside] > 50) << int(type);
            } else {
                const Region all = name == "boundary" ? Region::boundary : outside ? Region::outside : Region::interior;
                EXPECT_GT(seen[all], 198) << name << ' ' << int(type);
            }
        }
    }
}

// D1, and cases that a report names.
TEST(Inverses, ThreadsChangeNothingAndWrongCasesAreMadeAgain) {
    const InverseAudit one = audited(300, inverse_rules(), 1);
    InverseAudit many = audited(300, inverse_rules(), 5);
    many.threads = one.threads;
    EXPECT_EQ(inverses_json(one), inverses_json(many));
    int shown = 0;
    for (const auto& r : one.results) {
        for (const InverseTally& t : r.families) {
            EXPECT_EQ(t.cases, 300U);
            EXPECT_EQ(t.wrong.value > 0, t.wrong_cases() != 0);
            if (t.wrong.value < 0) continue;
            const InverseCase c = make_inverse_case(inverse_families()[t.family], r.rule.type, 3, t.wrong.index);
            const InverseAnswer answer = r.rule.answer(c);
            EXPECT_NE(answer.found && answer.inside, exact_inverse(c).region != Region::outside) << r.rule.name;
            ++shown;
        }
    }
    EXPECT_GT(shown, 20);
}

// A perfect rule has no finding; each fault in it shows in the figure that is made for it.
TEST(Inverses, BrokenRulesAreCaught) {
    using Change = std::function<void(InverseAnswer&)>;
    const auto rule = [](const char* name, Change change) {
        return InverseRule{name, 12, "", "", "", [change](const InverseCase& c) {
                               const ExactInverse exact = exact_inverse(c);
                               InverseAnswer answer{true, exact.region != Region::outside, exact.x, exact.value};
                               change(answer);
                               return answer;
                           }};
    };
    const InverseAudit audit =
        audited(60, {rule("perfect", [](InverseAnswer&) {}), rule("mute", [](InverseAnswer& a) { a.found = false; }),
                     rule("inside", [](InverseAnswer& a) { a.inside = true; }),
                     rule("outside", [](InverseAnswer& a) { a.inside = false; }),
                     rule("swapped", [](InverseAnswer& a) { std::swap(a.x[0], a.x[1]); }),
                     rule("x", [](InverseAnswer& a) { a.x[2] = std::nextafter(a.x[2], 2); }),
                     rule("value", [](InverseAnswer& a) { a.value = std::nextafter(a.value, 2); }),
                     rule("nan", [](InverseAnswer& a) { a.value = NAN; })});
    const auto total = [&](std::size_t i) -> const InverseTally& { return audit.results[i].total; };
    const auto cases = [](const auto& told) { return told[0] + told[1] + told[2]; };
    const std::uint64_t interior = cases(total(0).told[0]), boundary = cases(total(0).told[1]),
                        outside = cases(total(0).told[2]);
    EXPECT_TRUE(interior > 250 && boundary >= 60 && outside > 100);
    EXPECT_EQ(total(0).wrong_cases(), 0U);
    EXPECT_EQ(total(0).x_ulp.value, 0);
    EXPECT_EQ(total(0).value_ulp.value, 0);
    EXPECT_EQ(total(0).errors.worst.value, 0);
    EXPECT_EQ(total(1).wrong_cases(), interior + boundary) << "of points outside no answer is none that is wrong";
    EXPECT_EQ(total(1).told[2][2], outside);
    EXPECT_EQ(total(2).wrong_cases(), outside);
    EXPECT_EQ(total(3).wrong_cases(), interior + boundary);
    EXPECT_EQ(total(4).wrong_cases(), 0U);
    EXPECT_GT(total(4).x_ulp.value, 1e12);
    EXPECT_EQ(total(4).value_ulp.value, 0);
    EXPECT_EQ(total(5).x_ulp.value, 1);
    EXPECT_EQ(total(6).value_ulp.value, 1);
    EXPECT_EQ(total(6).x_ulp.value, 0);
    EXPECT_EQ(total(7).told[0][2], interior);
    EXPECT_EQ(total(7).value_ulp.value, -1);
}

// Nothing is said of cells whose map is not proved to be injective.
TEST(Inverses, FoldedCellsAreNotJudged) {
    InverseCase c = make_inverse_case(inverse_families().front(), 12, 1, 0);
    std::swap_ranges(c.nodes.begin(), c.nodes.begin() + 3, c.nodes.begin() + 18);
    EXPECT_EQ(exact_inverse(c).region, Region::degenerate);
}

}  // namespace
}  // namespace barycert
