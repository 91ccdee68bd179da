// Embree: a ray along z through the point meets the triangle in the plane z = 0; its u and v are two of the weights, in
// float32. Where the ray misses, Embree has no weights: NaN.
#include <embree3/rtcore.h>

#include <limits>

#include "library.hpp"

namespace {

RTCDevice device() {
    static const RTCDevice made = rtcNewDevice("threads=1,set_affinity=0");
    return made;
}

}  // namespace

extern "C" void barycert_kernel_describe(struct barycert_kernel_info* info) {
    barycert::libraries::describe(info, "embree-" RTC_VERSION_STRING ".ray", "triangle",
                                  "u and v of a ray along z, in float32; the first weight is 1 - u - v",
                                  "rtcIntersect1, RTC_SCENE_FLAG_ROBUST", true);
}

extern "C" int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
    const RTCScene scene = rtcNewScene(device());
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const corners = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3));
    auto* const triangle = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 1));
    for (unsigned i = 0; i < 3; ++i) {
        corners[3 * i] = static_cast<float>(vertices[2 * i]);
        corners[3 * i + 1] = static_cast<float>(vertices[2 * i + 1]);
        corners[3 * i + 2] = 0;
        triangle[i] = i;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(point[0]);
    ray.ray.org_y = static_cast<float>(point[1]);
    ray.ray.org_z = 1;
    ray.ray.dir_z = -1;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &ray);
    rtcReleaseScene(scene);
    const bool hit = ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    weights[1] = hit ? ray.hit.u : std::numeric_limits<double>::quiet_NaN();
    weights[2] = hit ? ray.hit.v : std::numeric_limits<double>::quiet_NaN();
    weights[0] = 1 - weights[1] - weights[2];
    return 0;
}
