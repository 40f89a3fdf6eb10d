/* Möller and Trumbore's test on rays, in double, wrong in the way that -DFAULT=... says: for tests/commands/plugin.rs.
 * FAULT=0 is right but for rounding. */
#include "hairline.h"
#include <math.h>
#include <string.h>

uint32_t hairline_abi(void) { return HAIRLINE_ABI; }

const hairline_kernel *hairline_describe(void) {
    static const hairline_kernel kernel = {
        .name = "wrong",
        .source = "tests/kernels/wrong.c",
        .contract = "extent=ray,sides=both,boundary=closed",
        .gives = HAIRLINE_GIVES_T | HAIRLINE_GIVES_UV | HAIRLINE_GIVES_FACING,
    };
    return &kernel;
}

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static void cross(const double *a, const double *b, double *out) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}
static void subtract(const double *a, const double *b, double *out) {
    for (int i = 0; i < 3; i++) out[i] = a[i] - b[i];
}

static void one(const hairline_case_f64 *c, hairline_verdict_f64 *verdict) {
    double edge1[3], edge2[3], p[3], q[3], s[3];
    verdict->hit = 0;
    subtract(c->b, c->a, edge1);
    subtract(c->c, c->a, edge2);
    cross(c->direction, edge2, p);
    double det = dot(edge1, p);
    if (det == 0) return;
    subtract(c->origin, c->a, s);
    double u = dot(s, p) / det;
    cross(s, edge1, q);
    double v = dot(c->direction, q) / det, t = dot(edge2, q) / det;
    if (FAULT != 8 && (u < 0 || u > 1 || v < 0 || u + v > 1)) return;
    if (t < 0) return;
    verdict->hit = 1;
    verdict->facing = (det > 0) != (FAULT == 5) ? HAIRLINE_FRONT : HAIRLINE_BACK;
    verdict->t = t;
    verdict->u = u;
    verdict->v = v;
    switch (FAULT) {
    case 1: verdict->t = 2 * t + 1; break;                          /* scaled */
    case 2: verdict->t = t + 2 * dot(s, c->direction) / dot(c->direction, c->direction); break; /* another root */
    case 3: verdict->u = v; verdict->v = u; break;                  /* exchanged */
    case 4: verdict->u = 1 - u - v; break;                          /* w for u */
    case 6: verdict->t = t * sqrt(dot(c->direction, c->direction)); break; /* of the unit direction */
    case 7: verdict->t = NAN; break;
    case 10: verdict->t = t + 1e-9; break;                          /* off by an epsilon */
    }
}

void hairline_test_f64(const hairline_case_f64 *cases, size_t count, const double *epsilons,
                       hairline_verdict_f64 *verdicts) {
    (void)epsilons;
    for (size_t i = 0; i < count; i++) {
        /* 9: the answer to the call before, where there was one. */
        if (FAULT == 9 && i > 0 && i % 8 == 0) verdicts[i] = verdicts[i - 1];
        else one(&cases[i], &verdicts[i]);
    }
}
