/* A kernel that misbehaves on one case in 64, in the way that -DFAULT=... says: for tests/plugin.rs,
 * which knows the same rule. Everywhere else it misses. With THROW it is C++. */
#include "hairline.h"
#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define NOTHING 0
#define SEGFAULT 1
#define ABORT 2
#define EXIT 3
#define HANG 4
#define WRITE_PAST 5
#define WRITE_BEFORE 6
#define WRITE_INPUT 7
#define READ_PAST 8
#define PRINT 9
#define RETURN_NAN 10
#define NO_ANSWER 11
#define WRONG_ANSWER 12
#define OTHER_ABI 13
#define NULL_DESCRIPTION 14
#define CRASH_IN_DESCRIBE 15
#define BAD_CONTRACT 16
#define ONLY_IN_BATCHES 17
#define CLOSE_PIPES 18
#define FLUSH_AT_LOAD 19
#define ROUND_UP 20
#define THROW 21
#define BAD_GIVES 22
#define EPSILONS 23
#define UNSTEADY 24
#define BY_PLACE 25

#if FAULT == THROW
#include <stdexcept>
#endif

#if FAULT == FLUSH_AT_LOAD
/* What gcc links into a library that is built with -ffast-math. */
#include <xmmintrin.h>
__attribute__((constructor)) static void flush(void) { _mm_setcsr(_mm_getcsr() | 0x8040); }
#endif

uint32_t hairline_abi(void) { return FAULT == OTHER_ABI ? HAIRLINE_ABI + 1 : HAIRLINE_ABI; }

const hairline_kernel *hairline_describe(void) {
    static hairline_kernel kernel = {
        .name = "misbehave", .contract = "closed-ray", .gives = HAIRLINE_GIVES_T};
    static const hairline_epsilon epsilons[] = {
        {"det", "1e-9", "abs(det) < e", 2, 1, 1, 0},
        {"near", "1e-3", "t < e", 1, -1, 1, 0},
        {"slack", "1e-9", "d < e", 1, 0, 1, 0},
    };
    if (FAULT == BAD_GIVES) kernel.gives = 255;
    if (FAULT == EPSILONS) kernel.epsilons = epsilons;
    if (FAULT == EPSILONS) kernel.epsilon_count = 3;
    if (FAULT == NULL_DESCRIPTION) return NULL;
    if (FAULT == CRASH_IN_DESCRIBE) abort();
    if (FAULT == BAD_CONTRACT) kernel.contract = "closed\nray";
    return &kernel;
}

static uint64_t asked = 0;
static volatile int64_t *nowhere = NULL;
static volatile double read_value;

void hairline_test_f64(const hairline_case_f64 *cases, size_t count, const double *epsilons,
                       hairline_verdict_f64 *verdicts) {
    (void)epsilons;
    if (FAULT == ROUND_UP) fesetround(FE_UPWARD);
    if (FAULT == ONLY_IN_BATCHES && count > 1) abort();
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &cases[i].origin[0], sizeof bits);
        memset(&verdicts[i], 0, sizeof verdicts[i]);
        if (FAULT == PRINT) printf("case %zu of %zu\nHLA1", i, count);
        if (FAULT == UNSTEADY) verdicts[i].hit = asked++ % 11 == 0;
        if (FAULT == BY_PLACE) verdicts[i].hit = i % 2;
        if ((bits >> 20) % 64 != 0) continue;
        switch (FAULT) {
        case SEGFAULT: *nowhere = 1; break;
        case ABORT: abort();
        case EXIT: exit(0);
        case HANG: for (;;) sleep(1);
        case WRITE_PAST: verdicts[count].hit = 1; break;
        case WRITE_BEFORE: ((volatile char *)verdicts)[-1] = 1; break;
        case WRITE_INPUT: ((hairline_case_f64 *)cases)[i].t_max = 1; break;
        case READ_PAST: read_value = cases[count].origin[0]; break;
        case RETURN_NAN: verdicts[i].hit = 1; verdicts[i].t = NAN; break;
        case NO_ANSWER: verdicts[i].hit = -1; break;
        case WRONG_ANSWER: verdicts[i].hit = 7; break;
#if FAULT == THROW
        case THROW: throw std::out_of_range("beyond the scene");
#endif
        case CLOSE_PIPES: for (int fd = 0; fd < 256; fd++) close(fd); for (;;) sleep(1);
        default: break;
        }
    }
    if (FAULT == PRINT) fflush(stdout);
}
