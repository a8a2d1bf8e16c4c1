// Lanes of one number, for host and device, with the names of lanes_portable.h and the same bits.
#pragma once

#include <heddle/base/platform.h>

#include <cmath>
#include <cstdint>

namespace heddle::one {

struct Mask {
    bool v;
    friend HEDDLE_INLINE Mask operator&(Mask a, Mask b) { return {a.v && b.v}; }
    friend HEDDLE_INLINE Mask operator|(Mask a, Mask b) { return {a.v || b.v}; }
    [[nodiscard]] HEDDLE_INLINE std::uint32_t bits() const { return v ? 1u : 0u; }
};

struct Int {
    std::int32_t v;
    Int() = default;
    HEDDLE_INLINE explicit constexpr Int(std::int32_t x) : v(x) {}
    friend HEDDLE_INLINE Int operator+(Int a, Int b) { return Int(wrap(bits(a) + bits(b))); }
    friend HEDDLE_INLINE Int operator-(Int a, Int b) { return Int(wrap(bits(a) - bits(b))); }
    friend HEDDLE_INLINE Int operator&(Int a, Int b) { return Int(a.v & b.v); }
    friend HEDDLE_INLINE Int operator|(Int a, Int b) { return Int(a.v | b.v); }
    friend HEDDLE_INLINE Int operator<<(Int a, int n) { return Int(wrap(bits(a) << n)); }
    friend HEDDLE_INLINE Int operator>>(Int a, int n) { return Int(a.v >> n); }
    friend HEDDLE_INLINE Mask operator==(Int a, Int b) { return {a.v == b.v}; }
    friend HEDDLE_INLINE Mask operator>(Int a, Int b) { return {a.v > b.v}; }

private:
    HEDDLE_INLINE static std::uint32_t bits(Int x) { return static_cast<std::uint32_t>(x.v); }
    HEDDLE_INLINE static std::int32_t wrap(std::uint32_t x) { return static_cast<std::int32_t>(x); }
};

struct Real {
    float v;
    Real() = default;
    HEDDLE_INLINE explicit constexpr Real(float x) : v(x) {}
    friend HEDDLE_INLINE Real operator+(Real a, Real b) { return Real(a.v + b.v); }
    friend HEDDLE_INLINE Real operator-(Real a, Real b) { return Real(a.v - b.v); }
    friend HEDDLE_INLINE Real operator*(Real a, Real b) { return Real(a.v * b.v); }
    friend HEDDLE_INLINE Real operator/(Real a, Real b) { return Real(a.v / b.v); }
    friend HEDDLE_INLINE Mask operator<(Real a, Real b) { return {a.v < b.v}; }
    friend HEDDLE_INLINE Mask operator<=(Real a, Real b) { return {a.v <= b.v}; }
};

HEDDLE_INLINE Int min(Int a, Int b) {
    return a.v < b.v ? a : b;
}
HEDDLE_INLINE Int max(Int a, Int b) {
    return a.v > b.v ? a : b;
}
HEDDLE_INLINE Real min(Real a, Real b) {
    return a.v < b.v ? a : b;
}
HEDDLE_INLINE Real max(Real a, Real b) {
    return a.v > b.v ? a : b;
}
HEDDLE_INLINE Real sqrt(Real a) {
    return Real(std::sqrt(a.v));
}
HEDDLE_INLINE Real floor(Real a) {
    return Real(std::floor(a.v));
}
HEDDLE_INLINE Real ceil(Real a) {
    return Real(std::ceil(a.v));
}
HEDDLE_INLINE Real abs(Real a) {
    return Real(std::fabs(a.v));
}
HEDDLE_INLINE Real select(Mask m, Real a, Real b) {
    return m.v ? a : b;
}
HEDDLE_INLINE Int select(Mask m, Int a, Int b) {
    return m.v ? a : b;
}
HEDDLE_INLINE Real to_real(Int a) {
    return Real(static_cast<float>(a.v));
}
HEDDLE_INLINE Int to_int(Real a) { // out of range: as AVX2
    const bool fits = a.v >= -2147483648.0f && a.v < 2147483648.0f;
    return Int(fits ? static_cast<std::int32_t>(a.v) : INT32_MIN);
}

/// The argument of templates over lanes.
struct Lanes {
    using Real = one::Real;
    using Int = one::Int;
    using Mask = one::Mask;
};

} // namespace heddle::one
