/* hairline_prepared.h: does a ray hit a triangle? The right answer for every finite float and double, at about the price of Moeller
 * and Trumbore's test, with triangles and rays that are made ready once.
 *
 *     hairline_triangle_f32 triangle;   once for each triangle
 *     hairline_prepare_triangle_f32(&triangle, a, b, c);
 *     hairline_ray_f32 ray;             once for each ray
 *     hairline_prepare_ray_f32(&ray, origin, direction);
 *     if (hairline_hit_f32(&triangle, &ray, t_min, t_max, &answer)) ...
 *     hairline_leaf_f32 leaf;           once for each leaf of a tree: up to 8 triangles, tested at a time
 *     hairline_prepare_leaf_f32(&leaf, &triangles[first], count);
 *     place = hairline_nearest_f32(&leaf, &ray, t_min, t_max, &answer);
 *
 * and the same with f64. It needs hairline_exact.h beside it, in C99, C++17 or CUDA, and answers as that does: HAIRLINE_EDGES, ends
 * that count, -ffast-math refused, subnormal numbers not flushed. Numbers are computed in double.
 *
 * Why this is right (docs/design/margin.md has the proof): with s = a-o and N = (b-a)x(a-c), the weights of b, c and a times d.N are
 * U = (s x d).(a-c), V = (s x d).(b-a) and W = d.N - U - V. Whatever a compiler contracts, none of them is off by more than
 * 9.25 u |d| ((e+f) (|o|+|a|) + e f) with e and f the lengths of a-c and b-a: two factors of the triangle times two of the ray, made
 * once. Beyond that margin their signs decide. Within it, at an end, and for numbers out of range hairline_exact_f32 is asked.
 */
#ifndef HAIRLINE_PREPARED_H
#define HAIRLINE_PREPARED_H

#include "hairline_exact.h"

#if defined(__clang__) && !defined(__CUDACC__)
#pragma float_control(push)
#pragma float_control(precise, on)
#endif

/* The most triangles of a leaf, which are tested at a time; at most 32. */
#ifndef HAIRLINE_LEAF
#define HAIRLINE_LEAF 8
#endif

#define HP_ROUNDING 0x1.28p-50 /* 9.25 u */
#define HP_LEAST 0x1p-506      /* its square is more than underflow can add */
#define HP_LARGEST 0x1p280     /* coordinates and lengths up to which no product overflows */
#define HP_FAR 0x1p128         /* an end beyond this counts as this, and proves no miss */
#define HP_SHARE 0x1p-25       /* the largest margin by det with which t, u and v are taken as computed */

HAIRLINE_FUNCTION double hp_dot(const double x[3], const double y[3]) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

/* The length, at least, where no square overflows. */
HAIRLINE_FUNCTION double hp_length(const double x[3]) { return sqrt(hp_dot(x, x)) + HP_LEAST; }

HAIRLINE_FUNCTION void hp_cross(double out[3], const double x[3], const double y[3]) {
    out[0] = x[1] * y[2] - x[2] * y[1];
    out[1] = x[2] * y[0] - x[0] * y[2];
    out[2] = x[0] * y[1] - x[1] * y[0];
}

/* The lesser and the larger one; the second if either is NaN. */
HAIRLINE_FUNCTION double hp_lesser(double x, double y) { return x < y ? x : y; }
HAIRLINE_FUNCTION double hp_larger(double x, double y) { return x > y ? x : y; }

/* What a triangle needs besides its corners, in double for both scalars: a, a-c, b-a, N, the factors of its margins, and
 * |a|, at least. */
typedef struct {
    double a[3], ca[3], ab[3], n[3], edges, area, depth, far;
} hp_triangle;

/* The same of a ray: its vectors, and |d|, |d| |o| and |o|, at least. */
typedef struct {
    double o[3], d[3], speed, reach, far;
} hp_ray;

HAIRLINE_FUNCTION double hp_margin(int is_open, double rounding, double least) {
    return is_open ? HUGE_VAL : HP_ROUNDING * rounding + HP_LEAST * least;
}

