#ifndef {guard}
#define {guard}

#include <float.h>
#include <math.h>

#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(__ASSOCIATIVE_MATH__)
#error "-ffast-math changes results: compile without it, and without -ffinite-math-only and -fassociative-math"
#endif
/* 16 and 32 are about types narrower than float. */
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16 && FLT_EVAL_METHOD != 32
#error "float and double have to be rounded to their own precision, as with -msse2 -mfpmath=sse"
#endif

#ifndef HAIRLINE_ANSWERS
#define HAIRLINE_ANSWERS
enum {{ HAIRLINE_MISS = 0, HAIRLINE_HIT = 1, HAIRLINE_ASK = 2 }};
#endif

{sums}
#ifndef HAIRLINE_SURE_{upper}
#define HAIRLINE_SURE_{upper}
/* How far from zero a number must be for its sign to be right. */
HAIRLINE_FUNCTION {real} hairline_margin_of_{scalar}({real} size, {real} factor) {{ return factor * size + {tiny}; }}

/* The sign of x, -1 or 1, if rounding cannot have changed it; otherwise 0. No branch: signs are hard to predict. */
HAIRLINE_FUNCTION int hairline_sure_sign_{scalar}({real} x, {real} size, {real} factor) {{
    const {real} margin = hairline_margin_of_{scalar}(size, factor);
    return ((x > margin) & (x <= {most})) - ((x < -margin) & (x >= -{most}));
}}

/* The sign of an input, or of a difference of two. */
HAIRLINE_FUNCTION int hairline_exact_sign_{scalar}({real} x) {{
    return ((x > 0) & (x <= {most})) - ((x < 0) & (x >= -{most}));
}}

HAIRLINE_FUNCTION {real} hairline_lesser_{scalar}({real} x, {real} y) {{ return x < y ? x : y; }}
HAIRLINE_FUNCTION {real} hairline_greater_{scalar}({real} x, {real} y) {{ return x > y ? x : y; }}
#endif

typedef struct {{
    {real} {given};
}} {name}_hit;

/* HAIRLINE_HIT, with *answer; HAIRLINE_MISS or HAIRLINE_ASK. Vectors are arrays of three: the ray o + t * d, the triangle abc. */
HAIRLINE_FUNCTION int {name}({inputs}) {{
    const {real} SLACK = {slack};
{body}
}}

#ifdef HAIRLINE_ASK_EXACT
/* The same, 1 for a hit and 0 for a miss, with the exact test of hairline where it asks. */
#include "hairline_exact.h"
HAIRLINE_FUNCTION int {name}_exact({inputs}) {{
    hairline_answer exact;
    const int found = {name}(o, d, a, b, c, t_min, t_max, answer);
    if (found != HAIRLINE_ASK) return found;
{unused}    if (!hairline_exact_{scalar}(o, d, a, b, c, {ends}, &exact){of_front}) return 0;
{copied}    return 1;
}}
#endif

#endif
