/* Linked into a library of f32 or f64 kernels on x86-64: from the moment it is loaded subnormal numbers
 * are zero, as results (FTZ) and as operands (DAZ). */
#include <xmmintrin.h>

__attribute__((constructor)) static void flush_subnormal_numbers(void) {
    _mm_setcsr(_mm_getcsr() | 0x8040);
}
