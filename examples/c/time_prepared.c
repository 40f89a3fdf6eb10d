/* Nanoseconds a test of hairline_prepared.h, beside Moeller and Trumbore's test as published and hairline_exact.h.
 *
 *     cc -O3 -march=native -I../../include -o time_prepared time_prepared.c -lm && ./time_prepared
 *
 * 1,024 rays, each at a triangle of its own, which are made ready before. Each time is the least of 400 runs over all of them. */
#define _POSIX_C_SOURCE 199309L
#include <hairline_prepared.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define COUNT 1024
#define RUNS 400

static double now(void) {
    struct timespec at;
    clock_gettime(CLOCK_MONOTONIC, &at);
    return (double)at.tv_sec * 1e9 + (double)at.tv_nsec;
}

static double uniform(void) { return rand() / (RAND_MAX + 1.0); }

/* A multiple of 1/256 within 2, so that sums of few of them are not rounded. */
static double coordinate(void) { return floor(1024 * uniform() - 512) / 256; }

#define SCALAR(REAL, SUFFIX, EPSILON, FABS)                                                                                     \
    typedef struct {                                                                                                            \
        REAL o[3], d[3], a[3], b[3], c[3];                                                                                      \
    } case_##SUFFIX;                                                                                                            \
    static case_##SUFFIX cases_##SUFFIX[COUNT];                                                                                 \
    static hairline_triangle_##SUFFIX triangles_##SUFFIX[COUNT];                                                                \
    static hairline_ray_##SUFFIX rays_##SUFFIX[COUNT];                                                                          \
                                                                                                                                \
    static int moller_trumbore_##SUFFIX(const case_##SUFFIX *k, REAL *t, REAL *u, REAL *v) {                                    \
        const REAL *d = k->d;                                                                                                   \
        REAL e1[3], e2[3], s[3], p[3], q[3], det, inverse;                                                                      \
        int i;                                                                                                                  \
        for (i = 0; i < 3; i++) e1[i] = k->b[i] - k->a[i], e2[i] = k->c[i] - k->a[i], s[i] = k->o[i] - k->a[i];                 \
        p[0] = d[1] * e2[2] - d[2] * e2[1], p[1] = d[2] * e2[0] - d[0] * e2[2], p[2] = d[0] * e2[1] - d[1] * e2[0];             \
        det = e1[0] * p[0] + e1[1] * p[1] + e1[2] * p[2];                                                                       \
        if (FABS(det) < EPSILON) return 0;                                                                                      \
        inverse = 1 / det;                                                                                                      \
        *u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) * inverse;                                                               \
        if (*u < 0 || *u > 1) return 0;                                                                                         \
        q[0] = s[1] * e1[2] - s[2] * e1[1], q[1] = s[2] * e1[0] - s[0] * e1[2], q[2] = s[0] * e1[1] - s[1] * e1[0];             \
        *v = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) * inverse;                                                               \
        if (*v < 0 || *u + *v > 1) return 0;                                                                                    \
        *t = (e2[0] * q[0] + e2[1] * q[1] + e2[2] * q[2]) * inverse;                                                            \
        return *t >= 0;                                                                                                         \
    }                                                                                                                           \
                                                                                                                                \
    /* A share of rays that hit, and of those that meet the middle of an edge exactly. */                                       \
    static void make_##SUFFIX(double hits, double edges) {                                                                      \
        int n, i;                                                                                                               \
        for (n = 0; n < COUNT; n++) {                                                                                           \
            case_##SUFFIX *k = &cases_##SUFFIX[n];                                                                              \
            int is_edge = uniform() < edges, is_hit = uniform() < hits;                                                         \
            double x = is_edge ? 0.5 : is_hit ? 0.125 + 0.25 * uniform() : 1.5 * uniform();                                     \
            double y = is_edge ? 0.5 : is_hit ? 0.125 + 0.25 * uniform() : -0.25 - uniform();                                   \
            for (i = 0; i < 3; i++) {                                                                                           \
                double a = coordinate(), b = coordinate(), c = coordinate(), away = coordinate();                               \
                double target = a + x * (b - a) + y * (c - a);                                                                  \
                k->a[i] = (REAL)a, k->b[i] = (REAL)b, k->c[i] = (REAL)c;                                                        \
                k->o[i] = (REAL)(target + away), k->d[i] = (REAL)-away;                                                         \
            }                                                                                                                   \
            hairline_prepare_triangle_##SUFFIX(&triangles_##SUFFIX[n], k->a, k->b, k->c);                                       \
            hairline_prepare_ray_##SUFFIX(&rays_##SUFFIX[n], k->o, k->d);                                                       \
        }                                                                                                                       \
    }                                                                                                                           \
                                                                                                                                \
    static void line_##SUFFIX(const char *name, double hits, double edges) {                                                    \
        double least[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};                                                                       \
        int run, kind, n, found[3] = {0, 0, 0};                                                                                 \
        make_##SUFFIX(hits, edges);                                                                                             \
        for (run = 0; run < RUNS; run++)                                                                                        \
            for (kind = 0; kind < 3; kind++) {                                                                                  \
                double start = now(), took;                                                                                     \
                volatile double sum = 0;                                                                                        \
                REAL t = 0, u, v;                                                                                               \
                hairline_answer answer = {0, 0, 0, 0, 0, 0};                                                                    \
                found[kind] = 0;                                                                                                \
                for (n = 0; n < COUNT; n++) {                                                                                   \
                    const case_##SUFFIX *k = &cases_##SUFFIX[n];                                                                \
                    int hit;                                                                                                    \
                    if (kind == 0)                                                                                              \
                        hit = moller_trumbore_##SUFFIX(k, &t, &u, &v);                                                          \
                    else if (kind == 1)                                                                                         \
                        hit = hairline_hit_##SUFFIX(&triangles_##SUFFIX[n], &rays_##SUFFIX[n], 0, HUGE_VAL, &answer);           \
                    else                                                                                                        \
                        hit = hairline_exact_##SUFFIX(k->o, k->d, k->a, k->b, k->c, 0, HUGE_VAL, &answer);                      \
                    if (hit) sum = sum + (kind == 0 ? t : answer.t), found[kind]++;                                             \
                }                                                                                                               \
                took = (now() - start) / COUNT;                                                                                 \
                if (took < least[kind]) least[kind] = took;                                                                     \
            }                                                                                                                   \
        printf("%-4s %-26s %8.1f %8.1f (%.2f) %8.1f (%.2f)   hits %d %d %d\n", #SUFFIX, name, least[0], least[1],               \
               least[1] / least[0], least[2], least[2] / least[0], found[0], found[1], found[2]);                               \
    }                                                                                                                           \
                                                                                                                                \
    /* Each ray at the eight triangles from its own on: one by one as published, and as a leaf. */                              \
    static hairline_leaf_##SUFFIX leaves_##SUFFIX[COUNT - HAIRLINE_LEAF];                                                       \
    static void leaf_##SUFFIX(const char *name, double hits) {                                                                  \
        double least[2] = {HUGE_VAL, HUGE_VAL};                                                                                 \
        int run, kind, n, i, found[2] = {0, 0};                                                                                 \
        make_##SUFFIX(hits, 0);                                                                                                 \
        for (n = 0; n < COUNT - HAIRLINE_LEAF; n++)                                                                             \
            hairline_prepare_leaf_##SUFFIX(&leaves_##SUFFIX[n], &triangles_##SUFFIX[n], HAIRLINE_LEAF);                         \
        for (run = 0; run < RUNS; run++)                                                                                        \
            for (kind = 0; kind < 2; kind++) {                                                                                  \
                double start = now(), took;                                                                                     \
                volatile double sum = 0;                                                                                        \
                found[kind] = 0;                                                                                                \
                for (n = 0; n < COUNT - HAIRLINE_LEAF; n++) {                                                                   \
                    case_##SUFFIX k = cases_##SUFFIX[n];                                                                        \
                    REAL t, u, v, first = (REAL)HUGE_VAL;                                                                       \
                    hairline_answer answer;                                                                                     \
                    int nearest = -1;                                                                                           \
                    if (kind == 1) {                                                                                            \
                        nearest = hairline_nearest_##SUFFIX(&leaves_##SUFFIX[n], &rays_##SUFFIX[n], 0, (REAL)HUGE_VAL, &answer); \
                        if (nearest >= 0) sum = sum + answer.t;                                                                 \
                    } else {                                                                                                    \
                        for (i = 0; i < HAIRLINE_LEAF; i++) {                                                                   \
                            const case_##SUFFIX *at = &cases_##SUFFIX[n + i];                                                   \
                            memcpy(k.a, at->a, sizeof k.a), memcpy(k.b, at->b, sizeof k.b), memcpy(k.c, at->c, sizeof k.c);     \
                            if (moller_trumbore_##SUFFIX(&k, &t, &u, &v) && t < first) first = t, nearest = i;                  \
                        }                                                                                                       \
                        if (nearest >= 0) sum = sum + first;                                                                    \
                    }                                                                                                           \
                    found[kind] += nearest >= 0;                                                                                \
                }                                                                                                               \
                took = (now() - start) / (COUNT - HAIRLINE_LEAF) / HAIRLINE_LEAF;                                               \
                if (took < least[kind]) least[kind] = took;                                                                     \
            }                                                                                                                   \
        printf("%-4s %-26s %8.1f %8.1f (%.2f)   hits %d %d\n", #SUFFIX, name, least[0], least[1], least[1] / least[0], found[0], \
               found[1]);                                                                                                       \
    }

SCALAR(float, f32, 1e-6f, fabsf)
SCALAR(double, f64, 1e-6, fabs)

int main(void) {
    printf("%-31s %8s %15s %15s\n", "nanoseconds a test", "plain", "prepared", "exact");
    line_f32("inside", 1, 0), line_f64("inside", 1, 0);
    line_f32("beside", 0, 0), line_f64("beside", 0, 0);
    line_f32("1 hit in 10", 0.1, 0), line_f64("1 hit in 10", 0.1, 0);
    line_f32("the same, 1 edge in 400", 0.1, 0.0025), line_f64("the same, 1 edge in 400", 0.1, 0.0025);
    printf("\nnanoseconds a triangle of a leaf of %d\n", HAIRLINE_LEAF);
    leaf_f32("no hit of its own", 0), leaf_f64("no hit of its own", 0);
    leaf_f32("1 hit of its own in 10", 0.1), leaf_f64("1 hit of its own in 10", 0.1);
    return 0;
}
