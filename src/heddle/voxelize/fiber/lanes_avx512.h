// Lanes of sixteen numbers, for files that are compiled for AVX-512, with the names of
// lanes_portable.h and results of the same bits.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace heddle::avx512 {

constexpr int kLanes = 16;

struct Mask {
    __mmask16 v;
    friend Mask operator&(Mask a, Mask b) { return {_kand_mask16(a.v, b.v)}; }
    friend Mask operator|(Mask a, Mask b) { return {_kor_mask16(a.v, b.v)}; }
    /// Returns a and not b.
    friend Mask without(Mask a, Mask b) { return {_kandn_mask16(b.v, a.v)}; }
    /// Returns bit l for lane l.
    [[nodiscard]] std::uint32_t bits() const { return _cvtmask16_u32(v); }
};

struct Int {
    __m512i v;
    Int() = default;
    Int(__m512i x) : v(x) {} // NOLINT(google-explicit-constructor): as the intrinsics give it
    explicit Int(std::int32_t x) : v(_mm512_set1_epi32(x)) {}
    static Int load(const std::int32_t* p) { return _mm512_loadu_si512(p); }
    void store(std::int32_t* p) const { _mm512_storeu_si512(p, v); }
    /// 0, 1, ... 15
    static Int iota() {
        return _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    }
    friend Int operator+(Int a, Int b) { return _mm512_add_epi32(a.v, b.v); }
    friend Int operator-(Int a, Int b) { return _mm512_sub_epi32(a.v, b.v); }
    friend Int operator&(Int a, Int b) { return _mm512_and_si512(a.v, b.v); }
    friend Int operator|(Int a, Int b) { return _mm512_or_si512(a.v, b.v); }
    friend Int operator<<(Int a, int n) { return _mm512_sll_epi32(a.v, _mm_cvtsi32_si128(n)); }
    /// Rounds towards minus infinity.
    friend Int operator>>(Int a, int n) { return _mm512_sra_epi32(a.v, _mm_cvtsi32_si128(n)); }
    friend Mask operator==(Int a, Int b) { return {_mm512_cmpeq_epi32_mask(a.v, b.v)}; }
    friend Mask operator>(Int a, Int b) { return {_mm512_cmpgt_epi32_mask(a.v, b.v)}; }
};

struct Real {
    __m512 v;
    Real() = default;
    Real(__m512 x) : v(x) {} // NOLINT(google-explicit-constructor): as the intrinsics give it
    explicit Real(float x) : v(_mm512_set1_ps(x)) {}
    static Real load(const float* p) { return _mm512_loadu_ps(p); }
    void store(float* p) const { _mm512_storeu_ps(p, v); }
    friend Real operator+(Real a, Real b) { return _mm512_add_ps(a.v, b.v); }
    friend Real operator-(Real a, Real b) { return _mm512_sub_ps(a.v, b.v); }
    friend Real operator*(Real a, Real b) { return _mm512_mul_ps(a.v, b.v); }
    friend Real operator/(Real a, Real b) { return _mm512_div_ps(a.v, b.v); }
    friend Mask operator<(Real a, Real b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
    friend Mask operator<=(Real a, Real b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)}; }
};

inline Int min(Int a, Int b) {
    return _mm512_min_epi32(a.v, b.v);
}
inline Int max(Int a, Int b) {
    return _mm512_max_epi32(a.v, b.v);
}
/// a < b ? a : b
inline Real min(Real a, Real b) {
    return _mm512_min_ps(a.v, b.v);
}
/// a > b ? a : b
inline Real max(Real a, Real b) {
    return _mm512_max_ps(a.v, b.v);
}
inline Real sqrt(Real a) {
    return _mm512_sqrt_ps(a.v);
}
inline Real floor(Real a) {
    return _mm512_roundscale_ps(a.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}
inline Real ceil(Real a) {
    return _mm512_roundscale_ps(a.v, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
}
inline Real abs(Real a) {
    return _mm512_abs_ps(a.v);
}
inline Real select(Mask m, Real a, Real b) {
    return _mm512_mask_blend_ps(m.v, b.v, a.v);
}
inline Int select(Mask m, Int a, Int b) {
    return _mm512_mask_blend_epi32(m.v, b.v, a.v);
}
inline Real to_real(Int a) {
    return _mm512_cvtepi32_ps(a.v);
}
/// Rounds towards 0. The result for values outside the range of int is unspecified.
inline Int to_int(Real a) {
    return _mm512_cvttps_epi32(a.v);
}
/// Lane l of the result is lane `from`[l] & 15 of `a`.
inline Real pick(Real a, Int from) {
    return _mm512_permutexvar_ps(from.v, a.v);
}
inline Int pick(Int a, Int from) {
    return _mm512_permutexvar_epi32(from.v, a.v);
}
inline Mask pick(Mask a, Int from) {
    return {_mm512_movepi32_mask(_mm512_permutexvar_epi32(from.v, _mm512_movm_epi32(a.v)))};
}

/// out[l][i] = lane l of r[i].
inline void store_transposed(const Real (&r)[8], float (&out)[kLanes][8]) {
    const __m512i place = _mm512_slli_epi32(Int::iota().v, 3);
    for (int i = 0; i < 8; ++i) _mm512_i32scatter_ps(&out[0][i], place, r[i].v, 4);
}

/// The argument of templates over lanes.
struct Lanes {
    using Real = avx512::Real;
    using Int = avx512::Int;
    using Mask = avx512::Mask;

    static constexpr int kLanes = avx512::kLanes;
    /// Returns the lane numbers of a mask's set bits, in order, followed by zeros.
    static Int set_lanes(std::uint32_t mask) {
        return _mm512_maskz_compress_epi32(_cvtu32_mask16(mask), Int::iota().v);
    }
    /// sums[i] += int(row[i] * scale), i < 8.
    static void add_scaled(void* sums, const float* row, float scale) {
        const __m256i whole =
            _mm256_cvttps_epi32(_mm256_mul_ps(_mm256_loadu_ps(row), _mm256_set1_ps(scale)));
        const __m512i all = _mm512_cvtepi32_epi64(whole);
        _mm512_storeu_si512(sums, _mm512_add_epi64(_mm512_loadu_si512(sums), all));
    }
};

} // namespace heddle::avx512
