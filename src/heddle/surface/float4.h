#pragma once

#include <heddle/base/platform.h>

#include <cstdint>
#include <cstring>

namespace heddle {

/// Four channels of a texel with 16 bits each: colour x weight, and the weight in [3]; 65535 = 1.
struct alignas(8) Texel {
    std::uint16_t c[4];
};
static_assert(sizeof(Texel) == 8, "the same on host and device");

// Four floats with component-wise operations: compiler vectors on the host, plain code on the
// device. Both round each operation once, so that the bits are the same.
#if defined(__CUDACC__)
struct Float4 {
    float v[4];
    HEDDLE_HD constexpr float operator[](int i) const { return v[i]; }
    friend HEDDLE_HD constexpr Float4 operator+(Float4 a, Float4 b) {
        return {{a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2], a.v[3] + b.v[3]}};
    }
    friend HEDDLE_HD constexpr Float4 operator-(Float4 a, Float4 b) {
        return {{a.v[0] - b.v[0], a.v[1] - b.v[1], a.v[2] - b.v[2], a.v[3] - b.v[3]}};
    }
    friend HEDDLE_HD constexpr Float4 operator*(float s, Float4 a) {
        return {{s * a.v[0], s * a.v[1], s * a.v[2], s * a.v[3]}};
    }
};
HEDDLE_INLINE Float4 to_float4(int x, int y, int z, int w) {
    return {{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z),
             static_cast<float>(w)}};
}
HEDDLE_INLINE Float4 to_float4(const Texel& t) {
    return to_float4(t.c[0], t.c[1], t.c[2], t.c[3]);
}
#else
using Float4 [[gnu::vector_size(16)]] = float;
HEDDLE_INLINE Float4 to_float4(int x, int y, int z, int w) {
    using Int4 [[gnu::vector_size(16)]] = std::int32_t;
    return __builtin_convertvector((Int4{x, y, z, w}), Float4);
}
HEDDLE_INLINE Float4 to_float4(const Texel& texel) {
    using Short4 [[gnu::vector_size(8)]] = std::uint16_t;
    using Int4 [[gnu::vector_size(16)]] = std::int32_t;
    Short4 t;
    std::memcpy(&t, texel.c, sizeof t);
    return __builtin_convertvector(__builtin_convertvector(t, Int4), Float4);
}
#endif

} // namespace heddle
