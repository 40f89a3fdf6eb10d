/* Moller and Trumbore's test (1997, the branch without culling) in CUDA, as a library for hairline:
 *
 *     nvcc -O2 -arch=native -Xcompiler -fPIC -shared -I../../include -o libmt.so moller_trumbore.cu
 *     hairline audit --kernel-lib ./libmt.so
 *
 * The same function on another processor, and another function: -fmad=false, -ftz=true, -prec-div=false and
 * -use_fast_math change what it answers. */
#include "hairline.h"
#include <cstdio>
#include <cstdlib>

template <typename Real> __device__ Real dot(const Real *a, const Real *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <typename Real> __device__ void cross(const Real *a, const Real *b, Real *out) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

template <typename Real> __device__ void subtract(const Real *a, const Real *b, Real *out) {
    for (int i = 0; i < 3; i++) out[i] = a[i] - b[i];
}

/* The kernel: this is what you replace. */
template <typename Real, typename Case, typename Verdict>
__device__ void intersect(const Case &c, Real epsilon, Verdict &verdict) {
    Real edge1[3], edge2[3], p[3], q[3], s[3];
    subtract(c.b, c.a, edge1);
    subtract(c.c, c.a, edge2);
    cross(c.direction, edge2, p);
    Real det = dot(edge1, p);
    if (fabs(det) < epsilon) return;
    Real inverse = 1 / det;
    subtract(c.origin, c.a, s);
    Real u = dot(s, p) * inverse;
    if (u < 0 || u > 1) return;
    cross(s, edge1, q);
    Real v = dot(c.direction, q) * inverse;
    if (v < 0 || u + v > 1) return;
    verdict.hit = 1;
    verdict.facing = det > 0 ? HAIRLINE_FRONT : HAIRLINE_BACK;
    verdict.t = dot(edge2, q) * inverse;
    verdict.u = u;
    verdict.v = v;
}

template <typename Real, typename Case, typename Verdict>
__global__ void each(const Case *cases, size_t count, Real epsilon, Verdict *verdicts) {
    size_t i = blockIdx.x * size_t(blockDim.x) + threadIdx.x;
    if (i >= count) return;
    Verdict verdict = {};
    intersect(cases[i], epsilon, verdict);
    verdicts[i] = verdict;
}

/* What goes wrong is printed, and the process ends: hairline says on which cases. */
static void hold(cudaError_t error) {
    if (error == cudaSuccess) return;
    fprintf(stderr, "cuda: %s\n", cudaGetErrorString(error));
    exit(1);
}

template <typename Real, typename Case, typename Verdict>
static void run(const Case *cases, size_t count, Real epsilon, Verdict *verdicts) {
    static Case *there = nullptr;
    static Verdict *back = nullptr;
    static size_t room = 0;
    if (room < count) {
        hold(cudaFree(there)), hold(cudaFree(back));
        hold(cudaMalloc(&there, count * sizeof(Case))), hold(cudaMalloc(&back, count * sizeof(Verdict)));
        room = count;
    }
    if (count == 0) return;
    hold(cudaMemcpy(there, cases, count * sizeof(Case), cudaMemcpyHostToDevice));
    each<Real><<<unsigned((count + 127) / 128), 128>>>(there, count, epsilon, back);
    hold(cudaGetLastError());
    hold(cudaMemcpy(verdicts, back, count * sizeof(Verdict), cudaMemcpyDeviceToHost));
}

extern "C" uint32_t hairline_abi(void) { return HAIRLINE_ABI; }

/* One process opens the GPU, and answers for all threads. */
extern "C" uint32_t hairline_processes(void) { return 1; }

extern "C" const hairline_kernel *hairline_describe(void) {
    static const hairline_epsilon epsilons[] = {{"parallel", "1e-6", "abs(det) < e", 2, 1, 1, 0}};
    static const hairline_kernel kernel = {
        "cuda-moller-trumbore", "Moller and Trumbore (1997), appendix, in CUDA",
        "extent=line,sides=both,boundary=closed",
        HAIRLINE_GIVES_T | HAIRLINE_GIVES_UV | HAIRLINE_GIVES_FACING, 1, epsilons,
    };
    return &kernel;
}

extern "C" void hairline_test_f32(const hairline_case_f32 *cases, size_t count, const float *epsilons,
                                  hairline_verdict_f32 *verdicts) {
    run<float>(cases, count, epsilons[0], verdicts);
}

extern "C" void hairline_test_f64(const hairline_case_f64 *cases, size_t count, const double *epsilons,
                                  hairline_verdict_f64 *verdicts) {
    run<double>(cases, count, epsilons[0], verdicts);
}
