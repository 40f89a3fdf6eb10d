/* What guarded kernels cost in C: nanoseconds a ray beside Moeller and Trumbore's test as published, each inlined into a loop over
 * the same rays.
 *
 *     hairline repair --scalar f32,f64 --emit c -o FOLDER/
 *     cc -O3 -march=native -IFOLDER -o times times.c -lm && ./times
 *
 * A time is the least of ROUNDS, because a busy machine only adds to it. */
#define _POSIX_C_SOURCE 200809L
#include "moller_trumbore_f32.h"
#include "moller_trumbore_f64.h"
#include "woop_watertight_f32.h"

#include <stdint.h>
#include <stdio.h>
#include <time.h>

#define RAYS 65536
#define ROUNDS 60

static uint64_t state = 1;

/* Uniform in [-1, 1]. */
static double uniform(void) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(int64_t)state / 9223372036854775808.0;
}

/* T. Moeller and B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997, without culling. */
#define PUBLISHED(name, real, size)                                                                             \
    static inline int name(const real *o, const real *d, const real *a, const real *b, const real *c, real *t) { \
        real e[3], f[3], s[3], p[3], q[3], det, inverse, u, v;                                                  \
        int i;                                                                                                  \
        for (i = 0; i < 3; i++) e[i] = b[i] - a[i], f[i] = c[i] - a[i], s[i] = o[i] - a[i];                     \
        p[0] = d[1] * f[2] - d[2] * f[1], p[1] = d[2] * f[0] - d[0] * f[2], p[2] = d[0] * f[1] - d[1] * f[0];   \
        det = e[0] * p[0] + e[1] * p[1] + e[2] * p[2];                                                          \
        if (size(det) < (real)1e-6) return 0;                                                                   \
        inverse = 1 / det;                                                                                      \
        u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) * inverse;                                                \
        if (u < 0 || u > 1) return 0;                                                                           \
        q[0] = s[1] * e[2] - s[2] * e[1], q[1] = s[2] * e[0] - s[0] * e[2], q[2] = s[0] * e[1] - s[1] * e[0];   \
        v = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) * inverse;                                                \
        if (v < 0 || u + v > 1) return 0;                                                                       \
        *t = (f[0] * q[0] + f[1] * q[1] + f[2] * q[2]) * inverse;                                               \
        return 1;                                                                                               \
    }
PUBLISHED(plain_f32, float, fabsf)
PUBLISHED(plain_f64, double, fabs)

/* Runs a kernel on all rays; the sum of its answers and distances, so that all are computed. */
#define LOOP(name, real, hit_type, call)                                          \
    static double name(const real *rays) {                                        \
        double sum = 0;                                                           \
        int i;                                                                    \
        for (i = 0; i < RAYS; i++) {                                              \
            const real *o = rays + 15 * i, *d = o + 3, *a = o + 6, *b = o + 9, *c = o + 12; \
            hit_type hit;                                                         \
            const int answer = call;                                              \
            sum += answer == 1 ? hit.t : answer;                                  \
        }                                                                         \
        return sum;                                                               \
    }
typedef struct {
    float t;
} plain_hit_f32;
typedef struct {
    double t;
} plain_hit_f64;
LOOP(run_plain_f32, float, plain_hit_f32, plain_f32(o, d, a, b, c, &hit.t))
LOOP(run_guarded_f32, float, moller_trumbore_f32_hit, moller_trumbore_f32(o, d, a, b, c, 0, HUGE_VALF, &hit))
LOOP(run_woop_f32, float, woop_watertight_f32_hit, woop_watertight_f32(o, d, a, b, c, 0, HUGE_VALF, &hit))
LOOP(run_plain_f64, double, plain_hit_f64, plain_f64(o, d, a, b, c, &hit.t))
LOOP(run_guarded_f64, double, moller_trumbore_f64_hit, moller_trumbore_f64(o, d, a, b, c, 0, HUGE_VAL, &hit))

static double now(void) {
    struct timespec at;
    clock_gettime(CLOCK_MONOTONIC, &at);
    return (double)at.tv_sec * 1e9 + (double)at.tv_nsec;
}

static volatile double kept;

/* The least time of a call, in nanoseconds a ray. */
#define TIME(run, rays)                                  \
    do {                                                 \
        double least = HUGE_VAL;                         \
        int round;                                       \
        for (round = 0; round < ROUNDS; round++) {       \
            const double start = now();                  \
            double taken;                                \
            kept = run(rays);                            \
            taken = (now() - start) / RAYS;              \
            if (taken < least) least = taken;            \
        }                                                \
        printf(" %17.1f", least);                        \
    } while (0)

/* Triangles in the unit cube, and rays through the point with the weights 1-u-v, u and v. */
static void draw(int is_inside, float *singles, double *doubles) {
    int i, k;
    for (i = 0; i < RAYS; i++) {
        float *x = singles + 15 * i;
        double u = (uniform() + 1) / 2, v = (uniform() + 1) / 2 * (1 - u);
        if (!is_inside) u = 2 * uniform() - 0.7, v = uniform() < 0 ? -u - (uniform() + 1) / 2 : 1.5 - u;
        for (k = 0; k < 9; k++) x[6 + k] = (float)uniform();
        for (k = 0; k < 3; k++) {
            const double point = x[6 + k] + u * (x[9 + k] - x[6 + k]) + v * (x[12 + k] - x[6 + k]);
            x[k] = (float)(4 * uniform());
            x[3 + k] = (float)(point - x[k]);
        }
        for (k = 0; k < 15; k++) doubles[15 * i + k] = x[k];
    }
}

int main(void) {
    static float singles[15 * RAYS];
    static double doubles[15 * RAYS];
    int is_inside;
    printf("%-8s %17s %17s %17s %17s %17s\n", "rays", "plain f32", "guarded f32", "guarded Woop f32", "plain f64", "guarded f64");
    for (is_inside = 1; is_inside >= 0; is_inside--) {
        draw(is_inside, singles, doubles);
        printf("%-8s", is_inside ? "inside" : "beside");
        TIME(run_plain_f32, singles);
        TIME(run_guarded_f32, singles);
        TIME(run_woop_f32, singles);
        TIME(run_plain_f64, doubles);
        TIME(run_guarded_f64, doubles);
        printf("\n");
    }
    return 0;
}