HAIRLINE_FUNCTION void hp_prepare_triangle(hp_triangle *k, const double a[3], const double b[3], const double c[3]) {
    double e, f, far, longest, sum, product, whole;
    int i, is_open;
    for (i = 0; i < 3; i++) {
        k->a[i] = hx_stored(a[i]);
        k->ab[i] = hx_stored(b[i]) - k->a[i];
        k->ca[i] = k->a[i] - hx_stored(c[i]);
    }
    hp_cross(k->n, k->ab, k->ca);
    e = hp_length(k->ab), f = hp_length(k->ca), far = hp_length(k->a);
    longest = hp_larger(e, f), sum = e + f, product = e * f, whole = 1 + longest;
    is_open = !(longest <= HP_LARGEST && far <= HP_LARGEST);
    k->edges = hp_margin(is_open, sum, whole);
    k->area = hp_margin(is_open, product + sum * far, whole * (whole + far));
    k->far = far;
    k->depth = hp_margin(is_open, product, whole * whole);
}

HAIRLINE_FUNCTION void hp_prepare_ray(hp_ray *r, const double o[3], const double d[3]) {
    double far, length;
    int i, is_open;
    for (i = 0; i < 3; i++) r->o[i] = hx_stored(o[i]), r->d[i] = hx_stored(d[i]);
    far = hp_length(r->o), length = hp_length(r->d);
    is_open = !(far <= HP_LARGEST && length <= HP_LARGEST);
    r->speed = is_open ? HUGE_VAL : length + HP_LEAST * (1 + length);
    r->far = far + HP_LEAST * (1 + r->speed);
    r->reach = is_open ? HUGE_VAL : r->speed * far;
}

/* 1 for a hit, 0 for a miss, 2 to ask. */
HAIRLINE_FUNCTION int hp_decide(const hp_triangle *k, const hp_ray *r, double t_min, double t_max, hairline_answer *answer) {
    double s[3], moment[3], u, v, w, det, low, high, x, margin;
    double t, size, along, from, to, past, before, lengths, past_margin, before_margin, inverse;
    int i;
    for (i = 0; i < 3; i++) s[i] = k->a[i] - r->o[i];
    hp_cross(moment, s, r->d);
    u = hp_dot(moment, k->ca), v = hp_dot(moment, k->ab), det = hp_dot(r->d, k->n), w = det - u - v;
    /* W is NaN wherever one of them is, and is what each of these comparisons then takes. */
    low = hp_lesser(hp_lesser(u, v), w);
    high = -hp_larger(hp_larger(u, v), w);
    x = hp_larger(low, high);
    margin = k->edges * r->reach + k->area * r->speed;
    if (x < -margin) return 0;
    if (!(x > margin)) return 2;
    size = fabs(det), t = hp_dot(s, k->n), along = det > 0 ? t : -t;
    from = t_min < -HP_FAR ? -HP_FAR : t_min, to = HP_FAR < t_max ? HP_FAR : t_max;
    /* How far t is past the start and before the end, times |det|. */
    past = along - from * size, before = to * size - along;
    lengths = k->far + r->far;
    past_margin = k->depth * (lengths + fabs(from) * r->speed);
    before_margin = k->depth * (lengths + fabs(to) * r->speed);
    if (past > past_margin && before > before_margin && size * HP_SHARE > margin) {
        inverse = 1 / det;
        answer->hit = 1, answer->front = det > 0, answer->asked = 0;
        answer->t = t * inverse;
        /* U, V and W are above 9 u |det|, so 0 < u, 0 < v and u + v < 1 for the rounded ones too. */
        answer->u = u * inverse;
        answer->v = v * inverse;
        return 1;
    }
    if (past < -past_margin && from == t_min) return 0;
    if (before < -before_margin && to == t_max) return 0;
    return 2;
}

/* Triangles side by side, as vectors of a processor hold them. */
typedef struct {
    double a[3][HAIRLINE_LEAF], ca[3][HAIRLINE_LEAF], ab[3][HAIRLINE_LEAF], n[3][HAIRLINE_LEAF];
    double edges[HAIRLINE_LEAF], area[HAIRLINE_LEAF];
} hp_lanes;

