/* A project's kernel over a year, for tests/commands/action.rs: Moller and Trumbore's test in float, and what
 * becomes of it with -DREFACTORED, -DEPSILON=..., -DEDGE=..., -DWIDE and -DCRASH; with -DBACKWARDS its epsilon is none; with
 * -DASSERTING it ends at a large one. */
#include "hairline.h"
#include <math.h>
#include <stdlib.h>

#ifndef EPSILON
#define EPSILON "1e-7"
#endif

/* How far beside an edge a hit still counts. */
#ifndef EDGE
#define EDGE 0
#endif

#ifdef WIDE
typedef double number;
#else
typedef float number;
#endif

uint32_t hairline_abi(void) { return HAIRLINE_ABI; }

const hairline_kernel *hairline_describe(void) {
    static const hairline_epsilon epsilons[] = {{"parallel", EPSILON, "abs(det) < e", 2, 1, 1, 0}};
    static const hairline_kernel kernel = {
        .name = "mine",
        .contract = "extent=line,sides=both,boundary=closed",
        .gives = HAIRLINE_GIVES_T | HAIRLINE_GIVES_UV,
        .epsilon_count = 1,
        .epsilons = epsilons,
    };
    return &kernel;
}

typedef struct {
    number x, y, z;
} vector;

static vector from(const float *a) { return (vector){a[0], a[1], a[2]}; }

static vector minus(vector a, vector b) { return (vector){a.x - b.x, a.y - b.y, a.z - b.z}; }

#ifdef REFACTORED
static number dot(vector a, vector b) {
    number sum = a.x * b.x;
    sum += a.y * b.y;
    sum += a.z * b.z;
    return sum;
}
#else
static number dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
#endif

static vector cross(vector a, vector b) {
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

void hairline_test_f32(const hairline_case_f32 *cases, size_t count, const float *epsilons,
                       hairline_verdict_f32 *verdicts) {
    for (size_t i = 0; i < count; i++) {
        const hairline_case_f32 *c = &cases[i];
        hairline_verdict_f32 *verdict = &verdicts[i];
        vector edge1 = minus(from(c->b), from(c->a)), edge2 = minus(from(c->c), from(c->a));
        vector direction = from(c->direction), s = minus(from(c->origin), from(c->a));
        vector p = cross(direction, edge2), q = cross(s, edge1);
        number det = dot(edge1, p);
        verdict->hit = 0;
#ifdef CRASH
        if (c->a[0] > 0.995f && c->a[0] < 1) abort();
#endif
#ifdef ASSERTING
        if (epsilons[0] > 1e30f) abort();
#endif
#ifdef BACKWARDS
        if (fabs(det) > epsilons[0]) continue;
#else
        if (fabs(det) < epsilons[0]) continue;
#endif
        number inverse = 1 / det;
        number u = dot(s, p) * inverse, v = dot(direction, q) * inverse;
        if (u < -EDGE || v < -EDGE || u + v > 1 + EDGE) continue;
        *verdict = (hairline_verdict_f32){1, 0, dot(edge2, q) * inverse, u, v};
    }
}
