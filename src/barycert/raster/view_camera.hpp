/// Cameras that fit what is to be seen.
#pragma once

#include <span>

#include "barycert/result.hpp"
#include "barycert/scene.hpp"

namespace barycert::raster {

/// The axes of a camera: to the right and up in the picture, and towards the viewer. Unit vectors.
struct ViewAxes {
    Vector3 right, up, towards;
};

/// Angles as in ViewOptions, finite.
ViewAxes view_axes(double azimuth, double elevation);

/// Points moved and scaled so that the middle of their box is the origin and its longest side 2. Precondition: finite;
/// `dimension` coordinates each, of which the results have three.
std::vector<double> normalised_points(std::span<const double> points, int dimension);

/// The camera that sees all points, in perspective, as near as the window allows. Precondition: normalised points.
Result<Matrix4> fitting_camera(std::span<const double> points, const ViewAxes& axes, double aspect);

/// The same from above, without perspective.
Result<Matrix4> fitting_map(std::span<const double> points, double aspect);

}  // namespace barycert::raster
