/* Moller and Trumbore's test (1997, the branch without culling) as a library for hairline:
 * cc -O2 -shared -fPIC -I../../include -o libmoller_trumbore.so moller_trumbore.c */
#include "hairline.h"
#include <math.h>

uint32_t hairline_abi(void) { return HAIRLINE_ABI; }

const hairline_kernel *hairline_describe(void) {
    static const hairline_epsilon epsilons[] = {
        {"parallel", "1e-6", "abs(det) < e", 2, 1, 1, 0},
    };
    static const hairline_kernel kernel = {
        .name = "c-moller-trumbore",
        .source = "Moller and Trumbore (1997), appendix, in C",
        .contract = "extent=line,sides=both,boundary=closed",
        .gives = HAIRLINE_GIVES_T | HAIRLINE_GIVES_UV | HAIRLINE_GIVES_FACING,
        .epsilon_count = 1,
        .epsilons = epsilons,
    };
    return &kernel;
}

/* One function for each scalar, from the same text. */
#define KERNEL(REAL, SUFFIX, ABS)                                                                  \
    static REAL dot_##SUFFIX(const REAL *a, const REAL *b) {                                       \
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];                                            \
    }                                                                                              \
    static void cross_##SUFFIX(const REAL *a, const REAL *b, REAL *out) {                          \
        out[0] = a[1] * b[2] - a[2] * b[1];                                                        \
        out[1] = a[2] * b[0] - a[0] * b[2];                                                        \
        out[2] = a[0] * b[1] - a[1] * b[0];                                                        \
    }                                                                                              \
    static void subtract_##SUFFIX(const REAL *a, const REAL *b, REAL *out) {                       \
        for (int i = 0; i < 3; i++) out[i] = a[i] - b[i];                                          \
    }                                                                                              \
    static void one_##SUFFIX(const hairline_case_##SUFFIX *c, REAL epsilon,                        \
                             hairline_verdict_##SUFFIX *verdict) {                                 \
        REAL edge1[3], edge2[3], p[3], q[3], s[3];                                                 \
        verdict->hit = 0;                                                                          \
        subtract_##SUFFIX(c->b, c->a, edge1);                                                      \
        subtract_##SUFFIX(c->c, c->a, edge2);                                                      \
        cross_##SUFFIX(c->direction, edge2, p);                                                    \
        REAL det = dot_##SUFFIX(edge1, p);                                                         \
        if (ABS(det) < epsilon) return;                                                            \
        REAL inverse = 1 / det;                                                                    \
        subtract_##SUFFIX(c->origin, c->a, s);                                                     \
        REAL u = dot_##SUFFIX(s, p) * inverse;                                                     \
        if (u < 0 || u > 1) return;                                                                \
        cross_##SUFFIX(s, edge1, q);                                                               \
        REAL v = dot_##SUFFIX(c->direction, q) * inverse;                                          \
        if (v < 0 || u + v > 1) return;                                                            \
        verdict->hit = 1;                                                                          \
        verdict->facing = det > 0 ? HAIRLINE_FRONT : HAIRLINE_BACK;                                \
        verdict->t = dot_##SUFFIX(edge2, q) * inverse;                                             \
        verdict->u = u;                                                                            \
        verdict->v = v;                                                                            \
    }                                                                                              \
    void hairline_test_##SUFFIX(const hairline_case_##SUFFIX *cases, size_t count,                 \
                                const REAL *epsilons, hairline_verdict_##SUFFIX *verdicts) {       \
        for (size_t i = 0; i < count; i++) one_##SUFFIX(&cases[i], epsilons[0], &verdicts[i]);     \
    }

KERNEL(float, f32, fabsf)
KERNEL(double, f64, fabs)
