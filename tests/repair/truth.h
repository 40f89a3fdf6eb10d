/* The exact answer to a ray and a triangle, for the programs here that try guarded kernels. It shares nothing with hairline: long
 * double decides where that is certain, integers of as many digits as it takes elsewhere. C11 and C++17.
 *
 * DOUBLE is 1 for kernels in f64, EXTENT 0 for a line, 1 for a ray, 2 for an interval, FRONT 1 if only the front is hit. */
#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if DOUBLE
typedef double real;
typedef uint64_t bits_t;
#define MANTISSA 52
#define BIAS 1075
#define MOST_EXPONENT 2047
#else
typedef float real;
typedef uint32_t bits_t;
#define MANTISSA 23
#define BIAS 150
#define MOST_EXPONENT 255
#endif
#ifdef __cplusplus
#define THREAD_LOCAL thread_local
#else
#define THREAD_LOCAL _Thread_local
#endif
#define PASTE_(a, b) a##b
#define PASTE(a, b) PASTE_(a, b)

/* Integers: sign and 64-bit limbs, the lowest first. 3 differences of up to 2,151 bits, and two more factors. */
#define LIMBS 180
typedef struct {
    int sign, size;
    uint64_t limb[LIMBS];
} integer;

static void trim(integer *x) {
    while (x->size > 0 && x->limb[x->size - 1] == 0) x->size--;
    if (x->size == 0) x->sign = 0;
}

static int compare_sizes(const integer *x, const integer *y) {
    int i;
    if (x->size != y->size) return x->size < y->size ? -1 : 1;
    for (i = x->size - 1; i >= 0; i--)
        if (x->limb[i] != y->limb[i]) return x->limb[i] < y->limb[i] ? -1 : 1;
    return 0;
}

/* z = x + sign * y; z may be x or y. */
static void add(integer *z, const integer *x, const integer *y, int sign) {
    integer sum;
    int y_sign = y->sign * sign, i;
    if (y_sign == 0 || x->sign == 0) {
        const integer *only = y_sign == 0 ? x : y;
        int only_sign = y_sign == 0 ? x->sign : y_sign;
        memmove(z, only, sizeof(int) * 2 + sizeof(uint64_t) * (size_t)only->size);
        z->sign = only_sign;
        return;
    }
    if (x->sign == y_sign) {
        unsigned carry = 0;
        const integer *longer = x->size < y->size ? y : x, *shorter = x->size < y->size ? x : y;
        for (i = 0; i < longer->size; i++) {
            unsigned __int128 s = (unsigned __int128)longer->limb[i] + (i < shorter->size ? shorter->limb[i] : 0) + carry;
            sum.limb[i] = (uint64_t)s, carry = (unsigned)(s >> 64);
        }
        sum.size = longer->size;
        if (carry) sum.limb[sum.size++] = carry;
        sum.sign = x->sign;
    } else {
        int order = compare_sizes(x, y);
        const integer *larger = order < 0 ? y : x, *smaller = order < 0 ? x : y;
        unsigned borrow = 0;
        for (i = 0; i < larger->size; i++) {
            unsigned __int128 take = (unsigned __int128)(i < smaller->size ? smaller->limb[i] : 0) + borrow;
            borrow = larger->limb[i] < take;
            sum.limb[i] = (uint64_t)(larger->limb[i] - take);
        }
        sum.size = larger->size;
        sum.sign = order < 0 ? y_sign : x->sign;
    }
    trim(&sum);
    memcpy(z, &sum, sizeof(int) * 2 + sizeof(uint64_t) * (size_t)sum.size);
}

/* z = x * y; z is neither. */
static void multiply(integer *z, const integer *x, const integer *y) {
    int i, j;
    z->sign = x->sign * y->sign;
    if (z->sign == 0) {
        z->size = 0;
        return;
    }
    z->size = x->size + y->size;
    memset(z->limb, 0, sizeof(uint64_t) * (size_t)z->size);
    for (i = 0; i < x->size; i++) {
        uint64_t carry = 0;
        for (j = 0; j < y->size; j++) {
            unsigned __int128 s = (unsigned __int128)x->limb[i] * y->limb[j] + z->limb[i + j] + carry;
            z->limb[i + j] = (uint64_t)s, carry = (uint64_t)(s >> 64);
        }
        z->limb[i + y->size] = carry;
    }
    trim(z);
}

/* x * 2^shift. */
static void shift_up(integer *z, const integer *x, int shift) {
    int limbs = shift / 64, rest = shift % 64, i;
    integer out;
    if (x->sign == 0) {
        z->sign = z->size = 0;
        return;
    }
    memset(out.limb, 0, sizeof(uint64_t) * (size_t)(x->size + limbs + 1));
    for (i = 0; i < x->size; i++) {
        out.limb[i + limbs] |= x->limb[i] << rest;
        if (rest) out.limb[i + limbs + 1] |= x->limb[i] >> (64 - rest);
    }
    out.sign = x->sign, out.size = x->size + limbs + 1;
    trim(&out);
    memcpy(z, &out, sizeof(int) * 2 + sizeof(uint64_t) * (size_t)out.size);
}

