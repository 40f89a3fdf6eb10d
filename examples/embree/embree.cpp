// Embree 3 as a library for hairline: each case a scene of one triangle. -DROBUST=1 builds the scene
// in its robust mode. What the manual says of the modes is about neighbouring primitives ("avoiding
// artifacts caused by rays shooting through edges"), so edges themselves are free here, and only the
// robust mode promises that shared ones are not missed.
#include "hairline.h"
#include <embree3/rtcore.h>
#include <cmath>
#include <limits>

#ifndef ROBUST
#define ROBUST 0
#endif

#define WORDS_(x) #x
#define WORDS(x) WORDS_(x)
#define VERSION WORDS(RTC_VERSION_MAJOR) "." WORDS(RTC_VERSION_MINOR) "." WORDS(RTC_VERSION_PATCH)

static void set(float *to, const float *from) {
    for (int i = 0; i < 3; i++) to[i] = from[i];
}

static hairline_verdict_f32 answer(RTCDevice device, const hairline_case_f32 &c) {
    RTCScene scene = rtcNewScene(device);
    if (ROBUST) rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry triangle = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto *vertices = static_cast<float *>(rtcSetNewGeometryBuffer(
        triangle, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3));
    auto *indices = static_cast<unsigned *>(rtcSetNewGeometryBuffer(
        triangle, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 1));
    set(vertices, c.a);
    set(vertices + 3, c.b);
    set(vertices + 6, c.c);
    for (unsigned i = 0; i < 3; i++) indices[i] = i;
    rtcCommitGeometry(triangle);
    rtcAttachGeometry(scene, triangle);
    rtcReleaseGeometry(triangle);
    rtcCommitScene(scene);

    RTCRayHit ray = {};
    ray.ray.org_x = c.origin[0], ray.ray.org_y = c.origin[1], ray.ray.org_z = c.origin[2];
    ray.ray.dir_x = c.direction[0], ray.ray.dir_y = c.direction[1], ray.ray.dir_z = c.direction[2];
    ray.ray.tnear = 0;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0u;
    ray.hit.geomID = ray.hit.primID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
    rtcReleaseScene(scene);

    hairline_verdict_f32 verdict = {};
    verdict.hit = ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    verdict.t = ray.ray.tfar;
    verdict.u = ray.hit.u;
    verdict.v = ray.hit.v;
    return verdict;
}

uint32_t hairline_abi(void) { return HAIRLINE_ABI; }

const hairline_kernel *hairline_describe(void) {
    static const hairline_kernel kernel = {
        ROBUST ? "embree-robust" : "embree-fast",
        ROBUST ? "Embree " VERSION ", rtcIntersect1, RTC_SCENE_FLAG_ROBUST"
               : "Embree " VERSION ", rtcIntersect1, no scene flags",
        ROBUST ? "extent=ray,sides=both,boundary=free,ends=free,coplanar=free,degenerate=free,across=at-least-one"
               : "extent=ray,sides=both,boundary=free,ends=free,coplanar=free,degenerate=free",
        HAIRLINE_GIVES_T | HAIRLINE_GIVES_UV,
        0,
        nullptr,
    };
    return &kernel;
}

void hairline_test_f32(const hairline_case_f32 *cases, size_t count, const float *,
                       hairline_verdict_f32 *verdicts) {
    static RTCDevice device = rtcNewDevice("threads=1");
    for (size_t i = 0; i < count; i++) verdicts[i] = answer(device, cases[i]);
}
