/* hairline_exact.h: does a ray hit a triangle? The right answer for every finite float and double.
 *
 * One file without dependencies, in C99, C++17 and CUDA. Plain arithmetic decides where it provably can. The signs that it leaves open
 * come from what its roundings leave out, or else from sums of doubles that are not rounded; integers decide what else is left.
 *
 * HAIRLINE_ONLY_F32, defined before you include this file, leaves hairline_exact_f64 out: then the integers are short, and 4 KB of
 * stack are enough instead of 23.
 *
 * Edges: before you include this file, you may define HAIRLINE_EDGES as
 *   HAIRLINE_ONCE    a ray through an edge or a vertex where triangles meet hits exactly one of them (the default):
 *                    the ray counts as if it were moved by less than any number, always in the same direction
 *   HAIRLINE_CLOSED  it hits all of them
 *   HAIRLINE_OPEN    it hits none
 *
 * A ray that lies in the plane of the triangle misses it, and so does every ray a triangle without area. A number that is
 * not finite is a miss (but both ends may be infinite). The ends of the ray count: t_min <= t <= t_max, exactly. Subnormal
 * numbers must not be flushed to zero.
 *
 * Why this is right (docs/guide/exact.md has the derivation): with A, B, C the corners minus the origin, the ray's line passes
 * inside where U = d.(CxB), V = d.(AxC) and W = d.(BxA) have one sign, and t = A.(CxB) / (U + V + W). A number computed from
 * products in at most 8 roundings is wrong by less than 2^-49 times the sum of the sizes of its terms, whatever the compiler
 * contracts. Below 2^290 nothing overflows, and all that underflows is less than the margin that is added.
 */
#ifndef HAIRLINE_EXACT_H
#define HAIRLINE_EXACT_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* None is 0, which is what the preprocessor takes an unknown name for. */
#define HAIRLINE_ONCE 1
#define HAIRLINE_CLOSED 2
#define HAIRLINE_OPEN 3
#ifndef HAIRLINE_EDGES
#define HAIRLINE_EDGES HAIRLINE_ONCE
#endif
#if HAIRLINE_EDGES != HAIRLINE_ONCE && HAIRLINE_EDGES != HAIRLINE_CLOSED && HAIRLINE_EDGES != HAIRLINE_OPEN
#error "hairline_exact.h: HAIRLINE_EDGES is HAIRLINE_ONCE, HAIRLINE_CLOSED or HAIRLINE_OPEN"
#endif
#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "hairline_exact.h: -ffast-math changes results: compile without it, and without its parts"
#endif
/* 16, 32 and 64 are about types narrower than double. */
#if FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 16 && FLT_EVAL_METHOD != 32 && FLT_EVAL_METHOD != 64
#error "hairline_exact.h: doubles are computed with more than 53 bits: compile with -msse2 -mfpmath=sse, or the like"
#endif

/* Clang does not tell of parts of -ffast-math: none of them holds in this file. */
#if defined(__clang__) && !defined(__CUDACC__)
#pragma float_control(push)
#pragma float_control(precise, on)
#endif

/* CUDA compiles these functions for both sides. */
#ifndef HAIRLINE_FUNCTION
#ifdef __CUDACC__
#define HAIRLINE_FUNCTION static __host__ __device__ inline
#else
#define HAIRLINE_FUNCTION static inline
#endif
#endif

/* After this a compiler no longer knows how x was computed. */
#ifndef HAIRLINE_BARRIER
#if (defined(__GNUC__) || defined(__clang__)) && defined(__SSE2__)
#define HAIRLINE_BARRIER(type, x) __asm__("" : "+x"(x))
#elif (defined(__GNUC__) || defined(__clang__)) && defined(__aarch64__)
#define HAIRLINE_BARRIER(type, x) __asm__("" : "+w"(x))
#else
#define HAIRLINE_BARRIER(type, x)       \
    do {                                \
        volatile type hidden_##x = (x); \
        (x) = hidden_##x;               \
    } while (0)
#endif
#endif

/* Sums of two inputs, or of one and another number. Where the caller's input is a product, a compiler that inlines would fuse
 * it into a plain sum, and compute with another number than the one that is stored. */