static bits_t bits_of(real x) {
    bits_t bits;
    memcpy(&bits, &x, sizeof x);
    return bits;
}

static real real_of(bits_t bits) {
    real x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static int is_finite(real x) { return ((bits_of(x) >> MANTISSA) & MOST_EXPONENT) != MOST_EXPONENT; }

/* x = mantissa * 2^exponent. */
static int64_t mantissa_of(real x, int *exponent) {
    bits_t bits = bits_of(x);
    int raw = (int)((bits >> MANTISSA) & MOST_EXPONENT);
    int64_t mantissa = (int64_t)(bits & (((bits_t)1 << MANTISSA) - 1));
    if (raw > 0) mantissa |= (int64_t)1 << MANTISSA;
    *exponent = (raw > 0 ? raw : 1) - BIAS;
    while (mantissa && !(mantissa & 1)) mantissa >>= 1, ++*exponent;
    return x < 0 ? -mantissa : mantissa;
}

/* The least exponent of some numbers. */
static int least_exponent(const real *x, int count) {
    int i, exponent, least = 5000;
    for (i = 0; i < count; i++)
        if (x[i] != 0) mantissa_of(x[i], &exponent), least = exponent < least ? exponent : least;
    return least == 5000 ? 0 : least;
}

static void integer_of(integer *z, real x, int least) {
    int exponent;
    int64_t mantissa = mantissa_of(x, &exponent);
    integer small;
    small.sign = (mantissa > 0) - (mantissa < 0), small.size = mantissa != 0;
    small.limb[0] = (uint64_t)(mantissa < 0 ? -mantissa : mantissa);
    if (mantissa == 0) {
        z->sign = z->size = 0;
        return;
    }
    shift_up(z, &small, exponent - least);
}

/* Rays and triangles: o, d, a, b, c, t_min and t_max. */
typedef struct {
    real x[15], end[2];
} ray;

static void cross(integer z[3], const integer p[3], const integer q[3]) {
    int i;
    integer m, n;
    for (i = 0; i < 3; i++) {
        multiply(&m, &p[(i + 1) % 3], &q[(i + 2) % 3]);
        multiply(&n, &p[(i + 2) % 3], &q[(i + 1) % 3]);
        add(&z[i], &m, &n, -1);
    }
}

static void dot(integer *z, const integer p[3], const integer q[3]) {
    int i;
    integer m;
    z->sign = z->size = 0;
    for (i = 0; i < 3; i++) multiply(&m, &p[i], &q[i]), add(z, z, &m, 1);
}

/* The sign of t - end, where t = n / det * 2^scale and end is a number. */
static int past(const integer *n, const integer *det, int scale, real end) {
    int exponent;
    integer e, right, left, difference;
    if (!is_finite(end)) return end > 0 ? -1 : 1;
    mantissa_of(end, &exponent);
    if (end == 0) return n->sign * det->sign;
    integer_of(&e, end, exponent);
    multiply(&right, &e, det);
    if (scale >= exponent) {
        shift_up(&left, n, scale - exponent);
    } else {
        left = *n;
        shift_up(&right, &right, exponent - scale);
    }
    add(&difference, &left, &right, -1);
    return difference.sign * det->sign;
}

/* 2 if the ray passes through the inside of the triangle, strictly between the ends; 0 if it misses it with its edges and
 * ends; 1 if neither. */
static int truth(const ray *r) {
    static THREAD_LOCAL integer p[3][3], d[3], normal[3], w[3], sum, n, det, o, x;
    real points[12];
    int i, k, least, least_d, s[3], inside, closed, before = 1, after = -1;
    memcpy(points, r->x, sizeof(real) * 3);
    memcpy(points + 3, r->x + 6, sizeof(real) * 9);
    least = least_exponent(points, 12), least_d = least_exponent(r->x + 3, 3);
    for (i = 0; i < 3; i++) {
        integer_of(&o, r->x[i], least);
        integer_of(&d[i], r->x[3 + i], least_d);
        for (k = 0; k < 3; k++) integer_of(&x, r->x[6 + 3 * k + i], least), add(&p[k][i], &x, &o, -1);
    }
    sum.sign = sum.size = 0;
    for (k = 0; k < 3; k++) {
        cross(normal, p[(k + 2) % 3], p[(k + 1) % 3]);
        dot(&w[k], d, normal);
        add(&sum, &sum, &w[k], 1);
        s[k] = w[k].sign;
    }
    inside = s[0] && s[0] == s[1] && s[1] == s[2];
    closed = sum.sign && ((s[0] >= 0 && s[1] >= 0 && s[2] >= 0) || (s[0] <= 0 && s[1] <= 0 && s[2] <= 0));
    if (!closed) return 0;
    if (FRONT && sum.sign < 0) return 0;
    /* t = A·(B×C) / -sum. */
    cross(normal, p[1], p[2]);
    dot(&n, p[0], normal);
    det = sum, det.sign = -det.sign;
    if (EXTENT == 1) before = past(&n, &det, least - least_d, 0);
    if (EXTENT == 2) {
        before = past(&n, &det, least - least_d, r->end[0]);
        after = past(&n, &det, least - least_d, r->end[1]);
    }
    if (before < 0 || after > 0) return 0;
    return inside && before > 0 && after < 0 ? 2 : 1;
}

/* What decides a ray, in long double, with the sum of its terms' sizes: the weights of the vertices, and the distances from the
 * plane to the ends, with the sign of the sum of the weights. */
typedef struct {
    long double value[5], size[5];
} measures;

static measures measured(const ray *r) {
    long double p[3][3], n = 0, det = 0, size_n = 0, size_det = 0;
    measures m;
    int i, k;
    for (k = 0; k < 3; k++)
        for (i = 0; i < 3; i++) p[k][i] = (long double)r->x[6 + 3 * k + i] - r->x[i];
    for (k = 0; k < 3; k++) {
        const long double *q = p[(k + 2) % 3], *z = p[(k + 1) % 3];
        m.value[k] = m.size[k] = 0;
        for (i = 0; i < 3; i++) {
            long double one = q[(i + 1) % 3] * z[(i + 2) % 3], other = q[(i + 2) % 3] * z[(i + 1) % 3], d = r->x[3 + i];
            m.value[k] += d * (one - other), m.size[k] += fabsl(d) * (fabsl(one) + fabsl(other));
        }
        det -= m.value[k], size_det += m.size[k];
    }
    for (i = 0; EXTENT && i < 3; i++) {
        long double one = p[1][(i + 1) % 3] * p[2][(i + 2) % 3], other = p[1][(i + 2) % 3] * p[2][(i + 1) % 3];
        n += p[0][i] * (one - other), size_n += fabsl(p[0][i]) * (fabsl(one) + fabsl(other));
    }
    for (i = 0; i < EXTENT; i++) {
        real at = EXTENT == 1 ? 0 : r->end[i];
        m.value[3 + i] = is_finite(at) ? n - at * det : at > 0 ? -det : det;
        m.size[3 + i] = is_finite(at) ? size_n + fabsl(at) * size_det : size_det;
    }
    return m;
}

/* The truth by long double, where rounding cannot have changed it; -1 elsewhere. Its exponents hold every product here, and a
 * weight passes at most ten roundings, so it is off by less than 2^-60 of the sum of its terms' sizes. */
static int quick(const measures *m) {
#if LDBL_MANT_DIG < 64
    (void)m;
    return -1;
#else
    const long double margin = 1 / 288230376151711744.0L; /* 2^-58 */
    int i, s[5];
    for (i = 0; i < 3 + EXTENT; i++) {
        long double value = m->value[i], most = margin * m->size[i];
        s[i] = value > most ? 1 : value < -most ? -1 : 0;
    }
    if (s[0] * s[1] < 0 || s[1] * s[2] < 0 || s[2] * s[0] < 0) return 0;
    if (!s[0] || !s[1] || !s[2]) return -1;
    if (FRONT && s[0] < 0) return 0;
    for (i = 0; i < EXTENT; i++)
        if (!s[3 + i]) return -1;
    for (i = 0; i < EXTENT; i++)
        if (s[3 + i] * s[0] != (i == 0 ? -1 : 1)) return 0;
    return 2;
#endif
}

static uint64_t next(uint64_t *state) {
    uint64_t x = *state += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

static uint64_t below(uint64_t *state, uint64_t count) { return next(state) % count; }

/* Uniform in [-1, 1]. */
static double uniform(uint64_t *state) { return (double)(int64_t)(next(state) >> 11) / 4503599627370496.0 - 1; }

static double power(int exponent) {
    double x = 1, factor = exponent < 0 ? 0.5 : 2;
    unsigned left = (unsigned)(exponent < 0 ? -exponent : exponent);
    for (; left; left >>= 1, factor *= factor)
        if (left & 1) x *= factor;
    return x;
}

/* Ends the program if the two truths differ. */
static int right_of(const ray *r, const measures *m, int is_compared) {
    int right = quick(m), exact;
    if (right >= 0 && !is_compared) return right;
    exact = truth(r);
    if (right >= 0 && right != exact) {
        fprintf(stderr, "the quick truth is %d, the exact one %d\n", right, exact);
        exit(3);
    }
    return exact;
}

/* True if a hit or a miss is wrong. */
static int is_wrong(const ray *r, int answer, int right) {
    return (EXTENT == 2 && !(r->end[0] <= r->end[1])) || right != (answer == HAIRLINE_HIT ? 2 : 0);
}
