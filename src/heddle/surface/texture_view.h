#pragma once

#include <heddle/base/platform.h>
#include <heddle/geom/mesh.h>
#include <heddle/geom/texture.h>
#include <heddle/surface/float4.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace heddle {

/// The weight of a texel when texels are averaged.
enum class TexelWeight : std::uint8_t {
    One,   ///< alpha is ignored and read as 1
    Alpha, ///< colour is weighted by alpha, alpha is averaged
    Mask   ///< colour is weighted by the covered fraction, alpha becomes that fraction
};

/// Four channels in [0, 1], colour linear.
struct Rgba {
    float r = 1.0f, g = 1.0f, b = 1.0f, a = 1.0f;
};

/// One level of a FilteredTexture.
struct TextureLevel {
    const Texel* texels = nullptr; ///< width x height; null for level 0, which is the image itself
    std::int32_t width = 0;
    std::int32_t height = 0;
};

/// A FilteredTexture as pointers and numbers, for host and device.
struct TextureView {
    const std::uint8_t* texels = nullptr;  ///< texels of the image
    const std::uint16_t* decode = nullptr; ///< 256 entries: colour byte to linear, 65535 = 1
    const TextureLevel* levels = nullptr;  ///< [0]: size of the image; then its averages
    std::int32_t level_count = 0;
    std::int32_t channels = 0, green = 0, blue = 0, alpha = 0; ///< offsets within a texel
    std::int32_t opaque = 0;                                   ///< 65535 if there is no alpha
    std::uint32_t threshold = 0; ///< alpha of a mask's border; 65536 or more: nothing is covered
    float texels_per_uv = 0.0f;  ///< geometric mean of width and height
    TexelWeight weight = TexelWeight::One;
    Wrap wrap_u = Wrap::Repeat, wrap_v = Wrap::Repeat;

    /// Reads the finest level with a bilinear filter. Grey textures give r = g = b.
    [[nodiscard]] HEDDLE_HD Rgba at_point(Uv uv) const;
    /// Returns alpha at a point; with TexelWeight::Mask, 1 if it reaches the threshold, else 0.
    [[nodiscard]] HEDDLE_HD float coverage_at_point(Uv uv) const;
    /// Reads with a trilinear filter. @param level  from level_of(); clamped to the existing levels
    [[nodiscard]] HEDDLE_HD Rgba filtered(Uv uv, float level) const;
    /// Returns the level whose texels are as large as the footprint, a length in uv (the square
    /// root of an area): log2 of the footprint in texels, linear between powers of two (within
    /// 0.09).
    [[nodiscard]] HEDDLE_HD float level_of(float footprint_uv) const;

    /// Returns a texel of the image. Averages are computed from raw() and weighted().
    [[nodiscard]] HEDDLE_HD Texel raw(std::int32_t x, std::int32_t y) const;
    /// Returns a texel of the image, multiplied by its weight.
    [[nodiscard]] HEDDLE_HD Texel weighted(std::int32_t x, std::int32_t y) const;
};
static_assert(sizeof(TextureView) == 64, "the same on host and device");

