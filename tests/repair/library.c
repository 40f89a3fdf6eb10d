/* A guarded kernel of `hairline repair --emit c` as a library for hairline, in float. An ask counts as COUNTED, 0 or 1.
 * cc -O2 -shared -fPIC -Iinclude -include guarded.h -DKERNEL=moller_trumbore_f32 -DCOUNTED=0 -o libguarded.so tests/repair/library.c */
#include "hairline.h"

uint32_t hairline_abi(void) { return HAIRLINE_ABI; }

const hairline_kernel *hairline_describe(void) {
    static const hairline_kernel kernel = {
        .name = "c-guarded",
        .source = "hairline repair --emit c",
        .contract = "extent=line,sides=both,boundary=closed,invalid=free",
    };
    return &kernel;
}

#define NAME_OF(KERNEL) KERNEL##_hit
#define HIT_OF(KERNEL) NAME_OF(KERNEL)

void hairline_test_f32(const hairline_case_f32 *cases, size_t count, const float *epsilons,
                       hairline_verdict_f32 *verdicts) {
    (void)epsilons;
    for (size_t i = 0; i < count; i++) {
        const hairline_case_f32 *c = &cases[i];
        HIT_OF(KERNEL) hit;
        int answer = KERNEL(c->origin, c->direction, c->a, c->b, c->c, c->t_min, c->t_max, &hit);
        verdicts[i] = (hairline_verdict_f32){0};
        verdicts[i].hit = answer == HAIRLINE_HIT || (answer == HAIRLINE_ASK && COUNTED);
    }
}
