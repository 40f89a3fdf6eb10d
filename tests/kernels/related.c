/* Möller and Trumbore's test on an interval, in double, with a mistake that a simple relation to the exact values explains:
 * the one that -DMISTAKE=... names, for tests/commands/relations.rs. Without one it is right but for rounding. */
#include "hairline.h"
#include <math.h>

enum mistake {
    NONE, TWICE, HALF, OPPOSITE, LENGTH, SQUARED_LENGTH, OVER_LENGTH, FROM_START, SHARE, CLAMPED, EXCHANGED, W_FOR_U, W_FOR_V,
    OF_AB, OF_CA, IN_F32, PREVIOUS, ABSOLUTE, NO_T_MIN, ZERO_T_MIN, CLAMPED_T_MIN, NO_T_MAX,
    MINUS_ONE, NOT_A_NUMBER, INFINITE, HUGE_T,
    /* No simple relation: */
    AFFINE, SOMETIMES_TWICE, OFF_BY_ULPS,
};

uint32_t hairline_abi(void) { return HAIRLINE_ABI; }

const hairline_kernel *hairline_describe(void) {
    static const hairline_kernel kernel = {
        .name = "related",
        .source = "tests/kernels/related.c",
        .contract = MISTAKE == CLAMPED ? "extent=ray,sides=both,boundary=closed" : "extent=interval,sides=both,boundary=closed",
        .gives = HAIRLINE_GIVES_T | HAIRLINE_GIVES_UV,
    };
    return &kernel;
}

static double rounded(double x) { return MISTAKE == IN_F32 ? (float)x : x; }
static double dot(const double *a, const double *b) {
    double sum = rounded(a[0] * b[0]);
    for (int i = 1; i < 3; i++) sum = rounded(sum + rounded(a[i] * b[i]));
    return sum;
}
static void cross(const double *a, const double *b, double *out) {
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = rounded(rounded(a[j] * b[k]) - rounded(a[k] * b[j]));
    }
}
static void subtract(const double *a, const double *b, double *out) {
    for (int i = 0; i < 3; i++) out[i] = rounded(rounded(a[i]) - rounded(b[i]));
}

static int is_on_interval(const hairline_case_f64 *c, double t) {
    switch (MISTAKE) {
    case ABSOLUTE: return c->t_min <= fabs(t) && fabs(t) <= c->t_max;
    case NO_T_MIN: return t <= c->t_max;
    case ZERO_T_MIN: return 0 <= t && t <= c->t_max;
    case CLAMPED_T_MIN: return fmax(c->t_min, 0) <= t && t <= c->t_max;
    case NO_T_MAX: return c->t_min <= t;
    case CLAMPED: return 0 <= t;
    default: return c->t_min <= t && t <= c->t_max;
    }
}

/* A miss as many functions return it, where hairline asks for hit or miss. */
static void told_as_t(hairline_verdict_f64 *verdict) {
    switch (MISTAKE) {
    case MINUS_ONE: verdict->t = -1; break;
    case NOT_A_NUMBER: verdict->t = NAN; break;
    case INFINITE: verdict->t = INFINITY; break;
    case HUGE_T: verdict->t = 3e38; break;
    default: return;
    }
    verdict->hit = 1;
    verdict->u = verdict->v = 0;
}

static void one(const hairline_case_f64 *c, size_t place, hairline_verdict_f64 *verdict) {
    double edge1[3], edge2[3], p[3], q[3], s[3], d[3];
    verdict->hit = verdict->facing = 0;
    subtract(c->b, c->a, edge1);
    subtract(c->c, c->a, edge2);
    for (int i = 0; i < 3; i++) d[i] = rounded(c->direction[i]);
    cross(d, edge2, p);
    double det = dot(edge1, p);
    if (det == 0) return;
    subtract(c->origin, c->a, s);
    double u = rounded(dot(s, p) / det);
    cross(s, edge1, q);
    double v = rounded(dot(d, q) / det), t = rounded(dot(edge2, q) / det);
    if (!(u >= 0 && v >= 0 && u + v <= 1) || !is_on_interval(c, t)) {
        told_as_t(verdict);
        return;
    }
    double square = dot(c->direction, c->direction), w = 1 - u - v;
    verdict->hit = 1;
    verdict->t = t;
    verdict->u = u;
    verdict->v = v;
    switch (MISTAKE) {
    case TWICE: verdict->t = 2 * t; break;
    case HALF: verdict->t = t / 2; break;
    case OPPOSITE: verdict->t = -t; break;
    case LENGTH: verdict->t = t * sqrt(square); break;
    case SQUARED_LENGTH: verdict->t = t * square; break;
    case OVER_LENGTH: verdict->t = t / sqrt(square); break;
    case FROM_START: verdict->t = t - c->t_min; break;
    case SHARE: verdict->t = (t - c->t_min) / (c->t_max - c->t_min); break;
    case CLAMPED: verdict->t = fmin(t, c->t_max); break;
    case EXCHANGED: verdict->u = v; verdict->v = u; break;
    case W_FOR_U: verdict->u = w; break;
    case W_FOR_V: verdict->v = w; break;
    case OF_AB: verdict->u = w; verdict->v = u; break;
    case OF_CA: verdict->u = v; verdict->v = w; break;
    case ABSOLUTE: verdict->t = fabs(t); break;
    case OFF_BY_ULPS: verdict->t = t * (1 + 0x1p-50); verdict->u = u * (1 + 0x1p-50); break;
    case AFFINE: verdict->t = 2 * t + 1; break;
    case SOMETIMES_TWICE: verdict->t = place % 4 == 0 ? 2 * t : t + 1; break;
    default: break;
    }
}

void hairline_test_f64(const hairline_case_f64 *cases, size_t count, const double *epsilons,
                       hairline_verdict_f64 *verdicts) {
    (void)epsilons;
    for (size_t i = 0; i < count; i++) {
        if (MISTAKE == PREVIOUS && i % 8 == 7) verdicts[i] = verdicts[i - 1];
        else one(&cases[i], i, &verdicts[i]);
    }
}
