// Clipping, textures, cameras and scenes: the same answers in every floating-point environment.
#include "barycert/figure.hpp"

#include "barycert/raster.hpp"
#include "core/base/random.hpp"
#include "tests/core/same_everywhere.hpp"

namespace barycert {
namespace {

using testing_environments::Answers;
using testing_environments::expect_same_everywhere;

/// Ordinary numbers and subnormal ones, which flushing would change.
double number(base::Random& random, bool tiny) {
    return tiny ? random.integer(-40, 40) * 0x1p-1074 : random.uniform(-2, 2);
}

TEST(EveryEnvironment, Clipping) {
    std::vector<std::vector<double>> triangles;
    base::Random random(1);
    for (int k = 0; k < 200; ++k) {
        std::vector<double> rows;
        for (int i = 0; i < 15; ++i) rows.push_back(number(random, k % 2 == 0));
        triangles.push_back(rows);
    }
    expect_same_everywhere("clipping", [&](Answers& out) {
        std::vector<double> polygon;
        for (const std::vector<double>& rows : triangles) {
            out.add(static_cast<int>(clip_triangle(rows, polygon).value()));
            out.add_all(polygon);
            const std::span<const double> all(rows);
            const ClippedSegment part =
                clip_segment(2, all.subspan(0, 5), all.subspan(5, 5), ClipBox{{-1, -1, 0}, {0x1p-1073, 1, 0}}).value();
            out.add_all(part.a);
            out.add_all(part.b);
            const ClippedSegment half = clip_segment(3, all.subspan(0, 5), all.subspan(5, 5),
                                                     HalfSpace{{rows[10], rows[11], rows[12]}, rows[13]})
                                            .value();
            out.add_all(half.a);
            out.add_all(half.b);
        }
    });
}

TEST(EveryEnvironment, Texels) {
    Texture t{four_colours(), Wrap::repeat, Filter::nearest};
    std::vector<double> places{0, 1, 0.5, -0x1p-1074, 0x1p-1074, 1 - 0x1p-53, 1e300, 1e-310, -3.7};
    expect_same_everywhere("texels", [&](Answers& out) {
        for (const Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirror}) {
            for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
                t.wrap = wrap;
                t.filter = filter;
                for (std::size_t i = 0; i < places.size(); ++i) {
                    for (const std::uint8_t x : texel(t, places[i], places[places.size() - 1 - i]))
                        out.add(static_cast<int>(x));
                }
            }
        }
    });
}

TEST(EveryEnvironment, CamerasAndScenes) {
    base::Random random(2);
    Scene scene;
    scene.size = {20, 15};
    for (int v = 0; v < 12; ++v) {
        for (int k = 0; k < 3; ++k) scene.positions.push_back(random.uniform(-1, 1));
        scene.positions.push_back(1);
        for (int k = 0; k < 2; ++k) scene.texture_coordinates.push_back(random.uniform(-1, 2));
        for (int k = 0; k < 3; ++k) scene.colours.push_back(random.unit());
        scene.triangles.push_back(v);
    }
    scene.texture = Texture{four_colours(), Wrap::mirror, Filter::bilinear};
    expect_same_everywhere("cameras and scenes", [&](Answers& out) {
        const Matrix4 view = look_at({1, 2, 3}, {0, 0.1, 0}, {0, 1, 0}).value();
        const Matrix4 turned = rotation({1, 1e-310, 2}, 33).value();
        out.add_all(turned.m);
        out.add_all(orthographic(-1, 2, -3, 1, 0.5, 7).value().m);
        scene.to_clip = perspective(70, 4.0 / 3, 2.5, 20).value() * view * turned;
        out.add_all(scene.to_clip.m);
        out.add_all(viewport({30, 20}, 0x1p-1074, 0x1p-1073, 0x1.8p-1072, Rounding::plain));
        out.add_all(viewport({30, 20}, 0x1p-1074, 0x1p-1073, 0x1.8p-1072));
        for (const Rounding rounding : {Rounding::plain, Rounding::correct}) {
            scene.rounding = rounding;
            PixelValues values;
            RenderCounts counts;
            const Image image = render(scene, &counts, &values).value();
            out.add(counts.covered);
            out.add(counts.clipped);
            out.add_all(values.data);
            for (const std::uint8_t x : image.data) out.add(static_cast<int>(x));
        }
    });
}

TEST(EveryEnvironment, Views) {
    const std::vector<double> points{0, 0, 0, 1, 0, 0.2, 0, 1, 0, 0.3, 0.3, 1};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const std::vector<double> values{0x1p-1074, 0x1p-1073, 0, 0x1p-1072};
    expect_same_everywhere("views of surfaces", [&](Answers& out) {
        FigureCounts counts;
        Figure figure;
        figure.surfaces = {{.points = points, .triangles = triangles, .point_values = values}};
        figure.options.size = {160, 100};
        const Image image = draw_figure(figure, &counts).value();
        out.add(counts.low);
        out.add(counts.high);
        for (const std::uint8_t x : image.data) out.add(static_cast<int>(x));
    });
}

}  // namespace
}  // namespace barycert