#ifndef HAIRLINE_SUMS_F64
#define HAIRLINE_SUMS_F64
#ifdef __CUDA_ARCH__
HAIRLINE_FUNCTION double hairline_sum_f64(double x, double y) { return __dadd_rn(x, y); }
HAIRLINE_FUNCTION double hairline_difference_f64(double x, double y) { return __dsub_rn(x, y); }
#else
HAIRLINE_FUNCTION double hairline_sum_f64(double x, double y) {
    HAIRLINE_BARRIER(double, x);
    HAIRLINE_BARRIER(double, y);
    return x + y;
}
HAIRLINE_FUNCTION double hairline_difference_f64(double x, double y) {
    HAIRLINE_BARRIER(double, x);
    HAIRLINE_BARRIER(double, y);
    return x - y;
}
#endif
#endif

/* What is seldom called stays out of the caller, and its stack too. */
#ifndef HAIRLINE_SELDOM
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__CUDACC__)
#define HAIRLINE_SELDOM static __attribute__((noinline, unused))
#else
#define HAIRLINE_SELDOM HAIRLINE_FUNCTION
#endif
#endif

/* x as it is stored: no compiler knows any more that it was a product. */
HAIRLINE_FUNCTION double hx_stored(double x) {
#ifdef __CUDA_ARCH__
    return __dmul_rn(x, 1);
#else
    HAIRLINE_BARRIER(double, x);
    return x;
#endif
}

/* x * y, rounded before it is added to anything. */
HAIRLINE_FUNCTION double hx_product(double x, double y) {
#ifdef __CUDA_ARCH__
    return __dmul_rn(x, y);
#else
    return hx_stored(x * y);
#endif
}

/* A hit: t along the direction, u and v the weights of b and c, and whether the front was hit (a, b, c counter-clockwise as
 * the ray sees them). hit is 1. asked is 1 if integers were needed. */
typedef struct {
    int hit, front, asked;
    double t, u, v;
} hairline_answer;

/* ---- integers of any sign and up to HX_LIMBS words ---- */

/* Inputs are integers times a power of two: as many bits as the largest exponent less the least one. Differences have one bit
 * more. The longest number is a sum of 18 products of three differences, times t. */
#ifdef HAIRLINE_ONLY_F32
#define HX_DIGITS FLT_MANT_DIG
#define HX_LEAST FLT_MIN_EXP
#define HX_LIMBS 30 /* 3 * (128 + 149 + 1) + 5 + 24 = 863 bits, and the words that carries need */
#else
#define HX_DIGITS DBL_MANT_DIG
#define HX_LEAST DBL_MIN_EXP
#define HX_LIMBS 202 /* 3 * (1024 + 1074 + 1) + 5 + 53 = 6355 bits, and the same */
#endif

typedef struct {
    int sign, n; /* n words, the last of which is not 0 */
    uint32_t w[HX_LIMBS];
} hx_int;

HAIRLINE_FUNCTION int hx_compare(const hx_int *a, const hx_int *b) {
    int i;
    if (a->n != b->n) return a->n < b->n ? -1 : 1;
    for (i = a->n - 1; i >= 0; i--)
        if (a->w[i] != b->w[i]) return a->w[i] < b->w[i] ? -1 : 1;
    return 0;
}

HAIRLINE_FUNCTION void hx_trim(hx_int *a) {
    while (a->n > 0 && a->w[a->n - 1] == 0) a->n--;
    if (a->n == 0) a->sign = 0;
}

