/* A kernel that is right for every finite float and double, and more than eighty ways to spoil it, one for each value of the
 * environment variable WRONG_KERNEL: for tests/commands/wrong_kernels.rs. Without the variable nothing is spoiled.
 *
 * What is spoiled is a mistake that programs really have: an end of the ray that is ignored, a value in another unit, a
 * comparison that lets an edge through, numbers that are narrower than they look, calls that see each other's data. */
#define HAIRLINE_EDGES HAIRLINE_CLOSED
#include "hairline.h"
#include "hairline_exact.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <vector>

namespace {

/* One question, in double. */
struct Question {
    double o[3], d[3], a[3], b[3], c[3], t_min, t_max;
};

enum Group { INPUT, ENDS, VALUES, VERDICT, COMPANY };

struct Fault {
    const char *name;
    Group group;
};

const Fault FAULTS[] = {
    /* The interval. */
    {"t_min ignored", ENDS}, {"t_max ignored", ENDS}, {"both ends ignored", ENDS}, {"t_min is 0", ENDS},
    {"t_min at least 0", ENDS}, {"t_min at most 0", ENDS}, {"t_min is its size", ENDS}, {"t_max is its size", ENDS},
    {"t_max is infinite from 1e6 on", ENDS}, {"t_max at most 1e6", ENDS}, {"t_max at most 1", ENDS}, {"t_min excluded", ENDS},
    {"t_max excluded", ENDS}, {"ends exchanged if negative", ENDS}, {"t_min + 1e-4", ENDS}, {"t_max - 1e-4", ENDS},
    {"t_max * 1.01", ENDS}, {"t_min * 0.99", ENDS}, {"ends in lengths", ENDS}, {"whole line from t_min < 0 on", ENDS},
    {"size of t compared", ENDS}, {"misses beyond t = 1e6", ENDS}, {"t counted from t_min", ENDS}, {"end - start for the end", ENDS},
    {"last float before t_max", ENDS},
    /* Values. */
    {"2 t", VALUES}, {"-t", VALUES}, {"t + 1", VALUES}, {"t |d|", VALUES}, {"t |d|^2", VALUES}, {"t / |d|", VALUES},
    {"t - t_min", VALUES}, {"t clamped to t_max / 2", VALUES}, {"t as a share of the interval", VALUES}, {"size of t", VALUES},
    {"t in thousandths", VALUES}, {"t + 1e-3", VALUES}, {"t (1 + 1e-4)", VALUES}, {"t is t_min", VALUES},
    {"t of vertex a", VALUES}, {"t is NaN", VALUES}, {"t is infinite", VALUES}, {"u and v exchanged", VALUES}, {"w for u", VALUES},
    {"w for v", VALUES}, {"u is 0", VALUES}, {"u and v are halves", VALUES}, {"u negative", VALUES}, {"u + 1e-3", VALUES},
    {"v times 1.001", VALUES}, {"u, v not divided", VALUES}, {"u in bytes", VALUES}, {"u is NaN", VALUES}, {"side exchanged", VALUES},
    {"always the front", VALUES}, {"t in half", VALUES}, {"u, v in half", VALUES},
    /* Verdicts. */
    {"always a hit", VERDICT}, {"always a miss", VERDICT}, {"a hit of the plane", VERDICT}, {"a parallelogram", VERDICT},
    {"back misses", VERDICT}, {"front misses", VERDICT}, {"edge ab misses", VERDICT}, {"vertices miss", VERDICT},
    {"u tolerance 1e-3", VERDICT}, {"u tolerance -1e-3", VERDICT}, {"u + v to 1.001", VERDICT}, {"u + v not tested", VERDICT},
    {"v not tested", VERDICT}, {"small determinants miss", VERDICT}, {"grazing rays miss", VERDICT}, {"NaN is a hit", VERDICT},
    /* Inputs. */
    {"vertex a moved", INPUT}, {"origin rounded to 2^-8", INPUT}, {"coordinates in half", INPUT}, {"coordinates beyond 2^24 cut", INPUT},
    {"coordinates beyond 2^31 cut", INPUT}, {"direction in half", INPUT}, {"direction unitised", INPUT}, {"y and z exchanged for a", INPUT},
    {"small coordinates are 0", INPUT}, {"d_x at least 1e-6", INPUT}, {"computed in float", INPUT}, {"negative zero is small", INPUT},
    {"b and c exchanged", INPUT},
    /* Company. */
    {"a NaN spoils its group of eight", COMPANY}, {"an infinity spoils its group of eight", COMPANY},
    {"a cache keyed by a and b", COMPANY}, {"a cache keyed by b and c", COMPANY}, {"a cache keyed by c and a", COMPANY},
    {"a cache of the interval keyed by the ray", COMPANY}, {"wrong after 2^24 calls", COMPANY},
    {"the previous answer, one in eight", COMPANY}, {"the first of a batch is missed", COMPANY},
    {"the last of a batch is missed", COMPANY}, {"t_max shrinks along a batch", COMPANY},
};

const int COUNT = sizeof FAULTS / sizeof *FAULTS;

/* The name of the fault in force; empty if there is none. */
const char *fault() {
    static const char *chosen = std::getenv("WRONG_KERNEL");
    return chosen ? chosen : "";
}

bool is(const char *name) { return std::strcmp(fault(), name) == 0; }

double dot(const double *x, const double *y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

double length(const double *x) { return std::sqrt(dot(x, x)); }

void cross(const double *x, const double *y, double *out) {
    out[0] = x[1] * y[2] - x[2] * y[1];
    out[1] = x[2] * y[0] - x[0] * y[2];
    out[2] = x[0] * y[1] - x[1] * y[0];
}

void normal(const Question &q, double *out) {
    double e[3], f[3];
    for (int i = 0; i < 3; i++) e[i] = q.b[i] - q.a[i], f[i] = q.c[i] - q.a[i];
    cross(e, f, out);
}

/* A number in half precision: 11 bits; the range is not cut. */
double half(double x) {
    int exponent;
    double significand = std::frexp(x, &exponent);
    return std::isfinite(x) ? std::ldexp(std::nearbyint(significand * 2048) / 2048, exponent) : x;
}

/* As much of a number as an integer of so many bits has. */
double cut(double x, double limit) { return std::fabs(x) < limit ? x : std::copysign(limit, x); }

void each(Question &q, double (*change)(double)) {
    for (double *v : {q.o, q.a, q.b, q.c})
        for (int i = 0; i < 3; i++) v[i] = change(v[i]);
}

void spoil_input(Question &q) {
    if (is("vertex a moved")) q.a[0] += 1e-3 * std::fabs(q.b[0] - q.a[0]);
    if (is("origin rounded to 2^-8")) for (double &x : q.o) x = std::nearbyint(x * 256) / 256;
    if (is("coordinates in half")) each(q, half);
    if (is("coordinates beyond 2^24 cut")) each(q, [](double x) { return cut(x, 16777216.0); });
    if (is("coordinates beyond 2^31 cut")) each(q, [](double x) { return cut(x, 2147483648.0); });
    if (is("direction in half")) for (double &x : q.d) x = half(x);
    if (is("direction unitised")) {
        double size = length(q.d);
        if (size > 0 && std::isfinite(size)) for (double &x : q.d) x /= size;
    }
    if (is("y and z exchanged for a")) { double y = q.a[1]; q.a[1] = q.a[2]; q.a[2] = y; }
    if (is("small coordinates are 0")) each(q, [](double x) { return std::fabs(x) < 1e-7 ? 0 : x; });
    if (is("d_x at least 1e-6") && std::fabs(q.d[0]) < 1e-6) q.d[0] = std::copysign(1e-6, q.d[0]);
    if (is("negative zero is small")) each(q, [](double x) { return x == 0 && std::signbit(x) ? -1e-3 : x; });
    if (is("b and c exchanged")) for (int i = 0; i < 3; i++) { double x = q.b[i]; q.b[i] = q.c[i]; q.c[i] = x; }
}

/* The next number of so many bits, towards another. */
double next(double x, double to, bool is_float) {
    return is_float ? (double)std::nextafter((float)x, (float)to) : std::nextafter(x, to);
}

void spoil_ends(Question &q, bool is_float, double widest) {
    double lo = q.t_min, hi = q.t_max, infinity = std::numeric_limits<double>::infinity();
    if (is("t_min ignored")) q.t_min = -infinity;
    if (is("t_max ignored")) q.t_max = infinity;
    if (is("both ends ignored")) q.t_min = -infinity, q.t_max = infinity;
    if (is("t_min is 0")) q.t_min = 0;
    if (is("t_min at least 0")) q.t_min = lo > 0 ? lo : 0;
    if (is("t_min at most 0")) q.t_min = lo < 0 ? lo : 0;
    if (is("t_min is its size")) q.t_min = std::fabs(lo);
    if (is("t_max is its size")) q.t_max = std::fabs(hi);
    if (is("t_max is infinite from 1e6 on") && hi > 1e6) q.t_max = infinity;
    if (is("t_max at most 1e6") && hi > 1e6) q.t_max = 1e6;
    if (is("t_max at most 1") && hi > 1) q.t_max = 1;
    if (is("t_min excluded")) q.t_min = next(lo, infinity, is_float);
    if (is("t_max excluded")) q.t_max = next(hi, -infinity, is_float);
    if (is("ends exchanged if negative") && lo < 0) q.t_min = -hi, q.t_max = -lo;
    if (is("t_min + 1e-4")) q.t_min = lo + 1e-4;
    if (is("t_max - 1e-4")) q.t_max = hi - 1e-4;
    if (is("t_max * 1.01")) q.t_max = hi * (hi > 0 ? 1.5 : 0.5);
    if (is("t_min * 0.99")) q.t_min = lo * (lo > 0 ? 0.5 : 1.5);
    if (is("ends in lengths")) q.t_min = lo / length(q.d), q.t_max = hi / length(q.d);
    if (is("whole line from t_min < 0 on") && lo < 0) q.t_min = -infinity;
    if (is("last float before t_max")) q.t_max = hi - widest * std::fabs(hi);
    if (is("end - start for the end")) q.t_max = hi - lo;
    if (is("t counted from t_min")) q.t_min = 0, q.t_max = hi - lo;
}

/* The verdict of another test than the right one. */
int other_verdict(const Question &q, int hit, hairline_answer &answer) {
    hairline_answer line = {0, 0, 0, 0, 0, 0};
    if (is("always a hit")) { answer.hit = 1; return 1; }
    if (is("always a miss")) return 0;
    if (is("back misses")) return hit && answer.front;
    if (is("front misses")) return hit && !answer.front;
    if (is("edge ab misses")) return hit && answer.v != 0;
    if (is("vertices miss")) return hit && answer.u != 1 && answer.v != 1 && (answer.u != 0 || answer.v != 0);
    if (is("size of t compared") || is("misses beyond t = 1e6")) {
        double infinity = std::numeric_limits<double>::infinity();
        if (!hairline_exact_f64(q.o, q.d, q.a, q.b, q.c, -infinity, infinity, &line)) return hit;
        double size = std::fabs(line.t);
        if (is("misses beyond t = 1e6")) return hit && size <= 1e6;
        int counts = size >= q.t_min && size <= q.t_max;
        if (counts) answer = line;
        return counts;
    }
    double n[3], to[3], offset[3], e[3], f[3], p[3];
    normal(q, n);
    double det = dot(n, q.d);
    if (is("small determinants miss")) return hit && std::fabs(det) > 1e-6;
    if (is("grazing rays miss")) return hit && std::fabs(det) > 1e-3 * length(n) * length(q.d);
    for (int i = 0; i < 3; i++) {
        to[i] = q.a[i] - q.o[i], e[i] = q.b[i] - q.a[i], f[i] = q.c[i] - q.a[i];
        offset[i] = -to[i];
    }
    double t = dot(n, to) / det;
    cross(q.d, f, p);
    double u = -dot(offset, p) / -dot(e, p);
    cross(offset, e, p);
    double v = dot(q.d, p) / -det;
    bool ends = t >= q.t_min && t <= q.t_max && det != 0 && std::isfinite(t) && std::isfinite(u) && std::isfinite(v);
    bool inside = hit;
    if (is("a hit of the plane")) inside = ends;
    if (is("a parallelogram")) inside = ends && u >= 0 && u <= 1 && v >= 0 && v <= 1;
    if (is("u tolerance 1e-3")) inside = ends && u >= -1e-3 && v >= 0 && u + v <= 1;
    if (is("u tolerance -1e-3")) inside = hit && u >= 1e-3;
    if (is("u + v to 1.001")) inside = ends && u >= 0 && v >= 0 && u + v <= 1.001;
    if (is("u + v not tested")) inside = ends && u >= 0 && v >= 0;
    if (is("v not tested")) inside = ends && u >= 0 && u + v <= 1;
    if (inside && !hit) answer.hit = 1, answer.front = det < 0, answer.t = t, answer.u = u, answer.v = v;
    return inside;
}

void spoil_values(const Question &q, hairline_answer &it) {
    double t = it.t, u = it.u, v = it.v, size = length(q.d), infinity = std::numeric_limits<double>::infinity();
    if (is("2 t")) it.t = 2 * t;
    if (is("-t")) it.t = -t;
    if (is("t + 1")) it.t = t + 1;
    if (is("t |d|")) it.t = t * size;
    if (is("t |d|^2")) it.t = t * size * size;
    if (is("t / |d|")) it.t = t / size;
    if (is("t - t_min")) it.t = t - q.t_min;
    if (is("t clamped to t_max / 2")) it.t = t > q.t_max / 2 ? q.t_max / 2 : t;
    if (is("t as a share of the interval") && std::isfinite(q.t_max)) it.t = (t - q.t_min) / (q.t_max - q.t_min);
    if (is("size of t")) it.t = std::fabs(t);
    if (is("t in thousandths")) it.t = t * 1000;
    if (is("t + 1e-3")) it.t = t + 1e-3;
    if (is("t (1 + 1e-4)")) it.t = t * (1 + 1e-4);
    if (is("t is t_min")) it.t = q.t_min;
    if (is("t of vertex a")) { double to[3]; for (int i = 0; i < 3; i++) to[i] = q.a[i] - q.o[i]; it.t = length(to) / size; }
    if (is("t is NaN")) it.t = std::nan("");
    if (is("t is infinite")) it.t = infinity;
    if (is("u and v exchanged")) it.u = v, it.v = u;
    if (is("w for u")) it.u = 1 - u - v;
    if (is("w for v")) it.v = 1 - u - v;
    if (is("u is 0")) it.u = 0;
    if (is("u and v are halves")) it.u = it.v = 0.5;
    if (is("u negative")) it.u = -u;
    if (is("u + 1e-3")) it.u = u + 1e-3;
    if (is("v times 1.001")) it.v = v * 1.001;
    if (is("u, v not divided")) { double n[3]; normal(q, n); double det = std::fabs(dot(n, q.d)); it.u = u * det, it.v = v * det; }
    if (is("u in bytes")) it.u = std::nearbyint(u * 255) / 255;
    if (is("u is NaN")) it.u = std::nan("");
    if (is("side exchanged")) it.front = !it.front;
    if (is("always the front")) it.front = 1;
    if (is("t in half")) it.t = half(t);
    if (is("u, v in half")) it.u = half(u), it.v = half(v);
}

bool has_nan(const Question &q) {
    const double *numbers = q.o;
    for (int i = 0; i < 15; i++) if (std::isnan(numbers[i])) return true;
    return std::isnan(q.t_min) || std::isnan(q.t_max);
}

/* Of a coordinate: t_max is infinite more often than not. */
bool has_infinity(const Question &q) {
    const double *numbers = q.o;
    for (int i = 0; i < 15; i++) if (std::isinf(numbers[i])) return true;
    return false;
}

/* The answer to a question whose numbers have so many bits: `widest` is half an ulp of 1. */
int answer_to(Question q, bool is_float, double widest, hairline_answer &answer) {
    if (has_nan(q)) { answer.hit = is("NaN is a hit"); return answer.hit; }
    Question asked = q;
    spoil_input(q);
    spoil_ends(q, is_float, widest);
    int hit;
    if (is_float || is("computed in float")) {
        float v[5][3];
        const double *from[5] = {q.o, q.d, q.a, q.b, q.c};
        for (int k = 0; k < 5; k++) for (int i = 0; i < 3; i++) v[k][i] = (float)from[k][i];
        hit = hairline_exact_f32(v[0], v[1], v[2], v[3], v[4], (float)q.t_min, (float)q.t_max, &answer);
    } else {
        hit = hairline_exact_f64(q.o, q.d, q.a, q.b, q.c, q.t_min, q.t_max, &answer);
    }
    hit = other_verdict(q, hit, answer);
    if (hit && is("t counted from t_min")) answer.t += asked.t_min;
    if (hit) spoil_values(asked, answer);
    return hit;
}

/* Calls so far, of this process. */
unsigned long long calls = 0;

template <class Case> Question read(const Case &c) {
    Question q;
    for (int i = 0; i < 3; i++)
        q.o[i] = c.origin[i], q.d[i] = c.direction[i], q.a[i] = c.a[i], q.b[i] = c.b[i], q.c[i] = c.c[i];
    q.t_min = c.t_min, q.t_max = c.t_max;
    return q;
}

template <class Case, class Verdict, class Real>
void test(const Case *cases, size_t count, Verdict *verdicts, bool is_float, Real widest) {
    static Case cached;
    static bool has_cached = false;
    /* So that 2^24 calls take no longer than those of a plain kernel, a batch that is asked again is not computed again. */
    static std::vector<Case> batch;
    static std::vector<Verdict> answers;
    if (is("wrong after 2^24 calls") && count == batch.size() && !std::memcmp(cases, batch.data(), count * sizeof(Case))) {
        calls += count;
        std::copy(answers.begin(), answers.end(), verdicts);
        for (size_t i = 0; calls > (1u << 24) && i < count; i++) verdicts[i].hit = 0;
        return;
    }
    for (size_t i = 0; i < count; i++) {
        Question q = read(cases[i]);
        Verdict &verdict = verdicts[i];
        const Case &asked = cases[i];
        auto same = [&](const Real *before, const Real *now) { return has_cached && !std::memcmp(before, now, 3 * sizeof(Real)); };
        bool same_a = same(cached.a, asked.a), same_b = same(cached.b, asked.b), same_c = same(cached.c, asked.c);
        bool same_ray = same(cached.origin, asked.origin) && same(cached.direction, asked.direction);
        bool is_kept = (is("a cache keyed by a and b") && same_a && same_b) || (is("a cache keyed by b and c") && same_b && same_c) ||
                       (is("a cache keyed by c and a") && same_c && same_a) ||
                       (is("a cache of the interval keyed by the ray") && same_ray);
        if (!is_kept) cached = asked, has_cached = true;
        for (int k = 0; k < 3; k++) {
            if (is("a cache keyed by a and b")) q.c[k] = cached.c[k];
            if (is("a cache keyed by b and c")) q.a[k] = cached.a[k];
            if (is("a cache keyed by c and a")) q.b[k] = cached.b[k];
        }
        if (is("a cache of the interval keyed by the ray")) q.t_min = cached.t_min, q.t_max = cached.t_max;
        if (is("t_max shrinks along a batch") && i > 0 && verdicts[i - 1].hit && verdicts[i - 1].t < q.t_max) q.t_max = verdicts[i - 1].t;
        hairline_answer answer = {0, 0, 0, 0, 0, 0};
        verdict.hit = answer_to(q, is_float, widest, answer);
        verdict.facing = answer.front ? HAIRLINE_FRONT : HAIRLINE_BACK;
        verdict.t = (Real)answer.t, verdict.u = (Real)answer.u, verdict.v = (Real)answer.v;
        calls++;
        if (is("wrong after 2^24 calls") && calls > (1u << 24)) verdict.hit = 0;
        if (is("the previous answer, one in eight") && i > 0 && i % 8 == 0) verdict = verdicts[i - 1];
        if (is("the first of a batch is missed") && i == 0) verdict.hit = 0;
        if (is("the last of a batch is missed") && i + 1 == count) verdict.hit = 0;
    }
    batch.assign(cases, cases + count);
    answers.assign(verdicts, verdicts + count);
    bool by_nan = is("a NaN spoils its group of eight"), by_infinity = is("an infinity spoils its group of eight");
    for (size_t start = 0; (by_nan || by_infinity) && start < count; start += 8) {
        bool spoiled = false;
        for (size_t i = start; i < count && i < start + 8; i++) {
            Question q = read(cases[i]);
            spoiled |= by_nan ? has_nan(q) : has_infinity(q);
        }
        for (size_t i = start; spoiled && i < count && i < start + 8; i++) verdicts[i].hit = 0;
    }
}

} // namespace

extern "C" {

uint32_t hairline_abi(void) { return HAIRLINE_ABI; }

const hairline_kernel *hairline_describe(void) {
    static const hairline_kernel kernel = {
        "spoiled", "tests/kernels/wrong_kernels.cpp", "closed-interval,across=at-least-one",
        HAIRLINE_GIVES_T | HAIRLINE_GIVES_UV | HAIRLINE_GIVES_FACING, 0, 0};
    return &kernel;
}

void hairline_test_f32(const hairline_case_f32 *cases, size_t count, const float *, hairline_verdict_f32 *verdicts) {
    test(cases, count, verdicts, true, 5.9604644775390625e-8f);
}

void hairline_test_f64(const hairline_case_f64 *cases, size_t count, const double *, hairline_verdict_f64 *verdicts) {
    test(cases, count, verdicts, false, 1.1102230246251565e-16);
}

/* The faults, for the test that tries each. */
int wrong_kernel_count(void) { return COUNT; }
const char *wrong_kernel_name(int i) { return FAULTS[i].name; }
}
