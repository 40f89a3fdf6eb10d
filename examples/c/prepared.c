/* hairline_prepared.h as a kernel: the same, of triangles and rays that are made ready.
 *
 *     cc -O2 -shared -fPIC -I../../include -o libprepared.so prepared.c
 *     hairline audit --kernel-lib ./libprepared.so
 *
 * With -DLEAF each triangle is asked about as one of a leaf, behind others that no ray hits.
 */
#include <hairline.h>
#include <hairline_prepared.h>

#if HAIRLINE_EDGES == HAIRLINE_ONCE
#define CONTRACT "extent=interval,sides=both,boundary=free,across=exactly-one"
#elif HAIRLINE_EDGES == HAIRLINE_CLOSED
#define CONTRACT "closed-interval,across=at-least-one"
#else
#define CONTRACT "extent=interval,sides=both,boundary=open"
#endif

static const hairline_kernel KERNEL = {
    "prepared", "include/hairline_prepared.h", CONTRACT, HAIRLINE_GIVES_T | HAIRLINE_GIVES_UV | HAIRLINE_GIVES_FACING, 0, 0};

uint32_t hairline_abi(void) { return HAIRLINE_ABI; }

const hairline_kernel *hairline_describe(void) { return &KERNEL; }

#ifdef LEAF
#define HIT(SUFFIX) hit_in_leaf_##SUFFIX(&triangle, (int)(i % HAIRLINE_LEAF), &ray, c->t_min, c->t_max, &answer)
#define IN_LEAF(REAL, SUFFIX)                                                                                          \
    static int hit_in_leaf_##SUFFIX(const hairline_triangle_##SUFFIX *triangle, int place,                             \
                                    const hairline_ray_##SUFFIX *ray, REAL t_min, REAL t_max,                          \
                                    hairline_answer *answer) {                                                         \
        static const REAL corner[3] = {0, 0, 0};                                                                       \
        hairline_triangle_##SUFFIX triangles[HAIRLINE_LEAF];                                                           \
        hairline_leaf_##SUFFIX leaf;                                                                                   \
        int i;                                                                                                         \
        for (i = 0; i < place; i++) hairline_prepare_triangle_##SUFFIX(&triangles[i], corner, corner, corner);         \
        triangles[place] = *triangle;                                                                                  \
        hairline_prepare_leaf_##SUFFIX(&leaf, triangles, place + 1);                                                   \
        return hairline_nearest_##SUFFIX(&leaf, ray, t_min, t_max, answer) == place;                                   \
    }
IN_LEAF(float, f32)
#ifndef HAIRLINE_ONLY_F32
IN_LEAF(double, f64)
#endif
#else
#define HIT(SUFFIX) hairline_hit_##SUFFIX(&triangle, &ray, c->t_min, c->t_max, &answer)
#endif

#define TEST(REAL, SUFFIX)                                                                                             \
    void hairline_test_##SUFFIX(const hairline_case_##SUFFIX *cases, size_t count, const REAL *epsilons,               \
                                hairline_verdict_##SUFFIX *verdicts) {                                                 \
        size_t i;                                                                                                      \
        (void)epsilons;                                                                                                \
        for (i = 0; i < count; i++) {                                                                                  \
            const hairline_case_##SUFFIX *c = &cases[i];                                                               \
            hairline_answer answer = {0, 0, 0, 0, 0, 0};                                                               \
            hairline_triangle_##SUFFIX triangle;                                                                       \
            hairline_ray_##SUFFIX ray;                                                                                 \
            hairline_prepare_triangle_##SUFFIX(&triangle, c->a, c->b, c->c);                                           \
            hairline_prepare_ray_##SUFFIX(&ray, c->origin, c->direction);                                              \
            verdicts[i].hit = HIT(SUFFIX);                                                                             \
            verdicts[i].facing = answer.front ? HAIRLINE_FRONT : HAIRLINE_BACK;                                        \
            verdicts[i].t = (REAL)answer.t, verdicts[i].u = (REAL)answer.u, verdicts[i].v = (REAL)answer.v;            \
        }                                                                                                              \
    }

TEST(float, f32)
#ifndef HAIRLINE_ONLY_F32
TEST(double, f64)
#endif