namespace texture_detail {

constexpr float kOne = 65535.0f;

// Returns std::floor(x) for |x| < 2^31, without a call of libm on machines without an instruction.
HEDDLE_INLINE float floor_of(float x) {
    const auto i = static_cast<float>(static_cast<std::int32_t>(x));
    return i > x ? i - 1.0f : i;
}

// Returns `u` wrapped into [0, 1]; 0 for NaN and beyond 2^20, where no useful fraction is left.
HEDDLE_INLINE float wrapped(float u, Wrap wrap) {
    if (!(std::abs(u) < 0x1p20f)) return 0.0f;
    switch (wrap) {
    case Wrap::Repeat: return u - floor_of(u);
    case Wrap::Clamp: return std::clamp(u, 0.0f, 1.0f);
    case Wrap::Mirror: {
        const float t = u - 2.0f * floor_of(0.5f * u);
        return t > 1.0f ? 2.0f - t : t;
    }
    }
    return u;
}

// Returns the texel for i = -1 .. n. A mirrored border repeats its texel.
HEDDLE_INLINE std::int32_t wrapped_texel(std::int32_t i, std::int32_t n, Wrap wrap) {
    if (wrap == Wrap::Repeat) return i < 0 ? i + n : i >= n ? i - n : i;
    return std::clamp(i, 0, n - 1);
}

// Sets the texels on both sides of `u`, and the interpolation weight of the second.
HEDDLE_INLINE void
neighbours(float u, std::int32_t n, Wrap wrap, std::int32_t& i0, std::int32_t& i1, float& f) {
    const float x = wrapped(u, wrap) * static_cast<float>(n) - 0.5f;
    const auto below = static_cast<std::int32_t>(x + 1.0f) - 1; // x >= -1/2
    f = x - static_cast<float>(below);
    i0 = wrapped_texel(below, n, wrap);
    i1 = wrapped_texel(below + 1, n, wrap);
}

HEDDLE_INLINE std::uint16_t times(std::uint16_t a, std::uint32_t w) {
    return static_cast<std::uint16_t>((a * w + 32767u) / 65535u); // below 2^32: 65535^2 + 32767
}

HEDDLE_INLINE std::size_t texel_index(const TextureLevel& l, std::int32_t x, std::int32_t y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(l.width) +
           static_cast<std::size_t>(x);
}

// @param fetch  Float4 fetch(x, y): a texel, 65535 = 1
template <typename Fetch>
HEDDLE_INLINE Float4
bilinear(const TextureView& t, const TextureLevel& l, Uv uv, const Fetch& fetch) {
    std::int32_t x0, x1, y0, y1;
    float fx, fy;
    neighbours(uv.u, l.width, t.wrap_u, x0, x1, fx);
    neighbours(uv.v, l.height, t.wrap_v, y0, y1, fy);
    const float w[4] = {(1.0f - fx) * (1.0f - fy), fx * (1.0f - fy), (1.0f - fx) * fy, fx * fy};
    Float4 sum{};
    for (int n = 0; n < 4; ++n)
        sum = sum + w[n] * (1.0f / kOne) * fetch(n & 1 ? x1 : x0, n & 2 ? y1 : y0);
    return sum;
}

// Returns the bilinear mean of the texels of raw(), without storing them in memory.
template <bool Opaque>
HEDDLE_INLINE Float4 raw_at(const TextureView& t, Uv uv) {
    const TextureLevel l = t.levels[0];
    return bilinear(t, l, uv, [&](std::int32_t x, std::int32_t y) {
        const std::uint8_t* p =
            t.texels + texel_index(l, x, y) * static_cast<std::size_t>(t.channels);
        return to_float4(t.decode[p[0]], t.decode[p[t.green]], t.decode[p[t.blue]],
                         Opaque ? 65535 : p[t.alpha] * 257 | t.opaque);
    });
}

HEDDLE_INLINE Float4 sum_at(const TextureView& t, Uv uv, std::int32_t level) {
    if (level == 0 && t.weight == TexelWeight::One) return raw_at<true>(t, uv);
    const TextureLevel l = t.levels[level];
    if (level == 0) {
        return bilinear(
            t, l, uv, [&](std::int32_t x, std::int32_t y) { return to_float4(t.weighted(x, y)); });
    }
    return bilinear(t, l, uv, [&](std::int32_t x, std::int32_t y) {
        return to_float4(l.texels[texel_index(l, x, y)]);
    });
}

} // namespace texture_detail

HEDDLE_HD inline Texel TextureView::raw(std::int32_t x, std::int32_t y) const {
    const std::uint8_t* p =
        texels + texture_detail::texel_index(levels[0], x, y) * static_cast<std::size_t>(channels);
    return {{decode[p[0]], decode[p[green]], decode[p[blue]],
             static_cast<std::uint16_t>(p[alpha] * 257 | opaque)}};
}

HEDDLE_HD inline Texel TextureView::weighted(std::int32_t x, std::int32_t y) const {
    using texture_detail::times;
    const Texel t = raw(x, y);
    const std::uint16_t a = t.c[3];
    if (weight == TexelWeight::One) return {{t.c[0], t.c[1], t.c[2], 65535}};
    if (weight == TexelWeight::Mask)
        return a >= threshold ? Texel{{t.c[0], t.c[1], t.c[2], 65535}} : Texel{};
    return {{times(t.c[0], a), times(t.c[1], a), times(t.c[2], a), a}};
}

HEDDLE_HD inline Rgba TextureView::at_point(Uv uv) const {
    const Float4 sum = texture_detail::raw_at<false>(*this, uv);
    return {sum[0], sum[1], sum[2], sum[3]};
}

HEDDLE_HD inline float TextureView::coverage_at_point(Uv uv) const {
    if (weight == TexelWeight::One) return 1.0f;
    const float a = at_point(uv).a;
    if (weight == TexelWeight::Alpha) return a;
    // rounding is less than 0.01
    return a >= (static_cast<float>(threshold) - 0.01f) / texture_detail::kOne ? 1.0f : 0.0f;
}

HEDDLE_HD inline Rgba TextureView::filtered(Uv uv, float level) const {
    using texture_detail::sum_at;
    const float l = std::clamp(level, 0.0f, static_cast<float>(level_count - 1));
    const auto below = static_cast<std::int32_t>(l);
    const float f = l - static_cast<float>(below);
    Float4 s = sum_at(*this, uv, below);
    float cover = s[3];
    if (below == 0 && weight == TexelWeight::Mask) cover = coverage_at_point(uv);
    if (f > 0.0f) {
        const Float4 t = sum_at(*this, uv, below + 1);
        cover += f * (t[3] - cover);
        s = s + f * (t - s);
    }
    if (weight == TexelWeight::One) return {s[0], s[1], s[2], 1.0f};
    if (s[3] <= 0.0f) return {1.0f, 1.0f, 1.0f, cover}; // nothing has a colour here
    const float k = 1.0f / s[3];
    return {std::min(1.0f, s[0] * k), std::min(1.0f, s[1] * k), std::min(1.0f, s[2] * k), cover};
}

HEDDLE_HD inline float TextureView::level_of(float footprint_uv) const {
    const float n = footprint_uv * texels_per_uv;
    if (!(n > 1.0f)) return 0.0f;
    const auto bits = std::bit_cast<std::uint32_t>(n); // its fields are a linear log2
    return static_cast<float>(bits - 0x3f800000u) * 0x1p-23f;
}

} // namespace heddle
