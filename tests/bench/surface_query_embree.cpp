#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "surface_query_peers.hpp"

namespace barycert::bench {
namespace {

using Vector = std::array<double, 3>;

Vector minus(const double* a, const double* b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The square of the distance in doubles: Embree finds boxes in floats, and leaves the triangle to its user.
double distance_to(const double* p, const double* a, const double* b, const double* c) {
    const Vector e = minus(b, a), f = minus(c, a), w = minus(p, a);
    const double d1 = dot(e, w), d2 = dot(f, w), ee = dot(e, e), ef = dot(e, f), ff = dot(f, f);
    const double s = d1 * ff - d2 * ef, t = d2 * ee - d1 * ef, det = ee * ff - ef * ef;
    const auto at = [&](double x, double y) {
        const Vector r{w[0] - x * e[0] - y * f[0], w[1] - x * e[1] - y * f[1], w[2] - x * e[2] - y * f[2]};
        return dot(r, r);
    };
    if (s >= 0 && t >= 0 && s + t <= det) return at(s / det, t / det);
    const auto unit = [](double x) { return std::clamp(x, 0.0, 1.0); };
    const double r = unit((d2 - d1 - ef + ee) / (ee - 2 * ef + ff));
    return std::min({at(unit(d1 / ee), 0), at(0, unit(d2 / ff)), at(1 - r, r)});
}

struct Query {
    const Surface* surface;
    const double* point;
    double best = 0;
    std::int64_t triangle = -1;
};

bool look(RTCPointQueryFunctionArguments* args) {
    Query& query = *static_cast<Query*>(args->userPtr);
    const auto corner = [&](int i) {
        return &query.surface->points[3 * static_cast<std::size_t>(query.surface->cells[3 * args->primID + i])];
    };
    const double square = distance_to(query.point, corner(0), corner(1), corner(2));
    if (square >= query.best) return false;
    query.best = square;
    query.triangle = args->primID;
    args->query->radius = std::nextafter(static_cast<float>(std::sqrt(square)), std::numeric_limits<float>::infinity());
    return true;
}

struct Scene {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    ~Scene() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

}  // namespace

QueryPeers embree_peers(const Surface& surface) {
    const auto scene = std::make_shared<Scene>();
    RTCGeometry geometry = rtcNewGeometry(scene->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const points = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), surface.points.size() / 3));
    std::copy(surface.points.begin(), surface.points.end(), points);
    auto* const cells = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), surface.cells.size() / 3));
    std::copy(surface.cells.begin(), surface.cells.end(), cells);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene->scene);
    QueryPeers peers;
    peers.nearest.push_back({"Embree rtcPointQuery", [scene, &surface](const auto& at, auto& answers, auto& distances) {
                                 for (std::size_t i = 0; i < answers.size(); ++i) {
                                     Query one{&surface, &at[3 * i], std::numeric_limits<double>::infinity(), -1};
                                     RTCPointQuery query{
                                         static_cast<float>(at[3 * i]), static_cast<float>(at[3 * i + 1]),
                                         static_cast<float>(at[3 * i + 2]), 0, std::numeric_limits<float>::infinity()};
                                     RTCPointQueryContext context;
                                     rtcInitPointQueryContext(&context);
                                     rtcPointQuery(scene->scene, &query, &context, look, &one);
                                     answers[i] = one.triangle;
                                     distances[i] = std::sqrt(one.best);
                                 }
                             }});
    return peers;
}

}  // namespace barycert::bench
