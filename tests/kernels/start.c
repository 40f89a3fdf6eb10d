/* The example in C, in processes that may take long to start: for tests/plugin.rs.
 *   -DPROCESSES=N    it wants N processes at most
 *   -DFIRST=SECONDS  the first call takes so long
 *   -DCALL=SECONDS   each call with many cases takes so long
 *   -DSTARTED=FILE   each process appends a line to this file */
#define hairline_test_f64 answer_f64
#include "../../examples/c/moller_trumbore.c"
#undef hairline_test_f64
#include <stdio.h>
#include <unistd.h>

#ifndef FIRST
#define FIRST 0
#endif
#ifndef CALL
#define CALL 0
#endif

#ifdef PROCESSES
uint32_t hairline_processes(void) { return PROCESSES; }
#endif

#ifdef STARTED
__attribute__((constructor)) static void started(void) {
    FILE *file = fopen(STARTED, "a");
    if (file != NULL) fprintf(file, "%ld\n", (long)getpid()), fclose(file);
}
#endif

static void take(double seconds) { usleep((useconds_t)(seconds * 1e6)); }

void hairline_test_f64(const hairline_case_f64 *cases, size_t count, const double *epsilons,
                       hairline_verdict_f64 *verdicts) {
    static int calls = 0;
    if (calls++ == 0) take(FIRST);
    if (400 < count || 10 < CALL) take(calls == 1 ? 0 : CALL);
    answer_f64(cases, count, epsilons, verdicts);
}