HAIRLINE_FUNCTION void hp_set_lane(hp_lanes *lanes, int lane, const hp_triangle *k) {
    int i;
    for (i = 0; i < 3; i++) {
        lanes->a[i][lane] = k->a[i], lanes->ca[i][lane] = k->ca[i];
        lanes->ab[i][lane] = k->ab[i], lanes->n[i][lane] = k->n[i];
    }
    lanes->edges[lane] = k->edges, lanes->area[lane] = k->area;
}

/* The numbers of hp_decide in each lane: a bit for each triangle that the ray does not surely miss. */
HAIRLINE_FUNCTION unsigned hp_left(const hp_lanes *k, const hp_ray *r) {
    const double *o = r->o, *d = r->d;
    double past[HAIRLINE_LEAF];
    unsigned left = 0;
    int i;
    for (i = 0; i < HAIRLINE_LEAF; i++) {
        double sx = k->a[0][i] - o[0], sy = k->a[1][i] - o[1], sz = k->a[2][i] - o[2];
        double mx = sy * d[2] - sz * d[1], my = sz * d[0] - sx * d[2], mz = sx * d[1] - sy * d[0];
        double u = mx * k->ca[0][i] + my * k->ca[1][i] + mz * k->ca[2][i];
        double v = mx * k->ab[0][i] + my * k->ab[1][i] + mz * k->ab[2][i];
        double w = d[0] * k->n[0][i] + d[1] * k->n[1][i] + d[2] * k->n[2][i] - u - v;
        double low = hp_lesser(hp_lesser(u, v), w), high = -hp_larger(hp_larger(u, v), w);
        /* NaN where a number is. */
        past[i] = hp_larger(low, high) + (k->edges[i] * r->reach + k->area[i] * r->speed);
    }
    for (i = 0; i < HAIRLINE_LEAF; i++) left |= (unsigned)!(past[i] < 0) << i;
    return left;
}

