// A number that computes as some device may: each operation gives one of the results that WGSL permits.
//
// Include it, then write `#define float permitted` before the kernel's own text. So the same text that runs in a
// shader is audited in every way that a shader may run it: permitted.cpp does so.
//
// WGSL (W3C, section 15.7) wants a sum, a difference or a product to be one of the two floats around the exact result,
// not the nearer one, and a quotient to be within 2.5 units in the last place if the divisor is from 2^-126 to 2^126.
// A product may be fused into a sum where that is as accurate, and a subnormal number may be zero. Vulkan wants no more of SPIR-V where a shader
// declares nothing else. The draw depends on the seed and the operands alone, in their order, and for a sum on the factors
// of a term that is a product. WGSL lets a device reorder sums, too; that is not done here, so what is drawn is a part of
// what is permitted.
#pragma once
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>

struct permitted {
    float value;
    // The factors, if this is a product.
    bool is_product;
    float factor, other_factor;

    permitted() : permitted(0.0f) {}
    permitted(int given) : permitted(static_cast<float>(given)) {}
    permitted(double given) : permitted(static_cast<float>(given)) {}
    // A number of the caller's, or a result.
    permitted(float given) : value(given), is_product(false), factor(0), other_factor(0) {
        const bool is_subnormal = given != 0 && std::fabs(given) < FLT_MIN;
        if (is_subnormal && draw(FLUSH, given, 0, 0, 2) == 1) value = 0;
    }

    // Other numbers are other draws; a seed of 0 draws the nearest result always, flushes nothing and fuses nothing.
    static uint64_t &seed() {
        static uint64_t chosen = 1;
        return chosen;
    }

    enum operation { SUM = 1, PRODUCT, FUSED, QUOTIENT, FUSE, FLUSH };

    // A number below `ways`; 0 if nothing is to be drawn. A step of splitmix64 for each word.
    static uint64_t draw(operation kind, float a, float b, float c, uint64_t ways) {
        if (seed() == 0) return 0;
        uint64_t mixed = seed() * 8 + kind;
        const float numbers[] = {a, b, c};
        for (const float number : numbers) {
            uint32_t bits;
            std::memcpy(&bits, &number, sizeof bits);
            mixed = (mixed ^ bits) + 0x9e3779b97f4a7c15u;
            mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9u;
            mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebu;
            mixed ^= mixed >> 31;
        }
        return mixed % ways;
    }

    // One of the two floats around an exact result, which a double holds or nearly: where it rounds to a float, that
    // float counts as exact. What is too large for any float is infinite.
    static float either(double exact, uint64_t drawn) {
        const float nearest = static_cast<float>(exact);
        if (drawn == 0 || std::isinf(nearest) || nearest == exact) return nearest;
        return std::nextafterf(nearest, exact > nearest ? INFINITY : -INFINITY);
    }

    // A product's sum with another number, fused or not.
    static bool fused(const permitted &product, float term, permitted &sum) {
        const float a = product.factor, b = product.other_factor;
        if (!product.is_product || draw(FUSE, a, b, term, 2) == 0) return false;
        sum = either(static_cast<double>(a) * b + term, draw(FUSED, a, b, term, 2));
        return true;
    }

    friend permitted operator+(const permitted &a, const permitted &b) {
        permitted sum;
        if (fused(a, b.value, sum) || fused(b, a.value, sum)) return sum;
        return either(static_cast<double>(a.value) + b.value, draw(SUM, a.value, b.value, 0, 2));
    }
    friend permitted operator-(const permitted &a) {
        permitted negative = a;
        negative.value = -a.value;
        negative.factor = -a.factor;
        return negative;
    }
    friend permitted operator-(const permitted &a, const permitted &b) { return a + -b; }
    friend permitted operator*(const permitted &a, const permitted &b) {
        permitted product = either(static_cast<double>(a.value) * b.value, draw(PRODUCT, a.value, b.value, 0, 2));
        product.is_product = true;
        product.factor = a.value;
        product.other_factor = b.value;
        return product;
    }
    // Any float within 2.5 units of the exact quotient. A unit is the least distance of two floats around the exact number, so
    // beside a power of two it is that of the floats below.
    friend permitted operator/(const permitted &a, const permitted &b) {
        float quotient = a.value / b.value;
        const float size = std::fabs(b.value);
        if (!std::isnormal(quotient) || size < FLT_MIN || size > 0x1p126f) return quotient;
        const int64_t drawn = static_cast<int64_t>(draw(QUOTIENT, a.value, b.value, 0, 5));
        // 0 to 2 steps up, or 1 or 2 down.
        const float end = drawn <= 2 ? INFINITY : -INFINITY;
        for (int64_t i = drawn <= 2 ? drawn : drawn - 2; i > 0; i--) {
            const float next = std::nextafterf(quotient, end);
            if (!is_within(next, a.value, b.value)) break;
            quotient = next;
        }
        return quotient;
    }
    // True if a float is certainly within 2.5 units of a quotient. |q b - a| is rounded once to a double, by far less than is left.
    static bool is_within(float q, float a, float b) {
        const double exact = static_cast<double>(a) / b;
        const float below = std::nextafterf(std::fabs(static_cast<float>(exact)), 0);
        const double unit = static_cast<double>(std::fabs(static_cast<float>(exact))) - below;
        return std::isnormal(q) && std::fabs(q - exact) <= 2.49 * unit;
    }

    friend bool operator<(const permitted &a, const permitted &b) { return a.value < b.value; }
    friend bool operator>(const permitted &a, const permitted &b) { return a.value > b.value; }
    friend bool operator<=(const permitted &a, const permitted &b) { return a.value <= b.value; }
    friend bool operator>=(const permitted &a, const permitted &b) { return a.value >= b.value; }
    friend bool operator==(const permitted &a, const permitted &b) { return a.value == b.value; }
    friend bool operator!=(const permitted &a, const permitted &b) { return a.value != b.value; }
    friend permitted fabsf(const permitted &a) {
        permitted size = a;
        size.value = std::fabs(a.value);
        size.is_product = false;
        return size;
    }
};
