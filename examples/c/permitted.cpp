// A kernel whose operations give results that WGSL permits (permitted.hpp), as a library for hairline:
//     c++ -O2 -std=c++17 -shared -fPIC -I../../include -o libpermitted.so permitted.cpp
//     hairline audit --kernel-lib ./libpermitted.so --scalar f32
// It is Möller and Trumbore's test; -DWOOP is Woop, Benthin and Wald's. A kernel that says hit, miss or ask:
//     hairline repair --kernel moller-trumbore --scalar f32 --emit c -o guarded.h
//     c++ ... -I. -DGUARDED='"guarded.h"' -DTEST=moller_trumbore_f32 -DASK=1 permitted.cpp
// where ASK says what an answer of ask counts as: 1 a hit, so that each false miss of the closed triangle is a wrong answer
// of the kernel; 0 a miss, so that each false hit of the open one is. Other answers: PERMITTED_SEED=2 in the environment; 0 rounds as IEEE 754.
#include "hairline.h"
#include "permitted.hpp"
#include <cstdio>
#include <cstdlib>
#include <string>

#ifndef EXTENT
#define EXTENT "line"
#endif
#ifdef GUARDED
#define NAME "guarded-permitted"
// What asks counts as a hit, so edges have to be hits: the closed triangle. As a miss: the open one.
#define BOUNDARY (ASK ? "closed" : "open")
#define float permitted
#include GUARDED
#define ANSWER_(test) test##_hit
#define ANSWER(test) ANSWER_(test)

static bool meets(const float o[3], const float d[3], const float a[3], const float b[3], const float c[3], float t_min,
                  float t_max) {
    ANSWER(TEST) hit;
    const int answer = TEST(o, d, a, b, c, t_min, t_max, &hit);
    return answer == HAIRLINE_HIT || (answer == HAIRLINE_ASK && ASK);
}
#undef float
#else
#define BOUNDARY "closed"
#define float permitted

static void subtract(const float a[3], const float b[3], float out[3]) {
    for (int i = 0; i < 3; i++) out[i] = a[i] - b[i];
}

#ifdef WOOP
#define NAME "woop-permitted"
// Watertight Ray/Triangle Intersection (2013), appendix A, without the fallback in double, which WGSL does not have.
static bool meets(const float o[3], const float d[3], const float a[3], const float b[3], const float c[3], float, float) {
    int kz = 0;
    for (int i = 1; i < 3; i++)
        if (fabsf(d[i]) > fabsf(d[kz])) kz = i;
    int kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    if (d[kz] < 0) kx = (kz + 2) % 3, ky = (kz + 1) % 3;
    const float sx = d[kx] / d[kz], sy = d[ky] / d[kz];
    const float *vertices[] = {a, b, c};
    float x[3], y[3];
    for (int i = 0; i < 3; i++) {
        float vertex[3];
        subtract(vertices[i], o, vertex);
        x[i] = vertex[kx] - sx * vertex[kz];
        y[i] = vertex[ky] - sy * vertex[kz];
    }
    const float u = x[2] * y[1] - y[2] * x[1], v = x[0] * y[2] - y[0] * x[2], w = x[1] * y[0] - y[1] * x[0];
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
    return u + v + w != 0;
}
#else
#define NAME "moller-trumbore-permitted"
static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const float a[3], const float b[3], float out[3]) {
    out[0] = a[1] * b[2] - b[1] * a[2];
    out[1] = a[2] * b[0] - b[2] * a[0];
    out[2] = a[0] * b[1] - b[0] * a[1];
}

// Fast, Minimum Storage Ray/Triangle Intersection (1997), appendix, without culling.
static bool meets(const float o[3], const float d[3], const float a[3], const float b[3], const float c[3], float, float) {
    float edge1[3], edge2[3], p[3], q[3], s[3];
    subtract(b, a, edge1);
    subtract(c, a, edge2);
    cross(d, edge2, p);
    const float det = dot(edge1, p);
    if (det > -1e-6f && det < 1e-6f) return false;
    const float inverse = 1.0f / det;
    subtract(o, a, s);
    const float u = dot(s, p) * inverse;
    if (u < 0 || u > 1) return false;
    cross(s, edge1, q);
    const float v = dot(d, q) * inverse;
    return !(v < 0 || u + v > 1);
}
#endif
#undef float
#endif

extern "C" {
uint32_t hairline_abi(void) { return HAIRLINE_ABI; }

const hairline_kernel *hairline_describe(void) {
    static hairline_kernel kernel = {};
    kernel.name = NAME;
    kernel.source = "examples/c/permitted.cpp";
    static const std::string contract = std::string("extent=" EXTENT ",sides=both,boundary=") + BOUNDARY;
    kernel.contract = contract.c_str();
    if (const char *seed = std::getenv("PERMITTED_SEED")) {
        char *end;
        permitted::seed() = std::strtoull(seed, &end, 10);
        if (*seed == 0 || *end != 0) {
            std::fprintf(stderr, "PERMITTED_SEED=%s: no number\n", seed);
            std::exit(2);
        }
    }
    return &kernel;
}

static void convert(const float *from, permitted to[3]) {
    for (int i = 0; i < 3; i++) to[i] = from[i];
}

void hairline_test_f32(const hairline_case_f32 *cases, size_t count, const float *, hairline_verdict_f32 *verdicts) {
    for (size_t i = 0; i < count; i++) {
        permitted o[3], d[3], a[3], b[3], c[3];
        convert(cases[i].origin, o);
        convert(cases[i].direction, d);
        convert(cases[i].a, a);
        convert(cases[i].b, b);
        convert(cases[i].c, c);
        verdicts[i] = {};
        verdicts[i].hit = meets(o, d, a, b, c, cases[i].t_min, cases[i].t_max);
    }
}
}

#ifdef CHECK
// Answers lines of an operation and the bits of two numbers with the bits of the result, for a test.
#include <cinttypes>

static float of_bits(uint32_t bits) {
    float number;
    std::memcpy(&number, &bits, sizeof number);
    return number;
}

int main() {
    hairline_describe();
    char operation;
    uint32_t x, y, z;
    while (std::scanf(" %c %" SCNx32 " %" SCNx32 " %" SCNx32, &operation, &x, &y, &z) == 4) {
        const permitted a = of_bits(x), b = of_bits(y), c = of_bits(z);
        const permitted result = operation == '+' ? a + b : operation == '*' ? a * b : operation == '/' ? a / b : a * b + c;
        uint32_t bits;
        std::memcpy(&bits, &result.value, sizeof bits);
        std::printf("%" PRIx32 "\n", bits);
    }
}
#endif
