/// From vertices to pixels: triangles with attributes, cameras, textures, a picture.
///
/// The way of a triangle: object coordinates -> clip space (one matrix) -> clipped to -w <= x, y, z <= w -> divided by
/// w -> window -> the pixels that it covers (raster.hpp, R1) -> of several triangles at a pixel the one with the lowest
/// depth, of equal ones the first -> the attributes there -> colour.
///
/// Conventions, those of OpenGL: clip space is left-handed, z/w = -1 is the near end and 1 the far end; x = -w, y = -w
/// is the lower left corner of the window; matrices act on columns. Depths are z/w, interpolated linearly in the
/// window.
///
/// A colour is three numbers from 0 to 1 in sRGB as it is stored, and is interpolated in this form. A number below 0 is
/// drawn as 0, a number above 1 as 1. If there are both, a texture's colour is multiplied by the vertices' colour.
/// Nothing is blended: a pixel gets the opacity of its texel.
///
/// Example:
///
///     const Scene scene = read_scene("scene.json").value();
///     write_png("scene.png", render(scene).value()).value();
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/weights.hpp"

namespace barycert {

using Vector3 = std::array<double, 3>;

/// Entry of row r, column c is m[4 * r + c].
struct Matrix4 {
    std::array<double, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

    /// First b, then a. In double.
    friend Matrix4 operator*(const Matrix4& a, const Matrix4& b);
    friend bool operator==(const Matrix4&, const Matrix4&) = default;
};

// Cameras. Numbers that are not finite, or that give no camera, are an Error; so are matrices that overflow. Tangent
// and sine are those of the C library: matrices may differ in their last bits from machine to machine.

/// From the world to the eye: x to the right, y up, looking along -z. Error: eye and centre, or up and the direction of
/// sight, give no direction.
Result<Matrix4> look_at(const Vector3& eye, const Vector3& centre, const Vector3& up);

/// From the eye to clip space: `fovy` in degrees is the angle of sight from the lower to the upper rim, above 0 and
/// below 180; aspect is width / height; 0 < near < far are distances along the direction of sight.
Result<Matrix4> perspective(double fovy, double aspect, double near, double far);

/// The box left <= x <= right, bottom <= y <= top, near <= -z <= far, each pair of different numbers.
Result<Matrix4> orthographic(double left, double right, double bottom, double top, double near, double far);

/// Turns about an axis by degrees, counter-clockwise seen from its tip. Error: the axis has no direction.
Result<Matrix4> rotation(const Vector3& axis, double degrees);
Matrix4 translation(const Vector3& by);
Matrix4 scaling(const Vector3& by);

/// From x, y, w of clip space to window coordinates: ((x / w + 1) * width / 2, (y / w + 1) * height / 2); NaN unless w
/// is above zero and all are finite. With `correct` each is the exact number rounded once, else each operation is
/// rounded. Within the clip volume no point is moved off the window: rounding is monotonic.
std::array<double, 2> viewport(RasterSize size, double x, double y, double w, Rounding rounding = Rounding::correct);

/// How attributes are interpolated between vertices.
enum class Interpolation : std::uint8_t {
    perspective,  ///< v = (v/w) / (1/w), both linear in the window: linear on the triangle before the projection
    affine,       ///< linear in the window: right if w is the same at all vertices, else the usual fault
    projected_z,  ///< as perspective with (z/w + 1) / 2, the depth in the window, in place of w: another usual fault
};

inline constexpr int max_samples = 8;

struct Scene {
    RasterSize size;
    /// Samples of a pixel across and up, 1 to max_samples: its colour is the mean of theirs in linear light, weighted
    /// with the opacity. Each sample is covered as R1 says of a pixel of a finer raster.
    int samples = 1;
    Rgba background{255, 255, 255, 255};
    std::vector<double> positions;            ///< x, y, z, w of each vertex; w is 1 for a point
    std::vector<double> colours;              ///< red, green, blue of each vertex, or empty
    std::vector<double> texture_coordinates;  ///< u, v of each vertex, or empty
    std::vector<std::int32_t> triangles;      ///< three vertices each
    Matrix4 to_clip;                          ///< projection * view * model
    std::optional<Texture> texture;           ///< needs texture_coordinates
    FillMethod method = FillMethod::barycentric;
    Interpolation interpolation = Interpolation::perspective;
    /// `correct`: positions in clip space, window coordinates, depths and attributes are each the exact function of
    /// what they are computed from, rounded once. With FillMethod::barycentric; not with Interpolation::projected_z.
    Rounding rounding = Rounding::plain;
};

/// Counts of what became of the triangles and of the pixels, or of the samples where pixels have several. drawn +
/// outside + degenerate + between_pixels is `triangles`.
struct RenderCounts {
    std::uint64_t triangles = 0;
    std::uint64_t drawn = 0;           ///< cover a pixel's centre, if perhaps behind others
    std::uint64_t outside = 0;         ///< nothing of them lies in the clip volume
    std::uint64_t degenerate = 0;      ///< have no area in the window: exactly zero, or seen edge-on (Clip::at_eye)
    std::uint64_t between_pixels = 0;  ///< too small or thin to cover a pixel's centre
    std::uint64_t clipped = 0;         ///< of all: cut by the clip volume
    std::uint64_t covered = 0;         ///< pixels covered by triangles, counted once a triangle
    std::uint64_t hidden = 0;          ///< of these: behind what was drawn before
    std::uint64_t pixels = 0;          ///< of the picture that show a triangle

    friend bool operator==(const RenderCounts&, const RenderCounts&) = default;
};

/// Draws the scene; without triangles it is its background. `counts`: if given, set. `attributes`: if given, set to
/// what colours were made of: at each pixel red, green, blue (if the scene has colours), then u, v (if it has texture
/// coordinates); NaN where no triangle is. For one sample a pixel. A NaN in a colour, which only projected_z gives, is
/// drawn as 0. Error: a size that is refused (also: more than max_image_pixels); arrays or choices that do not fit
/// together; an index out of range; a number that is not finite, or not in clip space.
Result<Image> render(const Scene& scene, RenderCounts* counts = nullptr, PixelValues* attributes = nullptr);

/// Reads a scene from a JSON file; doc/rendering.md describes its members. Files that it names are relative to its
/// folder. Returns an Error that names the member by its JSON pointer, or the line where the text is no JSON.
Result<Scene> read_scene(const std::string& path);

/// Paths of the files that a scene file names, for a program that must not overwrite them. Empty if it cannot be read.
std::vector<std::string> scene_files(const std::string& path);

}  // namespace barycert
