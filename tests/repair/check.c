/* Adversarial rays against one guarded kernel that `hairline repair --emit c` wrote. It shares nothing with hairline: it
 * draws its own rays, and decides each in long double where that is certain, else in integers of as many digits as it takes.
 *
 *     cc -O2 -pthread -include KERNEL_SCALAR.h -DKERNEL=KERNEL_SCALAR -DDOUBLE=0 -DEXTENT=0 -DFRONT=0 check.c -lm
 *     ./a.out THREADS COUNT SEED
 *
 * EXTENT is 0 for a line, 1 for a ray, 2 for an interval; FRONT is 1 if it hits the front only; run.sh sets them all.
 * Prints how many answers of each kind of ray were hit, miss, ask and wrong; ends with 1 if one is wrong. */
#include "truth.h"

#include <pthread.h>

static real any_finite(uint64_t *state) {
    real x;
    do x = real_of((bits_t)next(state));
    while (!is_finite(x));
    return x;
}

/* A few floats up or down. */
static real nudged(uint64_t *state, real x) {
    static const int most[4] = {1, 2, 16, 4096};
    int steps = (int)below(state, (uint64_t)(2 * most[below(state, 4)] + 1));
    real y = real_of(bits_of(x) + (bits_t)steps / 2 * (steps % 2 ? 1u : (bits_t)-1));
    return is_finite(y) ? y : x;
}

enum { PLAIN, EDGE, VERTEX, GRAZING, EXPONENTS, LATTICE, ENDS, SCALES, THIN, SPARSE, DRAWN, SEARCH = DRAWN, KINDS };
static const char *const NAMES[KINDS] = {"plain", "near edges", "near vertices", "grazing", "any exponents",
                                         "lattice", "near ends", "scales", "thin", "sparse", "search"};

static ray draw(int kind, uint64_t *state) {
    double x[15], u, v, w, t = 0.5 + below(state, 1000) / 100.0, size = power((int)below(state, 9) - 4);
    double offset = below(state, 4) ? 0 : power((int)below(state, 20)), shift[3];
    ray r;
    int i, k, exact = 1;
    if (kind == EXPONENTS) {
        for (i = 0; i < 15; i++) r.x[i] = any_finite(state);
        r.end[0] = any_finite(state), r.end[1] = any_finite(state);
        return r;
    }
    for (i = 0; i < 3; i++) shift[i] = offset * uniform(state);
    for (k = 2; k < 5; k++)
        for (i = 0; i < 3; i++) x[3 * k + i] = shift[i] + size * uniform(state);
    if (kind == THIN || !below(state, 16)) {
        double along = uniform(state), off = power(-(int)below(state, 60));
        for (i = 0; i < 3; i++) x[12 + i] = x[6 + i] + along * (x[9 + i] - x[6 + i]) + off * size * uniform(state);
    }
    /* A point of the plane, and the ray through it. */
    u = (uniform(state) + 1) / 2, v = (uniform(state) + 1) / 2 * (1 - u), w = 1 - u - v;
    if (kind == PLAIN) u = uniform(state) * 2, v = uniform(state) * 2, w = 1 - u - v;
    if (kind == EDGE || kind == THIN) w = 0, v = 1 - u;
    if (kind == VERTEX) u = 1, v = w = 0;
    for (i = 0; i < 3; i++) {
        double point = u * x[6 + i] + v * x[9 + i] + w * x[12 + i];
        x[3 + i] = uniform(state) * power((int)below(state, 3));
        if (kind == GRAZING) {
            double along = 0;
            int n = (int)below(state, 50);
            along = u * (x[9 + i] - x[6 + i]) + (v - 0.5) * (x[12 + i] - x[6 + i]);
            x[3 + i] = along + power(-n) * x[3 + i] * size;
        }
        x[i] = point - t * x[3 + i];
    }
    if (below(state, 2)) /* The direction from the rounded points, as a program aims. */
        for (i = 0; i < 3; i++) x[3 + i] = (u * x[6 + i] + v * x[9 + i] + w * x[12 + i] - (double)(real)x[i]) / (below(state, 2) ? 1 : t), exact = 0;
    if (kind == LATTICE) {
        int most = 1 << below(state, 5);
        for (i = 0; i < 15; i++) x[i] = (double)below(state, (uint64_t)(2 * most + 1)) - most;
        if (below(state, 2)) /* Through a point of an edge. */
            for (i = 0; i < 3; i++) x[3 + i] = (x[6 + i] + x[9 + i]) / 2 - x[i];
        exact = 1;
    }
    {
        double scale = 1, along = 1;
        int full = DOUBLE ? 1000 : 120;
        if (kind == SCALES || !below(state, 8)) {
            scale = power((int)below(state, (uint64_t)(2 * full)) - full);
            along = power((int)below(state, (uint64_t)(2 * full)) - full);
            if (below(state, 2)) along = scale;
        }
        for (i = 0; i < 15; i++) {
            double y = x[i] * (i / 3 == 1 ? along : scale);
            r.x[i] = is_finite((real)y) ? (real)y : (real)x[i];
        }
        t = t * scale / along;
    }
    if (kind == SPARSE)
        for (i = 0; i < 15; i++) {
            int what = (int)below(state, 6);
            if (what == 0) r.x[i] = 0;
            if (what == 1) r.x[i] = (real)power((int)below(state, 60) - 30);
            if (what == 2) r.x[i] = real_of((bits_t)below(state, 8));
            if (what == 3) r.x[i] = r.x[3 * (2 + below(state, 3)) + (uint64_t)(i % 3)];
        }
    if (kind != PLAIN && (exact || below(state, 2)))
        for (i = 0; i < 15; i++)
            if (!below(state, 3)) r.x[i] = nudged(state, r.x[i]);
    if (kind == ENDS && below(state, 2)) /* It starts near the plane. */
        for (i = 0; i < 3; i++) r.x[i] = nudged(state, (real)(r.x[i] + (real)t * r.x[3 + i]));
    r.end[0] = 0, r.end[1] = real_of((bits_t)MOST_EXPONENT << MANTISSA);
    if (kind == ENDS || !below(state, 4)) {
        real near = is_finite((real)t) ? nudged(state, (real)t) : 1;
        if (below(state, 2)) r.end[0] = near;
        else r.end[1] = near;
        if (!below(state, 4)) r.end[0] = any_finite(state);
        if (!below(state, 4)) r.end[1] = any_finite(state);
    }
    return r;
}

