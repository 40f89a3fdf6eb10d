/* hairline.h: a ray-triangle kernel as a shared library, for `hairline audit --kernel-lib FILE`, or a
 * ray-box test, for `hairline boxes audit --kernel-lib FILE`.
 *
 * Build it as  cc -O2 -shared -fPIC -o libmine.so mine.c  and define the functions at
 * the end of this file, with C linkage. hairline loads the library in a process of its own. There a
 * crash, a C++ exception, a call of exit, an endless loop or an access outside the buffers is a finding
 * about the case at hand, and the run goes on. What the library prints goes to standard error.
 *
 * Everything that hairline passes belongs to hairline and is valid during the call only; everything
 * that the library returns from hairline_describe belongs to the library and must stay valid.
 * Calls come from one thread at a time; several processes may each have loaded the library, unless
 * hairline_processes says otherwise.
 *
 * The first call in each process, of each function for cases that there is, is one plain case, a hit in
 * the middle of its triangle or box. Its verdict is not judged, and what starts slowly, such as a GPU's context,
 * may take long in it (--kernel-start SECONDS, 60 by default).
 */
#ifndef HAIRLINE_H
#define HAIRLINE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this file. It is raised whenever a structure or a function changes. */
#define HAIRLINE_ABI 1u

/* A question: does the ray origin + t * direction, t_min <= t <= t_max, meet the triangle a b c?
 * Lengths are in any unit; t is in units of the direction, which has any length. Seen from its front
 * the triangle runs counter-clockwise. Families exist in which coordinates are NaN or infinite. */
typedef struct {
    float origin[3], direction[3], a[3], b[3], c[3], t_min, t_max;
} hairline_case_f32;

typedef struct {
    double origin[3], direction[3], a[3], b[3], c[3], t_min, t_max;
} hairline_case_f64;

/* A question about boxes: does the ray, t_min <= t <= t_max, meet the box of all points from min to max, its
 * faces, edges and corners included? A box may be flat, or a point. If min > max on an axis it has no points. */
typedef struct {
    float origin[3], direction[3], min[3], max[3], t_min, t_max;
} hairline_box_case_f32;

typedef struct {
    double origin[3], direction[3], min[3], max[3], t_min, t_max;
} hairline_box_case_f64;

#define HAIRLINE_FRONT 1
#define HAIRLINE_BACK 2

/* An answer. For a miss only `hit` is read. */
typedef struct {
    int32_t hit;    /* 1 for a hit, 0 for a miss; every case needs one of the two */
    int32_t facing; /* the side hit, HAIRLINE_FRONT or HAIRLINE_BACK; 0 if unknown */
    float t;        /* the ray's parameter */
    float u, v;     /* the weights of b and of c; that of a is 1 - u - v */
} hairline_verdict_f32;

typedef struct {
    int32_t hit, facing;
    double t, u, v;
} hairline_verdict_f64;

/* Which values of a hit are given. These are judged: they must be finite, and the side right. */
#define HAIRLINE_GIVES_T 1u
#define HAIRLINE_GIVES_UV 2u
#define HAIRLINE_GIVES_FACING 4u

/* An epsilon that the kernel takes. Raising it must only refuse more, whatever the others are; a tolerance
 * is negative. */
typedef struct {
    const char *name;     /* one word: `--epsilon NAME=VALUE` sets it */
    const char *value;    /* its usual value, in decimal, as "1e-6" */
    const char *refuses;  /* the comparison, as "abs(det) < e"; NULL if unknown. It may begin with what the
                           * gate is there to refuse, "role=t tau < e": parallel, t, edge or other. Usual
                           * names say it themselves: det, t, u */
    int32_t length;       /* the dimension of what is compared: the power of length ... */
    int32_t direction;    /* ... and of the direction's length. det is 2, 1; t is 1, -1; u is 0, 0 */
    int32_t non_negative; /* 1 if a negative value would mean the same as 0, else 0 */
    int32_t reserved;     /* 0 */
} hairline_epsilon;

typedef struct {
    const char *name;     /* in tables and messages: letters, digits and -_.+@ */
    const char *source;   /* what it is and of which version, in one line; NULL if unknown */
    const char *contract; /* what it promises, by the words of docs/protocol.md, as "closed-ray" or
                             "extent=ray,sides=both,boundary=free" */
    uint32_t gives;       /* HAIRLINE_GIVES_... added up */
    uint32_t epsilon_count;
    const hairline_epsilon *epsilons; /* this many; NULL if none */
} hairline_kernel;

/* What the library defines: the first two, and one or both of those that answer cases, of triangles or of boxes
 * (a library may have all four). hairline_processes is optional. */

/* Returns HAIRLINE_ABI. */
uint32_t hairline_abi(void);

/* What the kernel is and promises. */
const hairline_kernel *hairline_describe(void);

/* Optional: how many processes should load the library at most, at least 1. A library for a GPU returns 1: then one
 * process answers the cases of all threads. Without it hairline starts with one, and starts another, up to one a
 * thread, whenever its processes have worked for four times as long as one takes to start. */
uint32_t hairline_processes(void);

/* Answers `count` cases. `epsilons` has epsilon_count values in the order of hairline_describe.
 * `cases` and `epsilons` are read-only, `verdicts` has room for `count` and no more. Answers depend
 * on the case and the epsilons alone. */
void hairline_test_f32(const hairline_case_f32 *cases, size_t count, const float *epsilons,
                       hairline_verdict_f32 *verdicts);
void hairline_test_f64(const hairline_case_f64 *cases, size_t count, const double *epsilons,
                       hairline_verdict_f64 *verdicts);

/* The same for boxes. Only `hit` of a verdict counts. The contract's words mean for a box what docs/protocol.md says;
 * `extent=interval,sides=both,boundary=closed` is that of a test before what is in the box is looked at. */
void hairline_test_boxes_f32(const hairline_box_case_f32 *cases, size_t count, const float *epsilons,
                             hairline_verdict_f32 *verdicts);
void hairline_test_boxes_f64(const hairline_box_case_f64 *cases, size_t count, const double *epsilons,
                             hairline_verdict_f64 *verdicts);

#ifdef __cplusplus
}
#endif

#endif
