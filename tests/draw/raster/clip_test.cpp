#include "barycert/raster.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "tests/draw/raster/clip_judge.hpp"

namespace barycert {
namespace {

using Rows = std::vector<double>;

/// Numbers of all kinds: small integers, so that much lies exactly on bounds; ordinary ones; any magnitude.
double any_number(base::Random& random, std::uint64_t kind) {
    if (kind == 0) return random.integer(-3, 3);
    if (kind == 1) return random.uniform(-2, 2);
    if (kind == 2) return random.scaled(-1, 1, -60, 60);
    return random.scaled(-1, 1, -1074, 1023);
}

/// A triangle with `attributes` attributes.
Rows any_triangle(base::Random& random, std::size_t attributes) {
    Rows rows;
    const std::uint64_t kind = random.below(4);
    for (std::size_t i = 0; i < 3 * (4 + attributes); ++i) rows.push_back(any_number(random, kind));
    return rows;
}

std::vector<Rows> split(const Rows& polygon, std::size_t row) {
    std::vector<Rows> all;
    for (std::size_t i = 0; i < polygon.size(); i += row)
        all.emplace_back(polygon.begin() + static_cast<std::ptrdiff_t>(i),
                         polygon.begin() + static_cast<std::ptrdiff_t>(i + row));
    return all;
}

TEST(ClipTriangle, C1C2AsTheJudgeSays) {
    base::Random random(1);
    std::size_t cut = 0, outside = 0, inside = 0, eye = 0, most = 0;
    for (int k = 0; k < 6000; ++k) {
        const std::size_t attributes = random.below(4), row = 4 + attributes;
        const Rows triangle = any_triangle(random, attributes);
        Rows polygon;
        const Clip clip = clip_triangle(triangle, polygon).value();
        const std::vector<RationalRow> judged = judge_clip(triangle);
        (clip == Clip::cut ? cut : clip == Clip::outside ? outside : clip == Clip::inside ? inside : eye) += 1;
        if (clip == Clip::at_eye) {
            // Some vertex has a w that is zero, or rounds to it.
            ASSERT_TRUE(
                std::any_of(judged.begin(), judged.end(), [](const RationalRow& r) { return is_nearest(0, r[3]); }));
            continue;
        }
        const std::vector<Rows> vertices = split(polygon, row);
        ASSERT_EQ(vertices.size(), judged.size()) << ::testing::PrintToString(triangle);
        most = std::max(most, vertices.size());
        // The same polygon, beginning at the same vertex or another one.
        const auto same = [&](std::size_t first) {
            for (std::size_t i = 0; i < vertices.size(); ++i) {
                const RationalRow& exact = judged[(first + i) % judged.size()];
                for (std::size_t c = 0; c < row; ++c) {
                    if (!is_nearest(vertices[i][c], exact[c])) return false;
                }
            }
            return true;
        };
        bool found = vertices.empty();
        for (std::size_t first = 0; first < judged.size() && !found; ++first) found = same(first);
        ASSERT_TRUE(found) << k;
    }
    // Each outcome was there, and polygons of many vertices.
    EXPECT_GT(cut, 500U);
    EXPECT_GT(outside, 500U);
    EXPECT_GT(inside, 20U);
    EXPECT_GT(eye, 0U);
    EXPECT_GE(most, 6U);
}

TEST(ClipTriangle, NineVertices) {
    // A triangle that meets all six sides of the cube, w = 1: near the plane x + y + z = 0, tilted to a triangle.
    const Rows triangle{1.9, -1.9, 0.05, 1, 0, 1.9, -1.9, 1, -1.9, 0.05, 1.9, 1};
    Rows polygon;
    ASSERT_EQ(clip_triangle(triangle, polygon).value(), Clip::cut);
    EXPECT_EQ(polygon.size() / 4, judge_clip(triangle).size());
    EXPECT_EQ(polygon.size() / 4, static_cast<std::size_t>(max_clipped_vertices));
}

TEST(ClipTriangle, BehindTheEyeNothingWrapsAround) {
    Rows polygon;
    EXPECT_EQ(clip_triangle(Rows{0, 0, 0, -1, 1, 0, 0, -1, 0, 1, 0, -1}, polygon).value(), Clip::outside);
    // One vertex behind: what is left has w > 0 throughout.
    const Rows triangle{0, 0, 0.5, 1, 0.5, 0, 0.5, 1, 0, 0, -3, -2};
    ASSERT_EQ(clip_triangle(triangle, polygon).value(), Clip::cut);
    for (std::size_t i = 3; i < polygon.size(); i += 4) EXPECT_GT(polygon[i], 0);
    // Through the eye: seen edge-on.
    EXPECT_EQ(clip_triangle(Rows{0, 0, 0, 0, 0.5, 0, 0, 1, 0, 0.5, 0, 1}, polygon).value(), Clip::at_eye);
    EXPECT_EQ(clip_triangle(Rows{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, polygon).value(), Clip::at_eye);
    EXPECT_TRUE(polygon.empty());
}

TEST(ClipTriangle, TouchingIsOutside) {
    Rows polygon;
    EXPECT_EQ(clip_triangle(Rows{1, 0, 0, 1, 2, 0, 0, 1, 2, 1, 0, 1}, polygon).value(), Clip::outside);
    EXPECT_EQ(clip_triangle(Rows{1, 0, 0, 1, 1, 0.5, 0, 1, 2, 1, 0, 1}, polygon).value(), Clip::outside);
    EXPECT_EQ(clip_triangle(Rows{1, 0, 0, 1, 1, 0.5, 0, 1, 1, 1, 0, 1}, polygon).value(), Clip::inside);
}

TEST(ClipTriangle, C3SharedEdgesHaveTheSameBits) {
    base::Random random(2);
    std::size_t shared = 0;
    for (int k = 0; k < 4000; ++k) {
        const std::uint64_t kind = random.below(3);
        Rows a, b, c, d;
        for (Rows* v : {&a, &b, &c, &d}) {
            for (int i = 0; i < 6; ++i) v->push_back(any_number(random, kind));
        }
        // The ends of what is left of the edge a, b, seen from both triangles.
        const auto ends = [&](const Rows& p, const Rows& q, const Rows& r) {
            Rows rows = p, polygon;
            rows.insert(rows.end(), q.begin(), q.end());
            rows.insert(rows.end(), r.begin(), r.end());
            EXPECT_TRUE(clip_triangle(rows, polygon));
            return split(polygon, 6);
        };
        const std::vector<Rows> left = ends(a, b, c), right = ends(b, a, d);
        // The edge alone, clipped as a triangle with two equal vertices is.
        Rows edge = a;
        edge.insert(edge.end(), b.begin(), b.end());
        edge.insert(edge.end(), b.begin(), b.end());
        if (left.empty() || right.empty()) continue;
        for (const RationalRow& end : judge_clip(edge)) {
            const auto of = [&](const std::vector<Rows>& polygon) {
                return std::find_if(polygon.begin(), polygon.end(), [&](const Rows& v) {
                    for (std::size_t i = 0; i < 6; ++i) {
                        if (!is_nearest(v[i], end[i])) return false;
                    }
                    return true;
                });
            };
            ASSERT_NE(of(left), left.end());
            ASSERT_NE(of(right), right.end());
            ASSERT_EQ(*of(left), *of(right));
            ++shared;
        }
    }
    EXPECT_GT(shared, 500U);
}

void expect_not_clipped_again(const Rows& triangle, std::size_t row) {
    Rows polygon, again;
    if (clip_triangle(triangle, polygon).value() != Clip::cut) return;
    const std::vector<Rows> vertices = split(polygon, row);
    RC_ASSERT(vertices.size() <= static_cast<std::size_t>(max_clipped_vertices));
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
        Rows part = vertices[0];
        part.insert(part.end(), vertices[i].begin(), vertices[i].end());
        part.insert(part.end(), vertices[i + 1].begin(), vertices[i + 1].end());
        RC_ASSERT(clip_triangle(part, again).value() == Clip::inside);
        RC_ASSERT(again == part);
    }
}

TEST(ClipTriangle, C4TheClippedIsNotClippedAgain) {
    EXPECT_TRUE(rc::check("clipped polygons lie in the volume", [](std::uint64_t seed) {
        base::Random random(seed);
        for (int k = 0; k < 50; ++k) {
            const std::size_t attributes = random.below(3);
            expect_not_clipped_again(any_triangle(random, attributes), 4 + attributes);
        }
    }));
}

TEST(ClipTriangle, BadRowsAreErrors) {
    Rows polygon{7};
    Rows triangle(12, 0.5);
    triangle[7] = std::numeric_limits<double>::quiet_NaN();
    const Result<Clip> bad = clip_triangle(triangle, polygon);
    ASSERT_FALSE(bad);
    EXPECT_NE(bad.error().message().find("number 3 of vertex 1"), std::string::npos) << bad.error().message();
    EXPECT_FALSE(clip_triangle(Rows(9, 1), polygon));
    EXPECT_FALSE(clip_triangle(Rows(13, 1), polygon));
    EXPECT_FALSE(clip_triangle(Rows{}, polygon));
    EXPECT_EQ(polygon, Rows{7});
}

/// The part of the segment within bounds n.x + o >= 0, in rationals: from and to.
std::vector<RationalRow> judge_segment(const Rows& a, const Rows& b, const std::vector<HalfSpace>& bounds, int d) {
    Rational from(0), to(1);
    for (const HalfSpace& h : bounds) {
        Rational at_a(h.offset), at_b(h.offset);
        for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
            at_a += Rational(h.normal[k]) * Rational(a[k]);
            at_b += Rational(h.normal[k]) * Rational(b[k]);
        }
        if (at_a < Rational(0) && at_b < Rational(0)) return {};
        if (at_a >= Rational(0) && at_b >= Rational(0)) continue;
        const Rational t = at_a / (at_a - at_b);
        if (at_a < Rational(0)) from = std::max(from, t);
        if (at_b < Rational(0)) to = std::min(to, t);
    }
    if (from > to) return {};
    std::vector<RationalRow> ends(2);
    for (std::size_t k = 0; k < a.size(); ++k) {
        ends[0].push_back(Rational(a[k]) + from * (Rational(b[k]) - Rational(a[k])));
        ends[1].push_back(Rational(a[k]) + to * (Rational(b[k]) - Rational(a[k])));
    }
    return ends;
}

void expect_segment(const ClippedSegment& part, const std::vector<RationalRow>& judged) {
    ASSERT_EQ(part.empty, judged.empty());
    if (part.empty) return;
    for (std::size_t k = 0; k < part.a.size(); ++k) {
        EXPECT_TRUE(is_nearest(part.a[k], judged[0][k]));
        EXPECT_TRUE(is_nearest(part.b[k], judged[1][k]));
    }
}

TEST(ClipSegment, C1C2ByAHalfSpace) {
    base::Random random(3);
    for (int k = 0; k < 5000; ++k) {
        const auto d = static_cast<int>(1 + random.below(3));
        const std::uint64_t kind = random.below(4);
        Rows a, b;
        for (int i = 0; i < d + 2; ++i) a.push_back(any_number(random, kind));
        for (int i = 0; i < d + 2; ++i) b.push_back(any_number(random, kind));
        HalfSpace h;
        for (double& x : h.normal) x = any_number(random, kind);
        h.offset = any_number(random, kind);
        expect_segment(clip_segment(d, a, b, h).value(), judge_segment(a, b, {h}, d));
    }
}

TEST(ClipSegment, C1C2C4ByABox) {
    base::Random random(4);
    std::size_t both = 0;
    for (int k = 0; k < 5000; ++k) {
        const auto d = static_cast<int>(1 + random.below(3));
        const std::uint64_t kind = random.below(4);
        Rows a, b;
        for (int i = 0; i < d + 2; ++i) a.push_back(any_number(random, kind));
        for (int i = 0; i < d + 2; ++i) b.push_back(any_number(random, kind));
        ClipBox box;
        std::vector<HalfSpace> bounds;
        for (std::size_t i = 0; i < 3; ++i) {
            const double x = any_number(random, kind);
            const double y = any_number(random, kind);
            box.min[i] = std::min(x, y);
            box.max[i] = std::max(x, y);
            if (static_cast<int>(i) >= d) continue;
            HalfSpace low, high;
            low.normal[i] = 1;
            low.offset = -box.min[i];
            high.normal[i] = -1;
            high.offset = box.max[i];
            bounds.push_back(low);
            bounds.push_back(high);
        }
        const ClippedSegment part = clip_segment(d, a, b, box).value();
        expect_segment(part, judge_segment(a, b, bounds, d));
        if (part.empty) continue;
        both += part.new_a && part.new_b ? 1U : 0U;
        const ClippedSegment again = clip_segment(d, part.a, part.b, box).value();
        EXPECT_FALSE(again.empty || again.new_a || again.new_b);
        EXPECT_EQ(again.a, part.a);
        EXPECT_EQ(again.b, part.b);
        // From the other end: the same bits.
        const ClippedSegment turned = clip_segment(d, b, a, box).value();
        EXPECT_EQ(turned.a, part.b);
        EXPECT_EQ(turned.b, part.a);
    }
    EXPECT_GT(both, 100U);
}

TEST(ClipSegment, TheSourcesExample) {
    // C at a quarter of the way from A to B: V_C = W_A V_A + (1 - W_A) V_B with W_A = 3/4.
    const Rows a{0, 0, 10}, b{4, 8, 20};
    const ClippedSegment part = clip_segment(2, a, b, HalfSpace{{1, 0, 0}, -1}).value();
    EXPECT_TRUE(part.new_a);
    EXPECT_FALSE(part.new_b);
    EXPECT_EQ(part.a, (Rows{1, 2, 12.5}));
    EXPECT_EQ(part.b, b);
}

TEST(ClipSegment, PointsAndInfiniteBoxes) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    const Rows a{0, 0}, b{2, 2};
    const ClippedSegment touch = clip_segment(2, a, b, HalfSpace{{1, 0, 0}, -2}).value();
    EXPECT_FALSE(touch.empty);
    EXPECT_EQ(touch.a, b);
    EXPECT_EQ(touch.b, b);
    EXPECT_FALSE(clip_segment(2, a, a, ClipBox{{0, 0, 0}, {0, 0, 0}}).value().empty);
    EXPECT_TRUE(clip_segment(2, a, a, ClipBox{{1, 0, 0}, {2, 0, 0}}).value().empty);
    EXPECT_EQ(clip_segment(2, a, b, ClipBox{{-inf, -inf, 0}, {inf, 1, 0}}).value().b, (Rows{1, 1}));
    EXPECT_TRUE(clip_segment(2, a, b, ClipBox{{inf, 0, 0}, {inf, 1, 0}}).value().empty);
    EXPECT_TRUE(clip_segment(2, a, b, ClipBox{{3, 0, 0}, {1, 1, 0}}).value().empty);
}

TEST(ClipSegment, BadInputIsAnError) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(clip_segment(4, Rows(4, 0.0), Rows(4, 1.0), HalfSpace{}));
    EXPECT_FALSE(clip_segment(0, Rows(4, 0.0), Rows(4, 1.0), HalfSpace{}));
    EXPECT_FALSE(clip_segment(2, Rows(3, 0.0), Rows(4, 1.0), HalfSpace{}));
    EXPECT_FALSE(clip_segment(3, Rows(2, 0.0), Rows(2, 1.0), HalfSpace{}));
    EXPECT_FALSE(clip_segment(2, Rows{0, nan}, Rows{1, 1}, HalfSpace{}));
    EXPECT_FALSE(clip_segment(2, Rows{0, 0}, Rows{1, 1}, HalfSpace{{nan, 0, 0}, 0}));
    EXPECT_FALSE(clip_segment(2, Rows{0, 0}, Rows{1, 1}, ClipBox{{0, nan, 0}, {1, 1, 1}}));
}

}  // namespace
}  // namespace barycert
