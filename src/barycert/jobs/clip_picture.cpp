// A triangle and segments with colours, before and after they are clipped by a box.

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "barycert/jobs/pictures.hpp"
#include "barycert/raster.hpp"

namespace barycert::jobs {
namespace {

/// x, y, red, green, blue.
using ColouredPoint = std::array<double, 5>;

constexpr std::array<ColouredPoint, 3> triangle{{{-1.5, -0.9, 1, 0, 0}, {1.35, -1.4, 0, 1, 0}, {0.35, 1.6, 0, 0, 1}}};
constexpr std::array<std::array<ColouredPoint, 2>, 4> segments{{
    {{{-1.7, 0.2, 1, 0.6, 0}, {-0.1, 1.7, 0.5, 0, 0.8}}},   // cuts a corner
    {{{-1.6, -1.3, 1, 0.6, 0}, {1.7, 1.25, 0.5, 0, 0.8}}},  // goes through
    {{{0.6, -0.7, 1, 0.6, 0}, {0.85, 0.5, 0.5, 0, 0.8}}},   // inside
    {{{1.2, 1.7, 1, 0.6, 0}, {1.75, -0.4, 0.5, 0, 0.8}}},   // outside
}};
constexpr double half_panel = 1.9;  ///< half the side of a panel

/// Draws into one scene of coloured triangles; later ones in front.
class ClipScene {
public:
    ClipScene(RasterSize size, int panels) : panels_(panels) {
        scene.size = size;
        // Squares beside each other, as large as they fit.
        const double aspect = 1.0 * size.width / size.height, half = std::max(half_panel * panels / aspect, half_panel);
        scene.to_clip = scaling({1 / (half * aspect), 1 / half, 1});
        pixel_ = 2 * half / size.height;
    }

    void panel(int number) {
        left_ = half_panel * (2 * number + 1 - panels_);
        z_ = 0.9;
    }

    void add_triangle(const ColouredPoint& a, const ColouredPoint& b, const ColouredPoint& c) {
        for (const ColouredPoint* p : {&a, &b, &c}) {
            scene.positions.insert(scene.positions.end(), {left_ + (*p)[0], (*p)[1], z_, 1});
            scene.colours.insert(scene.colours.end(), p->begin() + 2, p->end());
            scene.triangles.push_back(static_cast<std::int32_t>(scene.triangles.size()));
        }
        z_ -= 0x1p-8;
    }

    /// A line some pixels wide.
    void add_line(const ColouredPoint& a, const ColouredPoint& b, double pixels) {
        const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
        if (!(length > 0)) return;
        const double part = 0.5 * pixels * pixel_ / length;
        const auto moved = [&](ColouredPoint p, double side) {
            p[0] -= side * part * dy;
            p[1] += side * part * dx;
            return p;
        };
        add_triangle(moved(a, 1), moved(a, -1), moved(b, -1));
        add_triangle(moved(a, 1), moved(b, -1), moved(b, 1));
    }

    void add_box() {
        constexpr double corners[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
        for (std::size_t i = 0; i < 4; ++i)
            add_line({corners[i][0], corners[i][1], 0, 0, 0}, {corners[i + 1][0], corners[i + 1][1], 0, 0, 0}, 2);
    }

    Scene scene;

private:
    int panels_;
    double left_ = 0, z_ = 0, pixel_ = 0;
};

ColouredPoint point_of(const double* row) {
    return {row[0], row[1], row[2], row[3], row[4]};
}

void add_before(ClipScene& s) {
    s.add_triangle(triangle[0], triangle[1], triangle[2]);
    for (const auto& [a, b] : segments) s.add_line(a, b, 4);
    s.add_box();
}

/// The box is that of the clip volume with w = 1.
Status add_after(ClipScene& s) {
    std::vector<double> rows, polygon;
    for (const ColouredPoint& p : triangle) rows.insert(rows.end(), {p[0], p[1], 0, 1, p[2], p[3], p[4]});
    if (const Result<Clip> clip = clip_triangle(rows, polygon); !clip) return clip.error();
    const auto corner = [&](std::size_t i) {
        const double* const row = polygon.data() + 7 * i;
        return ColouredPoint{row[0], row[1], row[4], row[5], row[6]};
    };
    for (std::size_t i = 1; i + 1 < polygon.size() / 7; ++i) s.add_triangle(corner(0), corner(i), corner(i + 1));
    for (const auto& [a, b] : segments) {
        const Result<ClippedSegment> part = clip_segment(2, a, b, ClipBox{{-1, -1, 0}, {1, 1, 0}});
        if (!part) return part.error();
        if (!part->empty) s.add_line(point_of(part->a.data()), point_of(part->b.data()), 4);
    }
    s.add_box();
    return Done{};
}

}  // namespace

Result<Scene> clip_scene(RasterSize size) {
    ClipScene s(size, 2);
    s.panel(0);
    add_before(s);
    s.panel(1);
    if (Status done = add_after(s); !done) return done.error();
    return std::move(s.scene);
}

}  // namespace barycert::jobs