typedef struct {
    uint64_t seed, count, kinds[KINDS][4];
} work;

/* A search for a ray that the kernel still decides, as near as can be to where it must not: the one number that decides, as a
 * share of its terms' sizes, only falls. */
typedef struct {
    ray at;
    int left, goal;
    long double share;
} search;

static ray moved(search *s, uint64_t *state) {
    ray r = s->at;
    int i, count = 1 + (int)below(state, 3);
    if (s->left == 0) {
        s->left = 1000 << below(state, 5), s->goal = (int)below(state, 3 + EXTENT), s->share = 2;
        return s->at = draw((int)below(state, DRAWN), state);
    }
    s->left--;
    for (i = 0; i < count; i++) {
        real *x = &r.x[below(state, 15)];
        *x = below(state, 3) ? nudged(state, *x) : (real)(*x * (1 + uniform(state) * power(-(int)below(state, MANTISSA))));
    }
    return r;
}

static void keep(search *s, const ray *r, const measures *m) {
    const long double *w = m->value;
    int i = s->goal % 3, others = w[(i + 1) % 3] * w[(i + 2) % 3] > 0 && (s->goal < 3 || w[0] * w[1] > 0);
    long double share = others ? fabsl(w[s->goal]) / m->size[s->goal] : 1;
    if (share <= s->share) s->at = *r, s->share = share;
}

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static int shown = 0;

static void show(const ray *r, int answer, int right) {
    int i;
    pthread_mutex_lock(&lock);
    if (shown++ < 5) {
        printf("wrong: answer %d, truth %d:", answer, right);
        for (i = 0; i < 17; i++) printf(" %a", (double)(i < 15 ? r->x[i] : r->end[i - 15]));
        printf("\n");
    }
    pthread_mutex_unlock(&lock);
}

static void *run(void *given) {
    work *w = given;
    uint64_t i, state = w->seed;
    search found = {.left = 0};
    PASTE(KERNEL, _hit) hit;
    for (i = 0; i < w->count; i++) {
        int kind = (int)(i % KINDS), answer;
        ray r = kind == SEARCH ? moved(&found, &state) : draw(kind, &state);
        answer = KERNEL(r.x, r.x + 3, r.x + 6, r.x + 9, r.x + 12, r.end[0], r.end[1], &hit);
        w->kinds[kind][answer]++;
        if (answer != HAIRLINE_ASK) {
            const measures m = measured(&r);
            const int right = right_of(&r, &m, i % 997 == 0);
            if (kind == SEARCH) keep(&found, &r, &m);
            if (is_wrong(&r, answer, right)) w->kinds[kind][3]++, show(&r, answer, right);
        }
    }
    return 0;
}

int main(int count, char **words) {
    int threads = count > 1 ? atoi(words[1]) : 1, i, k, j;
    uint64_t rays = count > 2 ? strtoull(words[2], 0, 10) : 1000000, seed = count > 3 ? strtoull(words[3], 0, 10) : 1;
    uint64_t all[4] = {0, 0, 0, 0};
    work *works = calloc((size_t)threads, sizeof *works);
    pthread_t *ids = calloc((size_t)threads, sizeof *ids);
    for (i = 0; i < threads; i++) {
        uint64_t state = seed * 1000003 + (uint64_t)i;
        works[i].seed = next(&state);
        works[i].count = rays / (uint64_t)threads + ((uint64_t)i < rays % (uint64_t)threads);
        pthread_create(&ids[i], 0, run, &works[i]);
    }
    for (i = 0; i < threads; i++) pthread_join(ids[i], 0);
    printf("%-14s %12s %12s %12s %8s\n", "rays", "hit", "miss", "ask", "wrong");
    for (k = 0; k < KINDS; k++) {
        uint64_t sums[4] = {0, 0, 0, 0};
        for (i = 0; i < threads; i++)
            for (j = 0; j < 4; j++) sums[j] += works[i].kinds[k][j], all[j] += works[i].kinds[k][j];
        printf("%-14s %12" PRIu64 " %12" PRIu64 " %12" PRIu64 " %8" PRIu64 "\n", NAMES[k], sums[1], sums[0], sums[2], sums[3]);
    }
    printf("%-14s %12" PRIu64 " %12" PRIu64 " %12" PRIu64 " %8" PRIu64 "\n", "all", all[1], all[0], all[2], all[3]);
    free(works), free(ids);
    return all[3] != 0;
}
