/* A guarded kernel whose inputs are products of its caller: rays at small triangles far off, which are scaled in the expression
 * that calls the kernel. A compiler that inlines the kernel may fuse such a product into a difference of two points, and then
 * the kernel decides about other points than those that are stored. The right answer is that of the rounded products.
 *
 *     cc -O2 -mfma -include KERNEL_SCALAR.h -DKERNEL=KERNEL_SCALAR -DDOUBLE=0 -DEXTENT=0 -DFRONT=0 products.c -lm
 *     nvcc -O3 -x cu -include KERNEL_SCALAR.cuh -DKERNEL=KERNEL_SCALAR -DDOUBLE=0 -DEXTENT=0 -DFRONT=0 products.c
 *     ./a.out COUNT SEED
 *
 * SCALED_KERNEL is a function that scales by itself, in another language; then KERNEL is not called.
 *
 * C11, C++17 and CUDA, where the kernel runs on the device. Prints how many answers were hit, miss and ask, the wrong hits and the
 * wrong misses; ends with 1 if there are any, with 77 without a device. */
#include "truth.h"

#ifdef __CUDACC__
#define FUNCTION static __host__ __device__
#else
#define FUNCTION static
#endif

/* A ray and a triangle before they are scaled, the ray by another factor. */
typedef struct {
    ray at;
    real of_ray, of_triangle;
} scaled;

#ifdef SCALED_KERNEL
/* A caller and a kernel in another language. */
int SCALED_KERNEL(const scaled *s);
static int answer_of(const scaled *s) { return SCALED_KERNEL(s); }
#else
/* Written out, because a compiler keeps an array in memory where a loop writes it, and sees no product then. */
#define SCALED(x, factor) \
    { (x)[0] * (factor), (x)[1] * (factor), (x)[2] * (factor) }

FUNCTION int answer_of(const scaled *s) {
    const real *x = s->at.x, of_ray = s->of_ray, of_triangle = s->of_triangle;
    const real o[3] = SCALED(x, of_ray), d[3] = SCALED(x + 3, of_ray);
    const real a[3] = SCALED(x + 6, of_triangle), b[3] = SCALED(x + 9, of_triangle), c[3] = SCALED(x + 12, of_triangle);
    PASTE(KERNEL, _hit) hit;
    return KERNEL(o, d, a, b, c, s->at.end[0], s->at.end[1], &hit);
}
#endif

/* What is stored: each product is rounded. */
static ray stored(const scaled *s) {
    ray r = s->at;
    int i;
    for (i = 0; i < 15; i++) {
        volatile real x = s->at.x[i] * (i < 6 ? s->of_ray : s->of_triangle);
        r.x[i] = x;
    }
    return r;
}

/* Triangles of 1 mm in 100 m as floats, and as small beside their rounding as doubles. Of every second ray only the triangle is
 * scaled. */
static scaled draw(uint64_t i, uint64_t *state) {
    const double size = DOUBLE ? 2e-12 : 1e-3, offset = 100 * uniform(state);
    const double u = (uniform(state) + 1) / 2, v = (uniform(state) + 1) / 2 * (1 - u);
    scaled s;
    double factor;
    int k;
    s.of_triangle = (real)(2 + uniform(state));
    s.of_ray = i % 2 ? s.of_triangle : 1;
    factor = i % 2 ? 1 : s.of_triangle;
    for (k = 6; k < 15; k++) s.at.x[k] = (real)(offset + size * uniform(state));
    for (k = 0; k < 3; k++) {
        const real a = s.at.x[6 + k], b = s.at.x[9 + k], c = s.at.x[12 + k];
        const double point = factor * (a + u * (b - a) + v * (c - a));
        s.at.x[k] = (real)(point + 10 * size * uniform(state));
        s.at.x[3 + k] = (real)(point - s.at.x[k]);
    }
    s.at.end[0] = 0, s.at.end[1] = (real)HUGE_VAL;
    return s;
}

#ifdef __CUDACC__
static void expect(cudaError_t error) {
    if (error == cudaSuccess) return;
    fprintf(stderr, "%s\n", cudaGetErrorString(error));
    exit(error == cudaErrorNoDevice || error == cudaErrorInsufficientDriver ? 77 : 2);
}

static __global__ void answer_each(const scaled *all, int *answers, uint64_t count) {
    const uint64_t i = blockIdx.x * (uint64_t)blockDim.x + threadIdx.x;
    if (i < count) answers[i] = answer_of(&all[i]);
}

static void answer_all(const scaled *all, int *answers, uint64_t count) {
    scaled *there;
    int *found;
    expect(cudaMalloc((void **)&there, count * sizeof *all));
    expect(cudaMalloc((void **)&found, count * sizeof *answers));
    expect(cudaMemcpy(there, all, count * sizeof *all, cudaMemcpyHostToDevice));
    answer_each<<<(unsigned)((count + 127) / 128), 128>>>(there, found, count);
    expect(cudaGetLastError());
    expect(cudaMemcpy(answers, found, count * sizeof *answers, cudaMemcpyDeviceToHost));
    expect(cudaFree(there));
    expect(cudaFree(found));
}
#else
static void answer_all(const scaled *all, int *answers, uint64_t count) {
    uint64_t i;
    for (i = 0; i < count; i++) answers[i] = answer_of(&all[i]);
}
#endif

#define BATCH 65536

int main(int count, char **words) {
    static scaled all[BATCH];
    static int answers[BATCH];
    const uint64_t rays = count > 1 ? strtoull(words[1], 0, 10) : 1000000;
    uint64_t state = count > 2 ? strtoull(words[2], 0, 10) : 1, i, done, kinds[3] = {0, 0, 0}, wrong[3] = {0, 0, 0};
    for (done = 0; done < rays; done += BATCH) {
        const uint64_t many = rays - done < BATCH ? rays - done : BATCH;
        for (i = 0; i < many; i++) all[i] = draw(i, &state);
        answer_all(all, answers, many);
        for (i = 0; i < many; i++) {
            const ray r = stored(&all[i]);
            const measures m = measured(&r);
            kinds[answers[i]]++;
            if (answers[i] == HAIRLINE_ASK) continue;
            wrong[answers[i]] += (uint64_t)is_wrong(&r, answers[i], right_of(&r, &m, i % 997 == 0));
        }
    }
    printf("all %" PRIu64 " %" PRIu64 " %" PRIu64 " wrong %" PRIu64 " %" PRIu64 "\n", kinds[HAIRLINE_HIT],
           kinds[HAIRLINE_MISS], kinds[HAIRLINE_ASK], wrong[HAIRLINE_HIT], wrong[HAIRLINE_MISS]);
    return wrong[HAIRLINE_HIT] || wrong[HAIRLINE_MISS];
}
