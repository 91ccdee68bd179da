// What lies inside a closed surface, what is nearest on it, and where a segment leaves it.

#include <barycert/check.hpp>
#include <barycert/surface_files.hpp>
#include <barycert/surface_locator.hpp>

#include <cstdio>
#include <limits>

using namespace barycert;

int main() {
    const Surface surface = read_surface("data/plc/torus.off").value();
    const CheckReport report = check_surface(surface);
    std::printf("%s, volume %.17g\n", report.certified() ? "certified" : "not certified",
                report.surface->regions[0].volume);

    const SurfaceLocator locator = SurfaceLocator::build(surface).value();
    const double point[3] = {0.9, 0.5, 0.125}, beyond[3] = {3, 0.5, 0.125};
    const SurfaceLocation place = locator.locate(point).value();
    const SurfaceNearest nearest = locator.nearest(point, std::numeric_limits<double>::infinity()).value();
    std::printf("%s, winding number %d\n", name(place.feature).data(), place.winding);
    std::printf("triangle %d, distance %.17g, at (%.17g, %.17g, %.17g)\n", nearest.cell, nearest.distance,
                nearest.point[0], nearest.point[1], nearest.point[2]);
    const std::vector<SurfaceHit> hits = locator.hits(point, beyond).value();
    for (const SurfaceHit& hit : hits)
        std::printf("triangle %d at %.17g, %s\n", hit.triangle, hit.parameter, hit.side > 0 ? "out" : "in");
}