#define HP_SCALAR(REAL, SUFFIX, LARGEST)                                                                                                \
    typedef struct {                                                                                                           \
        hp_triangle numbers;                                                                                                   \
        REAL corners[3][3];                                                                                                    \
    } hairline_triangle_##SUFFIX;                                                                                              \
                                                                                                                               \
    typedef struct {                                                                                                           \
        hp_ray numbers;                                                                                                        \
    } hairline_ray_##SUFFIX;                                                                                                   \
                                                                                                                               \
    HAIRLINE_FUNCTION void hairline_prepare_triangle_##SUFFIX(hairline_triangle_##SUFFIX *triangle, const REAL a[3],           \
                                                              const REAL b[3], const REAL c[3]) {                              \
        double points[3][3];                                                                                                   \
        int i;                                                                                                                 \
        for (i = 0; i < 3; i++) {                                                                                              \
            triangle->corners[0][i] = a[i], triangle->corners[1][i] = b[i], triangle->corners[2][i] = c[i];                    \
            points[0][i] = a[i], points[1][i] = b[i], points[2][i] = c[i];                                                     \
        }                                                                                                                      \
        hp_prepare_triangle(&triangle->numbers, points[0], points[1], points[2]);                                              \
    }                                                                                                                          \
                                                                                                                               \
    HAIRLINE_FUNCTION void hairline_prepare_ray_##SUFFIX(hairline_ray_##SUFFIX *ray, const REAL o[3], const REAL d[3]) {       \
        double vectors[2][3];                                                                                                  \
        int i;                                                                                                                 \
        for (i = 0; i < 3; i++) vectors[0][i] = o[i], vectors[1][i] = d[i];                                                    \
        hp_prepare_ray(&ray->numbers, vectors[0], vectors[1]);                                                                 \
    }                                                                                                                          \
                                                                                                                               \
    HAIRLINE_SELDOM int hp_ask_##SUFFIX(const hairline_triangle_##SUFFIX *triangle, const hp_ray *r, REAL t_min, REAL t_max,   \
                                        hairline_answer *answer) {                                                             \
        REAL o[3], d[3];                                                                                                       \
        int i;                                                                                                                 \
        for (i = 0; i < 3; i++) o[i] = (REAL)r->o[i], d[i] = (REAL)r->d[i];                                                    \
        return hairline_exact_##SUFFIX(o, d, triangle->corners[0], triangle->corners[1], triangle->corners[2], t_min, t_max,   \
                                       answer);                                                                                \
    }                                                                                                                          \
                                                                                                                               \
    /* 1 for a hit with t_min <= t <= t_max, 0 for a miss, which leaves *answer as it was. */                                  \
    HAIRLINE_FUNCTION int hairline_hit_##SUFFIX(const hairline_triangle_##SUFFIX *triangle, const hairline_ray_##SUFFIX *ray,  \
                                                REAL t_min, REAL t_max, hairline_answer *answer) {                             \
        switch (hp_decide(&triangle->numbers, &ray->numbers, t_min, t_max, answer)) {                                          \
        case 0: return 0;                                                                                                      \
        case 1:                                                                                                                \
            answer->t = hx_within(answer->t, hx_larger(t_min, -LARGEST), t_max < LARGEST ? t_max : LARGEST);                   \
            return 1;                                                                                                          \
        default: return hp_ask_##SUFFIX(triangle, &ray->numbers, t_min, t_max, answer);                                        \
        }                                                                                                                      \
    }                                                                                                                          \
                                                                                                                               \
    /* Triangles of a leaf: their lanes, and where they are themselves. */                                                     \
    typedef struct {                                                                                                           \
        hp_lanes lanes;                                                                                                        \
        const hairline_triangle_##SUFFIX *triangles;                                                                           \
        int count;                                                                                                             \
    } hairline_leaf_##SUFFIX;                                                                                                  \
                                                                                                                               \
    /* From count triangles, HAIRLINE_LEAF at most, which stay where they are. */                                              \
    HAIRLINE_FUNCTION void hairline_prepare_leaf_##SUFFIX(hairline_leaf_##SUFFIX *leaf,                                        \
                                                          const hairline_triangle_##SUFFIX *triangles, int count) {            \
        int i;                                                                                                                 \
        memset(leaf, 0, sizeof *leaf);                                                                                         \
        leaf->triangles = triangles, leaf->count = count < HAIRLINE_LEAF ? count : HAIRLINE_LEAF;                              \
        for (i = 0; i < leaf->count; i++) hp_set_lane(&leaf->lanes, i, &triangles[i].numbers);                                 \
    }                                                                                                                          \
                                                                                                                               \
    /* The place of the triangle that is hit with the least t, or -1, which leaves *answer as it was. */                       \
    HAIRLINE_FUNCTION int hairline_nearest_##SUFFIX(const hairline_leaf_##SUFFIX *leaf, const hairline_ray_##SUFFIX *ray,      \
                                                    REAL t_min, REAL t_max, hairline_answer *answer) {                         \
        unsigned left = hp_left(&leaf->lanes, &ray->numbers);                                                                  \
        hairline_answer found;                                                                                                 \
        double least = 0;                                                                                                      \
        int i, nearest = -1;                                                                                                   \
        for (i = 0; i < leaf->count && left != 0; i++, left >>= 1) {                                                           \
            if (!(left & 1u) || !hairline_hit_##SUFFIX(&leaf->triangles[i], ray, t_min, t_max, &found)) continue;              \
            if (nearest < 0 || found.t < least) nearest = i, least = found.t, *answer = found;                                 \
        }                                                                                                                      \
        return nearest;                                                                                                        \
    }

HP_SCALAR(float, f32, FLT_MAX)
#ifndef HAIRLINE_ONLY_F32
HP_SCALAR(double, f64, DBL_MAX)
#endif

#if defined(__clang__) && !defined(__CUDACC__)
#pragma float_control(pop)
#endif

#endif
