#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>

#include "barycert/environment.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/scene.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/text.hpp"
#include "core/base/vectors.hpp"
#include "core/integer.hpp"
#include "core/scaled_double.hpp"

namespace barycert {
namespace {

using base::cross, base::dot;

Error no_camera(const std::string& what, const std::string& expected, const std::string& found) {
    return {
        .code = "argument.value", .what = what, .expected = expected, .found = found, .remedy = "choose other numbers"};
}

std::string text_of(std::span<const double> numbers) {
    return base::joined(numbers, ", ", base::shortest);
}

/// The direction of v with length 1, whatever its length was; nothing if it is zero or not finite.
std::optional<Vector3> direction(const Vector3& v) {
    if (!base::all_finite(v) || v == Vector3{}) return std::nullopt;
    return base::unit(v);
}

/// (x / w + 1) * size / 2 = (x + w) * size / (2 w), rounded once.
double exact_window(double x, double w, std::int32_t size) {
    const core::Unit unit{x, w};
    const core::Integer depth = unit.integer(w), sum = unit.integer(x) + depth;
    return core::round_quotient(sum * core::Integer(false, static_cast<std::uint64_t>(size), 0), depth, -1);
}

Result<Matrix4> finite_matrix(const Matrix4& m, const char* what) {
    if (base::all_finite(m.m)) return m;
    return no_camera(what, "numbers whose matrix does not overflow", "one that does");
}

}  // namespace

Matrix4 operator*(const Matrix4& a, const Matrix4& b) {
    const ExactEnvironment environment;
    Matrix4 product;
    for (std::size_t r = 0; r < 4; ++r) {
        for (std::size_t c = 0; c < 4; ++c) {
            double sum = 0;
            for (std::size_t k = 0; k < 4; ++k) sum += a.m[4 * r + k] * b.m[4 * k + c];
            product.m[4 * r + c] = sum;
        }
    }
    return product;
}

Result<Matrix4> look_at(const Vector3& eye, const Vector3& centre, const Vector3& up) {
    const ExactEnvironment environment;
    const auto sight = direction({centre[0] - eye[0], centre[1] - eye[1], centre[2] - eye[2]});
    if (!sight)
        return no_camera("a camera that looks nowhere", "eye and centre that differ, finite",
                         text_of(eye) + " and " + text_of(centre));
    const auto upwards = direction(up);
    // Both are unit vectors, so a product below 2^-50 is mostly rounding error.
    const Vector3 across = upwards ? cross(*sight, *upwards) : Vector3{};
    if (!upwards || dot(across, across) < 0x1p-100)
        return no_camera("a camera that knows no up", "an upwards direction off the direction of sight", text_of(up));
    const Vector3 right = *direction(across), above = cross(right, *sight);
    const auto& [x, y, z] = *sight;
    const Matrix4 m{{right[0], right[1], right[2], -dot(right, eye),  //
                     above[0], above[1], above[2], -dot(above, eye),  //
                     -x, -y, -z, dot(*sight, eye),                    //
                     0, 0, 0, 1}};
    return finite_matrix(m, "a camera too far away");
}

Result<Matrix4> perspective(double fovy, double aspect, double near, double far) {
    const ExactEnvironment environment;
    if (!(fovy > 0 && fovy < 180))
        return no_camera("the angle of sight", "degrees above 0 and below 180", base::shortest(fovy));
    if (!(aspect > 0) || !std::isfinite(aspect))
        return no_camera("the aspect of the window", "a positive number", base::shortest(aspect));
    if (!(near > 0 && near < far) || !std::isfinite(far))
        return no_camera("the depth of sight", "0 < near < far, finite",
                         base::shortest(near) + " and " + base::shortest(far));
    const double scale = 1 / std::tan(fovy * (std::numbers::pi / 360));
    const Matrix4 m{{scale / aspect, 0, 0, 0,                                             //
                     0, scale, 0, 0,                                                      //
                     0, 0, (far + near) / (near - far), 2 * far * (near / (near - far)),  //
                     0, 0, -1, 0}};
    return finite_matrix(m, "the perspective");
}

Result<Matrix4> orthographic(double left, double right, double bottom, double top, double near, double far) {
    const ExactEnvironment environment;
    const std::array<double, 6> all{left, right, bottom, top, near, far};
    if (!base::all_finite(all) || left == right || bottom == top || near == far)
        return no_camera("the box of sight", "three pairs of different finite numbers", text_of(all));
    const double width = right - left, height = top - bottom, depth = far - near;
    const Matrix4 m{{2 / width, 0, 0, -(right + left) / width,    //
                     0, 2 / height, 0, -(top + bottom) / height,  //
                     0, 0, -2 / depth, -(far + near) / depth,     //
                     0, 0, 0, 1}};
    return finite_matrix(m, "the box of sight");
}

Result<Matrix4> rotation(const Vector3& axis, double degrees) {
    const ExactEnvironment environment;
    const auto a = direction(axis);
    if (!a || !std::isfinite(degrees))
        return no_camera("a rotation", "an axis that is not zero and an angle, finite",
                         text_of(axis) + " by " + base::shortest(degrees));
    const double angle = std::fmod(degrees, 360) * (std::numbers::pi / 180), c = std::cos(angle), s = std::sin(angle);
    // The outer product of the axis times 1 - c, and its cross product times s.
    const std::array<double, 9> turned{
        c, -(*a)[2] * s, (*a)[1] * s, (*a)[2] * s, c, -(*a)[0] * s, -(*a)[1] * s, (*a)[0] * s, c};
    Matrix4 m;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) m.m[4 * i + k] = (*a)[i] * (*a)[k] * (1 - c) + turned[3 * i + k];
    }
    return m;
}

Matrix4 translation(const Vector3& by) {
    return {{1, 0, 0, by[0], 0, 1, 0, by[1], 0, 0, 1, by[2], 0, 0, 0, 1}};
}

Matrix4 scaling(const Vector3& by) {
    return {{by[0], 0, 0, 0, 0, by[1], 0, 0, 0, 0, by[2], 0, 0, 0, 0, 1}};
}

std::array<double, 2> viewport(RasterSize size, double x, double y, double w, Rounding rounding) {
    const ExactEnvironment environment;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (!(w > 0) || !base::all_finite(std::array{x, y, w})) return {nan, nan};
    if (rounding == Rounding::correct) return {exact_window(x, w, size.width), exact_window(y, w, size.height)};
    return base::held(std::array<double, 2>{(base::held(x) / base::held(w) + 1) * (0.5 * size.width),
                                            (base::held(y) / base::held(w) + 1) * (0.5 * size.height)});
}

}  // namespace barycert