/* a + sign * b */
HAIRLINE_FUNCTION void hx_add(hx_int *sum, const hx_int *a, const hx_int *b, int sign) {
    const hx_int *large = a, *small = b;
    int i, order, large_sign = a->sign, small_sign = sign * b->sign;
    uint64_t carry = 0;
    hx_int out;
    order = hx_compare(a, b);
    if (order < 0) {
        large = b, small = a;
        large_sign = small_sign, small_sign = a->sign;
    }
    out.sign = large_sign, out.n = large->n;
    if (small_sign == 0) {
        memcpy(out.w, large->w, sizeof(uint32_t) * (size_t)large->n);
    } else if (large_sign == small_sign) {
        for (i = 0; i < large->n; i++) {
            carry += (uint64_t)large->w[i] + (i < small->n ? small->w[i] : 0);
            out.w[i] = (uint32_t)carry, carry >>= 32;
        }
        if (carry) out.w[out.n++] = (uint32_t)carry;
    } else {
        for (i = 0; i < large->n; i++) {
            uint64_t take = (uint64_t)(i < small->n ? small->w[i] : 0) + carry;
            carry = large->w[i] < take;
            out.w[i] = (uint32_t)(large->w[i] - take);
        }
        hx_trim(&out);
    }
    sum->sign = out.sign, sum->n = out.n;
    memcpy(sum->w, out.w, sizeof(uint32_t) * (size_t)out.n);
}

HAIRLINE_FUNCTION void hx_multiply(hx_int *product, const hx_int *a, const hx_int *b) {
    int i, j;
    product->sign = a->sign * b->sign, product->n = product->sign == 0 ? 0 : a->n + b->n;
    if (product->sign == 0) return;
    memset(product->w, 0, sizeof(uint32_t) * (size_t)product->n);
    for (i = 0; i < a->n; i++) {
        uint64_t carry = 0;
        for (j = 0; j < b->n; j++) {
            carry += (uint64_t)a->w[i] * b->w[j] + product->w[i + j];
            product->w[i + j] = (uint32_t)carry, carry >>= 32;
        }
        product->w[i + b->n] = (uint32_t)carry;
    }
    hx_trim(product);
}

/* The least exponent of a bit of x; a large one of 0. */
HAIRLINE_FUNCTION int hx_lowest(double x) {
    int exponent;
    if (x == 0) return 4096;
    (void)frexp(x, &exponent);
    return (exponent < HX_LEAST ? HX_LEAST : exponent) - HX_DIGITS;
}

/* a * 2^bits */
HAIRLINE_FUNCTION void hx_shift(hx_int *a, int bits) {
    int i, words = bits / 32, rest = bits % 32;
    if (a->sign == 0) return;
    a->w[a->n + words] = 0;
    for (i = a->n - 1; i >= 0; i--) {
        uint64_t both = (uint64_t)a->w[i] << rest;
        a->w[i + words + 1] |= (uint32_t)(both >> 32);
        a->w[i + words] = (uint32_t)both;
    }
    memset(a->w, 0, sizeof(uint32_t) * (size_t)words);
    a->n += words + 1;
    hx_trim(a);
}

/* x / 2^lowest */
HAIRLINE_FUNCTION void hx_read(hx_int *a, double x, int lowest) {
    uint64_t bits;
    a->sign = (x > 0) - (x < 0), a->n = 0;
    if (x == 0) return;
    bits = (uint64_t)ldexp(fabs(x), -hx_lowest(x));
    a->w[0] = (uint32_t)bits, a->w[1] = (uint32_t)(bits >> 32), a->n = 2;
    hx_trim(a);
    hx_shift(a, hx_lowest(x) - lowest);
}

/* a / b as a double, times 2^exponent */
HAIRLINE_FUNCTION double hx_quotient(const hx_int *a, const hx_int *b, int exponent) {
    const hx_int *of[2];
    double top[2] = {0, 0};
    int i, k;
    of[0] = a, of[1] = b;
    if (a->sign == 0) return 0;
    for (k = 0; k < 2; k++)
        for (i = of[k]->n - 1; i >= 0 && i > of[k]->n - 5; i--)
            top[k] += ldexp((double)of[k]->w[i], 32 * (i - of[k]->n));
    return a->sign * b->sign * ldexp(top[0] / top[1], 32 * (a->n - b->n) + exponent);
}

/* x * y - z * w */
HAIRLINE_FUNCTION void hx_minor(hx_int *out, const hx_int *x, const hx_int *y, const hx_int *z, const hx_int *w) {
    hx_int one, other;
    hx_multiply(&one, x, y);
    hx_multiply(&other, z, w);
    hx_add(out, &one, &other, -1);
}

