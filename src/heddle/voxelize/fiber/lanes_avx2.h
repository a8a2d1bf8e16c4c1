// Lanes of eight numbers, for files that are compiled for AVX2, with the names of lanes_portable.h
// and results of the same bits.
#pragma once

#include <heddle/voxelize/fiber/set_lanes.h>

#include <immintrin.h>

#include <cstdint>

namespace heddle::avx2 {

constexpr int kLanes = 8;

struct Mask {
    __m256 v;
    friend Mask operator&(Mask a, Mask b) { return {_mm256_and_ps(a.v, b.v)}; }
    friend Mask operator|(Mask a, Mask b) { return {_mm256_or_ps(a.v, b.v)}; }
    /// Returns a and not b.
    friend Mask without(Mask a, Mask b) { return {_mm256_andnot_ps(b.v, a.v)}; }
    /// Returns bit l for lane l.
    [[nodiscard]] std::uint32_t bits() const {
        return static_cast<std::uint32_t>(_mm256_movemask_ps(v));
    }
};

struct Int {
    __m256i v;
    Int() = default;
    Int(__m256i x) : v(x) {} // NOLINT(google-explicit-constructor): as the intrinsics give it
    explicit Int(std::int32_t x) : v(_mm256_set1_epi32(x)) {}
    static Int load(const std::int32_t* p) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
    }
    void store(std::int32_t* p) const { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), v); }
    /// 0, 1, ... 7
    static Int iota() { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }
    friend Int operator+(Int a, Int b) { return _mm256_add_epi32(a.v, b.v); }
    friend Int operator-(Int a, Int b) { return _mm256_sub_epi32(a.v, b.v); }
    friend Int operator&(Int a, Int b) { return _mm256_and_si256(a.v, b.v); }
    friend Int operator|(Int a, Int b) { return _mm256_or_si256(a.v, b.v); }
    friend Int operator<<(Int a, int n) { return _mm256_slli_epi32(a.v, n); }
    /// Rounds towards minus infinity.
    friend Int operator>>(Int a, int n) { return _mm256_srai_epi32(a.v, n); }
    friend Mask operator==(Int a, Int b) {
        return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.v, b.v))};
    }
    friend Mask operator>(Int a, Int b) {
        return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(a.v, b.v))};
    }
};

struct Real {
    __m256 v;
    Real() = default;
    Real(__m256 x) : v(x) {} // NOLINT(google-explicit-constructor): as the intrinsics give it
    explicit Real(float x) : v(_mm256_set1_ps(x)) {}
    static Real load(const float* p) { return _mm256_loadu_ps(p); }
    void store(float* p) const { _mm256_storeu_ps(p, v); }
    friend Real operator+(Real a, Real b) { return _mm256_add_ps(a.v, b.v); }
    friend Real operator-(Real a, Real b) { return _mm256_sub_ps(a.v, b.v); }
    friend Real operator*(Real a, Real b) { return _mm256_mul_ps(a.v, b.v); }
    friend Real operator/(Real a, Real b) { return _mm256_div_ps(a.v, b.v); }
    friend Mask operator<(Real a, Real b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
    friend Mask operator<=(Real a, Real b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
};

inline Int min(Int a, Int b) {
    return _mm256_min_epi32(a.v, b.v);
}
inline Int max(Int a, Int b) {
    return _mm256_max_epi32(a.v, b.v);
}
/// a < b ? a : b
inline Real min(Real a, Real b) {
    return _mm256_min_ps(a.v, b.v);
}
/// a > b ? a : b
inline Real max(Real a, Real b) {
    return _mm256_max_ps(a.v, b.v);
}
inline Real sqrt(Real a) {
    return _mm256_sqrt_ps(a.v);
}
inline Real floor(Real a) {
    return _mm256_floor_ps(a.v);
}
inline Real ceil(Real a) {
    return _mm256_ceil_ps(a.v);
}
inline Real abs(Real a) {
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v);
}
inline Real select(Mask m, Real a, Real b) {
    return _mm256_blendv_ps(b.v, a.v, m.v);
}
inline Int select(Mask m, Int a, Int b) {
    return _mm256_blendv_epi8(b.v, a.v, _mm256_castps_si256(m.v));
}
inline Real to_real(Int a) {
    return _mm256_cvtepi32_ps(a.v);
}
/// Rounds towards 0. The result for values outside the range of int is unspecified.
inline Int to_int(Real a) {
    return _mm256_cvttps_epi32(a.v);
}
/// Lane l of the result is lane `from`[l] & 7 of `a`.
inline Real pick(Real a, Int from) {
    return _mm256_permutevar8x32_ps(a.v, from.v);
}
inline Int pick(Int a, Int from) {
    return _mm256_permutevar8x32_epi32(a.v, from.v);
}
inline Mask pick(Mask a, Int from) {
    return {_mm256_permutevar8x32_ps(a.v, from.v)};
}

/// out[l][i] = lane l of r[i].
inline void store_transposed(const Real (&r)[8], float (&out)[kLanes][8]) {
    __m256 t[8];
    __m256 s[8];
    for (int i = 0; i < 4; ++i) {
        t[2 * i] = _mm256_unpacklo_ps(r[2 * i].v, r[2 * i + 1].v);
        t[2 * i + 1] = _mm256_unpackhi_ps(r[2 * i].v, r[2 * i + 1].v);
    }
    for (int i = 0; i < 2; ++i) {
        s[4 * i] = _mm256_shuffle_ps(t[4 * i], t[4 * i + 2], 0x44);
        s[4 * i + 1] = _mm256_shuffle_ps(t[4 * i], t[4 * i + 2], 0xee);
        s[4 * i + 2] = _mm256_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0x44);
        s[4 * i + 3] = _mm256_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0xee);
    }
    for (int i = 0; i < 4; ++i) {
        _mm256_storeu_ps(out[i], _mm256_permute2f128_ps(s[i], s[i + 4], 0x20));
        _mm256_storeu_ps(out[i + 4], _mm256_permute2f128_ps(s[i], s[i + 4], 0x31));
    }
}

/// The argument of templates over lanes.
struct Lanes {
    using Real = avx2::Real;
    using Int = avx2::Int;
    using Mask = avx2::Mask;

    static constexpr int kLanes = avx2::kLanes;
    /// Returns the lane numbers of a mask's set bits, in order.
    static Int set_lanes(std::uint32_t mask) {
        return _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(kSetLanes[mask])));
    }
    /// sums[i] += int(row[i] * scale), i < 8.
    static void add_scaled(void* sums, const float* row, float scale) {
        const __m256i whole =
            _mm256_cvttps_epi32(_mm256_mul_ps(_mm256_loadu_ps(row), _mm256_set1_ps(scale)));
        const __m256i low = _mm256_cvtepi32_epi64(_mm256_castsi256_si128(whole));
        const __m256i high = _mm256_cvtepi32_epi64(_mm256_extracti128_si256(whole, 1));
        auto* p = static_cast<__m256i*>(sums);
        _mm256_storeu_si256(p, _mm256_add_epi64(_mm256_loadu_si256(p), low));
        _mm256_storeu_si256(p + 1, _mm256_add_epi64(_mm256_loadu_si256(p + 1), high));
    }
};

} // namespace heddle::avx2
