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
    do {{                                \
        volatile type hidden_##x = (x); \
        (x) = hidden_##x;               \
    }} while (0)
#endif
#endif

/* Sums of two inputs, or of one and another number. Where the caller's input is a product, a compiler that inlines would fuse
 * it into a plain sum, and compute with another number than the one that is stored. */
#ifndef HAIRLINE_SUMS_{upper}
#define HAIRLINE_SUMS_{upper}
#ifdef __CUDA_ARCH__
HAIRLINE_FUNCTION {real} hairline_sum_{scalar}({real} x, {real} y) {{ return __{letter}add_rn(x, y); }}
HAIRLINE_FUNCTION {real} hairline_difference_{scalar}({real} x, {real} y) {{ return __{letter}sub_rn(x, y); }}
#else
HAIRLINE_FUNCTION {real} hairline_sum_{scalar}({real} x, {real} y) {{
    HAIRLINE_BARRIER({real}, x);
    HAIRLINE_BARRIER({real}, y);
    return x + y;
}}
HAIRLINE_FUNCTION {real} hairline_difference_{scalar}({real} x, {real} y) {{
    HAIRLINE_BARRIER({real}, x);
    HAIRLINE_BARRIER({real}, y);
    return x - y;
}}
#endif
#endif