/* x . (y x z) */
HAIRLINE_FUNCTION void hx_triple(hx_int *out, const hx_int x[3], const hx_int y[3], const hx_int z[3]) {
    hx_int minor, term;
    int i;
    out->sign = out->n = 0;
    for (i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        hx_minor(&minor, &y[j], &z[k], &y[k], &z[j]);
        hx_multiply(&term, &x[i], &minor);
        hx_add(out, out, &term, 1);
    }
}

/* The sign of an edge's number; of a ray that meets the edge the one that it has next to it, where exactly one triangle
 * is to be hit: a move of the origin along axis i changes it by component i of (to - from) x d. */
HAIRLINE_FUNCTION int hx_side(const hx_int *number, const hx_int from[3], const hx_int to[3], const hx_int d[3], int largest) {
    int k;
    if (number->sign != 0 || HAIRLINE_EDGES != HAIRLINE_ONCE) return number->sign;
    for (k = 1; k < 3; k++) {
        int i = (largest + k) % 3, j = (i + 1) % 3, l = (i + 2) % 3;
        hx_int edge_j, edge_l, moved;
        hx_add(&edge_j, &to[j], &from[j], -1);
        hx_add(&edge_l, &to[l], &from[l], -1);
        hx_minor(&moved, &edge_j, &d[l], &edge_l, &d[j]);
        if (moved.sign != 0) return moved.sign;
    }
    return 0;
}

/* The number of bits of |a|. */
HAIRLINE_FUNCTION int hx_bits(const hx_int *a) {
    int bits = 32 * (a->n - 1);
    uint32_t top;
    for (top = a->w[a->n - 1]; top != 0; top >>= 1) bits++;
    return bits;
}

/* The sign of N - t * D, where N / D is in units of 2^exponent. */
HAIRLINE_FUNCTION int hx_past(const hx_int *n, const hx_int *d, double t, int exponent) {
    hx_int left = *n, factor, right;
    int shift, longer;
    if (t == 0 || n->sign == 0) return n->sign != 0 ? n->sign : ((t < 0) - (t > 0)) * d->sign;
    hx_read(&factor, t, hx_lowest(t));
    hx_multiply(&right, &factor, d);
    if (left.sign != right.sign) return left.sign;
    /* The number with more bits is larger. Else the shift adds no more bits than the other number has. */
    shift = hx_lowest(t) - exponent;
    longer = hx_bits(&left) - hx_bits(&right) - shift;
    if (longer != 0) return longer > 0 ? left.sign : -left.sign;
    hx_shift(shift < 0 ? &left : &right, shift < 0 ? -shift : shift);
    hx_add(&left, &left, &right, -1);
    return left.sign;
}

HAIRLINE_FUNCTION double hx_larger(double a, double b) { return a > b ? a : b; }

