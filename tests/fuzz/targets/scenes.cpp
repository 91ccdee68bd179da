// Scenes of triangles in JSON; small ones are drawn.
#include "barycert/scene.hpp"

#include "tests/fuzz/files.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {
namespace {

/// A picture is as large as its scene says: that is no matter of the reader.
constexpr std::int32_t largest_side = 32;
constexpr std::size_t most_triangles = 12;

}  // namespace

BARYCERT_FUZZ_TARGET(scenes, {std::size_t{8} << 20, 512}) {
    static InputFile file("in.json");
    const std::string& path = file.put(input);
    scene_files(path);
    const Result<Scene> scene = read_scene(path);
    if (!scene) return expect_useful(scene.error(), lines_of(input));
    if (scene->size.width > largest_side || scene->size.height > largest_side ||
        scene->triangles.size() > 3 * most_triangles)
        return;
    RenderCounts counts;
    const Result<Image> image = render(*scene, &counts);
    if (!image) return expect(!image.error().what.empty(), "an error that does not say what");
    expect(bool(check_image(*image)), "a picture that is none was drawn");
    expect(image->width == scene->size.width && image->height == scene->size.height, "a picture of another size");
    expect(counts.drawn + counts.outside + counts.degenerate + counts.between_pixels == counts.triangles,
           "triangles that became of nothing");
}

}  // namespace barycert::fuzz