HAIRLINE_FUNCTION double hx_within(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

/* The answer by integers. */
HAIRLINE_SELDOM void hx_exact(double points[4][3], const double d[3], double t_min, double t_max, hairline_answer *answer) {
    hx_int p[4][3], direction[3], edges[3], det, n;
    int i, k, of_points = 4096, of_direction = 4096, largest = 0, exponent;
    answer->hit = 0, answer->asked = 1;
    for (i = 0; i < 3; i++) {
        if (hx_lowest(d[i]) < of_direction) of_direction = hx_lowest(d[i]);
        if (fabs(d[i]) > fabs(d[largest])) largest = i;
        for (k = 0; k < 4; k++)
            if (hx_lowest(points[k][i]) < of_points) of_points = hx_lowest(points[k][i]);
    }
    for (i = 0; i < 3; i++) {
        hx_read(&direction[i], d[i], of_direction);
        for (k = 0; k < 4; k++) {
            hx_read(&p[k][i], points[k][i], of_points);
            if (k > 0) hx_add(&p[k][i], &p[k][i], &p[0][i], -1);
        }
    }
    det.sign = det.n = 0;
    for (k = 0; k < 3; k++) {
        /* d . (C x B), d . (A x C), d . (B x A) */
        const hx_int *to = p[1 + (k + 2) % 3], *from = p[1 + (k + 1) % 3];
        hx_triple(&edges[k], direction, to, from);
        hx_add(&det, &det, &edges[k], 1);
    }
    if (det.sign == 0) return;
    for (k = 0; k < 3; k++) {
        int side = det.sign * hx_side(&edges[k], p[1 + (k + 1) % 3], p[1 + (k + 2) % 3], direction, largest);
        if (side < (HAIRLINE_EDGES == HAIRLINE_CLOSED ? 0 : 1)) return;
    }
    hx_triple(&n, p[1], p[3], p[2]);
    exponent = of_points - of_direction;
    if (t_min >= -DBL_MAX && det.sign * hx_past(&n, &det, t_min, exponent) < 0) return;
    if (t_max <= DBL_MAX && det.sign * hx_past(&n, &det, t_max, exponent) > 0) return;
    answer->hit = 1, answer->front = det.sign > 0;
    answer->t = hx_quotient(&n, &det, exponent);
    answer->u = hx_within(hx_quotient(&edges[1], &det, 0), 0, 1);
    answer->v = hx_within(hx_quotient(&edges[2], &det, 0), 0, 1 - answer->u);
}

/* ---- sums of doubles that are not rounded (Shewchuk 1997) ---- */

/* The sign of x, 0 where a margin leaves it open. */
HAIRLINE_FUNCTION int hx_sign(double x, double margin) { return x > margin ? 1 : x < -margin ? -1 : 0; }

/* The terms of a sum, from the least: none is 0, and no two have a bit in common, so the last one has the sign. An edge's number is 6
 * products of three numbers, two of which are two doubles each; a product of three doubles is four. */
#define HX_TERMS 96

typedef struct {
    int n;
    double terms[HX_TERMS];
} hx_sum;

/* The rounded sum, and what is missing (Knuth). */
HAIRLINE_FUNCTION double hx_two_sum(double x, double y, double *rest) {
    double sum = hx_stored(x + y), of_y = hx_stored(sum - x), of_x = hx_stored(sum - of_y);
    *rest = hx_stored(x - of_x) + hx_stored(y - of_y);
    return sum;
}

/* The upper half of the digits of x (Veltkamp). */
HAIRLINE_FUNCTION double hx_upper(double x) {
    double large = hx_product(0x8000001p0, x);
    return large - hx_stored(large - x);
}

/* The rounded product, and what is missing (Dekker). */
HAIRLINE_FUNCTION double hx_two_product(double x, double y, double *rest) {
    double product = hx_product(x, y);
#if defined(__CUDA_ARCH__) || defined(FP_FAST_FMA)
    *rest = fma(x, y, -product);
#else
    double x_upper = hx_upper(x), x_lower = x - x_upper, y_upper = hx_upper(y), y_lower = y - y_upper;
    *rest = x_upper * y_upper - product;
    *rest += x_upper * y_lower;
    *rest += x_lower * y_upper;
    *rest += x_lower * y_lower;
#endif
    return product;
}

HAIRLINE_FUNCTION void hx_add_double(hx_sum *sum, double x) {
    int i, n = 0;
    for (i = 0; i < sum->n; i++) {
        double rest;
        x = hx_two_sum(x, sum->terms[i], &rest);
        if (rest != 0) sum->terms[n++] = rest;
    }
    if (x != 0) sum->terms[n++] = x;
    sum->n = n;
}

HAIRLINE_FUNCTION void hx_add_product(hx_sum *sum, double x, double y) {
    double rest, product = hx_two_product(x, y, &rest);
    hx_add_double(sum, rest);
    hx_add_double(sum, product);
}

HAIRLINE_FUNCTION void hx_add_product_of_three(hx_sum *sum, double x, double y, double z) {
    double rest, product = hx_two_product(x, y, &rest);
    if (rest != 0) hx_add_product(sum, rest, z);
    if (product != 0) hx_add_product(sum, product, z);
}

HAIRLINE_FUNCTION int hx_sign_of_sum(const hx_sum *sum) {
    if (sum->n == 0) return 0;
    return sum->terms[sum->n - 1] > 0 ? 1 : -1;
}

/* to - from, as two doubles. */
HAIRLINE_FUNCTION void hx_difference(double parts[2], double to, double from) {
    parts[0] = hx_two_sum(hx_stored(to), -hx_stored(from), &parts[1]);
}

/* An edge's number, d . (to x from), of corners minus the origin as two doubles each: with what each product and sum leaves out,
 * but not with what is left out of that (Ogita, Rump and Oishi 2005). Off by less than 2^-98 times the sum of the sizes of its terms,
 * and with the right sign beyond that. */
HAIRLINE_FUNCTION double hx_compensated(double to[3][2], double from[3][2], const double d[3]) {
    double sum = 0, left = 0;
    int i, half;
    for (i = 0; i < 3; i++)
        for (half = 0; half < 2; half++) {
            int j = (i + 1 + half) % 3, k = (i + 2 - half) % 3;
            double of_pair, of_three, of_sum, x = half ? -to[j][0] : to[j][0], y = from[k][0];
            double pair = hx_two_product(x, y, &of_pair);
            double three = hx_two_product(pair, d[i], &of_three);
            double small = to[j][1] * y;
            sum = hx_two_sum(sum, three, &of_sum);
            small = x * from[k][1] + (half ? -small : small);
            left += of_sum + of_three + (of_pair + small) * d[i];
        }
    return sum + left;
}

/* The sign of an edge's number: size is the sum of the sizes of its terms. */
HAIRLINE_FUNCTION int hx_sign_of_edge(double points[4][3], const double d[3], int from, int to, double size) {
    double p[3][2], q[3][2];
    hx_sum sum;
    int i, m, n, sign, is_short = 1;
    sum.n = 0;
    for (i = 0; i < 3; i++) {
        hx_difference(p[i], points[to][i], points[0][i]);
        hx_difference(q[i], points[from][i], points[0][i]);
        is_short = is_short && p[i][1] == 0 && q[i][1] == 0;
    }
    /* A sum of few terms costs as little. */
    sign = is_short ? 0 : hx_sign(hx_compensated(p, q, d), 0x1p-98 * size);
    if (sign != 0) return sign;
    for (i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        for (m = 0; m < 2; m++)
            for (n = 0; n < 2; n++) {
                hx_add_product_of_three(&sum, p[j][m], q[k][n], d[i]);
                hx_add_product_of_three(&sum, -p[k][m], q[j][n], d[i]);
            }
    }
    return hx_sign_of_sum(&sum);
}

/* The sign that the number of an edge, which is 0, has for the ray next to this one: see hx_side. */
HAIRLINE_FUNCTION int hx_sign_beside(double points[4][3], const double d[3], int from, int to, int largest) {
    int k, m, sign = 0;
    for (k = 1; k < 3 && sign == 0; k++) {
        int i = (largest + k) % 3, j = (i + 1) % 3, l = (i + 2) % 3;
        double edge_j[2], edge_l[2];
        hx_sum moved;
        moved.n = 0;
        hx_difference(edge_j, points[to][j], points[from][j]);
        hx_difference(edge_l, points[to][l], points[from][l]);
        for (m = 0; m < 2; m++) {
            hx_add_product(&moved, edge_j[m], d[l]);
            hx_add_product(&moved, -edge_l[m], d[j]);
        }
        sign = hx_sign_of_sum(&moved);
    }
    return sign;
}

/* Whether no product of three of these numbers loses a bit below the least double. */
HAIRLINE_FUNCTION int hx_is_above_underflow(const double x[3]) {
    int i;
    for (i = 0; i < 3; i++)
        if (x[i] != 0 && fabs(x[i]) < 0x1p-250) return 0;
    return 1;
}

/* The sign of U + V + W if the line hits the triangle, 0 if it misses it. 0 in sign is open, and the others are right. */
HAIRLINE_SELDOM int hx_passage(double points[4][3], const double d[3], const double size[3], int sign[3]) {
    int k, whole = 0, largest = fabs(d[0]) >= fabs(d[1]) ? 0 : 1;
    if (fabs(d[2]) > fabs(d[largest])) largest = 2;
    for (k = 0; k < 3; k++) {
        if (sign[k] == 0) sign[k] = hx_sign_of_edge(points, d, 1 + (k + 1) % 3, 1 + (k + 2) % 3, size[k]);
        if (sign[k] * whole < 0) return 0;
        if (sign[k] != 0) whole = sign[k];
    }
    for (k = 0; k < 3; k++) {
        if (sign[k] != 0 || HAIRLINE_EDGES == HAIRLINE_CLOSED) continue;
        if (HAIRLINE_EDGES == HAIRLINE_OPEN) return 0;
        if (hx_sign_beside(points, d, 1 + (k + 1) % 3, 1 + (k + 2) % 3, largest) != whole) return 0;
    }
    return whole;
}

/* ---- plain arithmetic, with a margin ---- */

/* x . (y x z), and the sum of the sizes of its terms */
HAIRLINE_FUNCTION double hx_plain(const double x[3], const double y[3], const double z[3], double *size) {
    double sum = 0;
    int i;
    *size = 0;
    for (i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += x[i] * (y[j] * z[k] - y[k] * z[j]);
        *size += fabs(x[i]) * (fabs(y[j] * z[k]) + fabs(y[k] * z[j]));
    }
    return sum;
}

/* The sign of n - t * det, where the exact det is above 0: below 0 before the end at t, above it beyond; 0 where it is open. */
HAIRLINE_FUNCTION int hx_plain_past(double n, double det, double t, double size_n, double size_det) {
    double end = hx_within(t, -0x1p128, 0x1p128);
    int past = hx_sign(n - end * det, 0x1p-48 * (size_n + fabs(end) * size_det) + 0x1p-620);
    /* An end farther off is only known to be farther off. */
    if (end != t && (t > 0 ? past > 0 : past < 0)) return 0;
    return past;
}

/* The values of a hit, as Moeller and Trumbore have them: differences from the corner a. 0 if u, v, or the point in longest
 * edges (or t itself), may be off by more than `loss`. */
HAIRLINE_FUNCTION int hx_values(double points[4][3], const double d[3], double loss, hairline_answer *answer) {
    double e1[3], e2[3], s[3], det, of_det, of_t, of_u, of_v, edge = 0, step = 0;
    int i;
    for (i = 0; i < 3; i++) {
        e1[i] = hairline_difference_f64(points[2][i], points[1][i]);
        e2[i] = hairline_difference_f64(points[3][i], points[1][i]);
        s[i] = hairline_difference_f64(points[0][i], points[1][i]);
        edge = hx_larger(edge, hx_larger(fabs(e1[i]), fabs(e2[i]))), step = hx_larger(step, fabs(d[i]));
    }
    det = hx_plain(d, e2, e1, &of_det);
    answer->t = hx_plain(e2, s, e1, &of_t) / det;
    answer->u = hx_plain(s, d, e2, &of_u) / det;
    answer->v = hx_plain(d, s, e1, &of_v) / det;
    loss *= fabs(det) * 0x1p49;
    if (!(of_det + 0x1p-700 < loss && of_u < loss && of_v < loss)) return 0;
    if (!(of_t + 0x1p-760 < loss * hx_larger(edge / step, fabs(answer->t)))) return 0;
    answer->u = hx_within(answer->u, 0, 1), answer->v = hx_within(answer->v, 0, 1 - answer->u);
    return 1;
}

/* 1 for a hit, 0 for a miss, 2 to ask. */
HAIRLINE_FUNCTION int hx_filter(double points[4][3], const double d[3], double t_min, double t_max, double loss,
                            hairline_answer *answer) {
    double p[3][3], edge[3], size[3], det, size_det, n, size_n, most = 0;
    int sign[3], i, k, whole, before, beyond;
    for (i = 0; i < 3; i++) {
        if (fabs(d[i]) > most) most = fabs(d[i]);
        for (k = 0; k < 3; k++) {
            p[k][i] = hairline_difference_f64(points[1 + k][i], points[0][i]);
            if (fabs(p[k][i]) > most) most = fabs(p[k][i]);
        }
    }
    if (most > 0x1p290) return 2;
    for (k = 0; k < 3; k++) {
        edge[k] = hx_plain(d, p[(k + 2) % 3], p[(k + 1) % 3], &size[k]);
        sign[k] = hx_sign(edge[k], 0x1p-49 * size[k] + 0x1p-760);
    }
    if (sign[0] * sign[1] < 0 || sign[1] * sign[2] < 0 || sign[2] * sign[0] < 0) return 0;
    whole = sign[0];
    if (sign[0] == 0 || sign[1] == 0 || sign[2] == 0) {
        for (k = 0; k < 4; k++)
            if (!hx_is_above_underflow(points[k])) return 2;
        if (!hx_is_above_underflow(d)) return 2;
        whole = hx_passage(points, d, size, sign);
        if (whole == 0) return 0;
    }
    det = whole * (edge[0] + edge[1] + edge[2]), size_det = size[0] + size[1] + size[2];
    n = whole * hx_plain(p[0], p[2], p[1], &size_n);
    before = t_min < -DBL_MAX ? 1 : hx_plain_past(n, det, t_min, size_n, size_det);
    beyond = t_max > DBL_MAX ? -1 : hx_plain_past(n, det, t_max, size_n, size_det);
    if (before < 0 || beyond > 0) return 0;
    if (before == 0 || beyond == 0) return 2;
    answer->hit = 1, answer->front = whole > 0, answer->asked = 0;
    return hx_values(points, d, loss, answer) ? 1 : 2;
}

HAIRLINE_FUNCTION int hx_answer(double points[4][3], const double d[3], double t_min, double t_max, double largest,
                            double loss, hairline_answer *answer) {
    hairline_answer found;
    int i, k;
    if (!(t_min <= t_max) || t_min > DBL_MAX || t_max < -DBL_MAX) return 0;
    for (i = 0; i < 3; i++) {
        if (!(fabs(d[i]) <= DBL_MAX)) return 0;
        for (k = 0; k < 4; k++)
            if (!(fabs(points[k][i]) <= DBL_MAX)) return 0;
    }
    memset(&found, 0, sizeof found);
    if (hx_filter(points, d, t_min, t_max, loss, &found) == 2) hx_exact(points, d, t_min, t_max, &found);
    if (!found.hit) return 0;
    /* What was rounded stays between the ends, and finite. */
    found.t = hx_within(found.t, hx_larger(t_min, -largest), t_max < largest ? t_max : largest);
    *answer = found;
    return 1;
}

#ifndef HAIRLINE_ONLY_F32
/* Does the ray o + t * d, t_min <= t <= t_max, hit the triangle? Vectors are arrays of three. Returns 1 for a hit, 0 for a miss.
 * A miss leaves *answer as it was: with its t as t_max, one answer can hold the nearest hit. Where you throw hits away (culling, holes in
 * textures) take another answer for each test. */
HAIRLINE_FUNCTION int hairline_exact_f64(const double o[3], const double d[3], const double a[3], const double b[3], const double c[3],
                              double t_min, double t_max, hairline_answer *answer) {
    double points[4][3];
    int i;
    for (i = 0; i < 3; i++) points[0][i] = o[i], points[1][i] = a[i], points[2][i] = b[i], points[3][i] = c[i];
    return hx_answer(points, d, t_min, t_max, DBL_MAX, 0x1p-32, answer);
}
#endif

/* The same in float, where plain arithmetic in double has margins that hardly ever matter. */
HAIRLINE_FUNCTION int hairline_exact_f32(const float o[3], const float d[3], const float a[3], const float b[3], const float c[3],
                              float t_min, float t_max, hairline_answer *answer) {
    double points[4][3], direction[3];
    int i;
    for (i = 0; i < 3; i++) {
        points[0][i] = o[i], points[1][i] = a[i], points[2][i] = b[i], points[3][i] = c[i];
        direction[i] = d[i];
    }
    return hx_answer(points, direction, t_min, t_max, FLT_MAX, 0x1p-25, answer);
}

#if defined(__clang__) && !defined(__CUDACC__)
#pragma float_control(pop)
#endif

#endif
