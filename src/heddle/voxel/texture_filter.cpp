#include <heddle/voxel/texture_filter.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/base/platform.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace heddle {

namespace {

constexpr float kOne = 65535.0f;

// Four channels at once: vectors of the compiler's, which every machine adds up in the same order.
using Texel4 [[gnu::vector_size(8)]] = std::uint16_t;
using Int4 [[gnu::vector_size(16)]] = std::int32_t;
using Float4 [[gnu::vector_size(16)]] = float;

// 16-bit linear value of a colour byte. Rounded to integers, so that the last bit of pow, which
// differs between C libraries, does not show.                                  [IEC 61966-2-1]
std::uint16_t linear_from_byte(int byte, bool srgb) {
    if (!srgb) return static_cast<std::uint16_t>(byte * 257);
    const double c = byte / 255.0;
    const double l = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    return static_cast<std::uint16_t>(std::lround(l * 65535.0));
}

// std::floor for |x| < 2^31; a call into libm where the machine's baseline has no instruction for it.
HEDDLE_INLINE float floor_of(float x) {
    const auto i = static_cast<float>(static_cast<std::int32_t>(x));
    return i > x ? i - 1.0f : i;
}

// `u` brought into [0, 1]. Beyond 2^20 no fraction worth reading is left; NaN goes the same way.
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

// Texel -1 or n, seen across the border; a mirrored border repeats its texel.
HEDDLE_INLINE std::int32_t wrapped_texel(std::int32_t i, std::int32_t n, Wrap wrap) {
    if (wrap == Wrap::Repeat) return i < 0 ? i + n : i >= n ? i - n : i;
    return std::clamp(i, 0, n - 1);
}

// The texels on both sides of texel coordinate `x`, and how far it is to the second.
HEDDLE_INLINE void
neighbours(float u, std::int32_t n, Wrap wrap, std::int32_t& i0, std::int32_t& i1, float& f) {
    const float x = wrapped(u, wrap) * static_cast<float>(n) - 0.5f;
    const auto below = static_cast<std::int32_t>(x + 1.0f) - 1; // x >= -1/2
    f = x - static_cast<float>(below);
    i0 = wrapped_texel(below, n, wrap);
    i1 = wrapped_texel(below + 1, n, wrap);
}

void check_texture(const Texture& t) {
    const std::int64_t need = std::int64_t{t.width} * t.height * t.channels;
    if (t.width <= 0 || t.height <= 0 || t.channels < 1 || t.channels > 4 ||
        static_cast<std::int64_t>(t.texels.size()) < need)
        throw Error(ErrorCode::InvalidArgument,
                    str("texture '", t.name, "' of ", t.width, " x ", t.height, " x ", t.channels,
                        " channels has ", t.texels.size(), " bytes"),
                    "give width x height x channels bytes, 1 to 4 channels");
}

} // namespace

FilteredTexture::FilteredTexture(const Texture& texture,
                                 TexelWeight weight,
                                 float threshold,
                                 bool levels)
    : texture_(&texture), weight_(weight) {
    check_texture(texture);
    const bool has_alpha = texture.channels == 2 || texture.channels == 4;
    if (!has_alpha && weight == TexelWeight::Alpha) weight_ = TexelWeight::One;
    texels_ = texture.texels.data();
    channels_ = static_cast<std::size_t>(texture.channels);
    green_ = channels_ < 3 ? 0 : 1;
    blue_ = channels_ < 3 ? 0 : 2;
    alpha_ = channels_ - 1;
    opaque_ = has_alpha ? 0 : 65535;
    threshold_ = static_cast<std::uint32_t>(std::clamp(threshold, 0.0f, 2.0f) * kOne + 0.5f);
    texels_per_uv_ =
        std::sqrt(static_cast<float>(texture.width) * static_cast<float>(texture.height));
    for (int i = 0; i < 256; ++i)
        decode_[static_cast<std::size_t>(i)] = linear_from_byte(i, texture.srgb);
    levels_.push_back({texture.width, texture.height, {}});
    while (levels && (levels_.back().width > 1 || levels_.back().height > 1)) {
        const Level& from = levels_.back();
        Level to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
        const auto w = static_cast<std::size_t>(to.width);
        to.texels.resize(w * static_cast<std::size_t>(to.height));
        parallel_chunks(
            static_cast<std::size_t>(to.height), 16, [&](std::size_t y0, std::size_t y1) {
                for (std::size_t y = y0; y < y1; ++y)
                    for (std::size_t x = 0; x < w; ++x)
                        to.texels[y * w + x] = box_average(from, to, static_cast<std::int32_t>(x),
                                                           static_cast<std::int32_t>(y));
            });
        levels_.push_back(std::move(to));
    }
}

FilteredTexture::Texel FilteredTexture::raw(std::int32_t x, std::int32_t y) const {
    const std::size_t at =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(levels_[0].width) +
        static_cast<std::size_t>(x);
    const std::uint8_t* p = texels_ + at * channels_;
    return {decode_[p[0]], decode_[p[green_]], decode_[p[blue_]],
            static_cast<std::uint16_t>(p[alpha_] * 257 | opaque_)};
}

namespace {

std::uint16_t times(std::uint16_t a, std::uint32_t w) {
    return static_cast<std::uint16_t>((a * w + 32767u) / 65535u); // below 2^32: 65535^2 + 32767
}

} // namespace

// A finest texel as a point lookup counts it.
FilteredTexture::Texel FilteredTexture::weighted(std::int32_t x, std::int32_t y) const {
    const Texel t = raw(x, y);
    if (weight_ == TexelWeight::One) return {t[0], t[1], t[2], 65535};
    if (weight_ == TexelWeight::Mask)
        return t[3] >= threshold_ ? Texel{t[0], t[1], t[2], 65535} : Texel{0, 0, 0, 0};
    return {times(t[0], t[3]), times(t[1], t[3]), times(t[2], t[3]), t[3]};
}

// How many of the centres of a finest texel's quarters are covered, the alpha being bilinear: there
// the four nearest texels weigh 9/16, 3/16, 3/16 and 1/16.
std::uint32_t FilteredTexture::quarters_covered(std::int32_t x, std::int32_t y) const {
    std::uint32_t alpha[3][3], least = 65535, most = 0;
    for (std::int32_t v = 0; v < 3; ++v)
        for (std::int32_t u = 0; u < 3; ++u) {
            const std::uint32_t a =
                raw(wrapped_texel(x + u - 1, texture_->width, texture_->wrap_u),
                    wrapped_texel(y + v - 1, texture_->height, texture_->wrap_v))[3];
            alpha[v][u] = a;
            least = std::min(least, a);
            most = std::max(most, a);
        }
    if (least >= threshold_) return 4;
    if (most < threshold_) return 0;
    std::uint32_t n = 0;
    for (std::uint32_t v = 0; v < 3; v += 2)
        for (std::uint32_t u = 0; u < 3; u += 2)
            n += 9 * alpha[1][1] + 3 * (alpha[1][u] + alpha[v][1]) + alpha[v][u] >= 16 * threshold_
                     ? 1u
                     : 0u;
    return n;
}

// A finest texel as the averages count it.
FilteredTexture::Texel FilteredTexture::base_texel(std::int32_t x, std::int32_t y) const {
    if (weight_ != TexelWeight::Mask) return weighted(x, y);
    const Texel t = raw(x, y);
    const std::uint32_t w = quarters_covered(x, y) * 65535u / 4u;
    return {times(t[0], w), times(t[1], w), times(t[2], w), static_cast<std::uint16_t>(w)};
}

FilteredTexture::Texel
FilteredTexture::source_texel(const Level& from, std::int32_t x, std::int32_t y) const {
    if (from.texels.empty()) return base_texel(x, y);
    return from.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(from.width) +
                       static_cast<std::size_t>(x)];
}

// Mean over the source texels that texel (x, y) spans, by the exact overlap: odd sizes keep the mean.
FilteredTexture::Texel FilteredTexture::box_average(const Level& from,
                                                    const Level& to,
                                                    std::int32_t x,
                                                    std::int32_t y) const {
    const std::int64_t x_lo = std::int64_t{x} * from.width, x_hi = x_lo + from.width;
    const std::int64_t y_lo = std::int64_t{y} * from.height, y_hi = y_lo + from.height;
    std::array<std::uint64_t, 4> sum{};
    for (std::int64_t sy = y_lo / to.height; sy * to.height < y_hi; ++sy)
        for (std::int64_t sx = x_lo / to.width; sx * to.width < x_hi; ++sx) {
            const std::int64_t wx =
                std::min(x_hi, (sx + 1) * to.width) - std::max(x_lo, sx * to.width);
            const std::int64_t wy =
                std::min(y_hi, (sy + 1) * to.height) - std::max(y_lo, sy * to.height);
            const Texel t =
                source_texel(from, static_cast<std::int32_t>(sx), static_cast<std::int32_t>(sy));
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += static_cast<std::uint64_t>(wx * wy) * t[c];
        }
    const auto total =
        static_cast<std::uint64_t>(from.width) * static_cast<std::uint64_t>(from.height);
    Texel mean;
    for (std::size_t c = 0; c < 4; ++c)
        mean[c] = static_cast<std::uint16_t>((sum[c] + total / 2) / total);
    return mean;
}

HEDDLE_INLINE FilteredTexture::Corner FilteredTexture::corner_of(Uv uv, const Level& level) const {
    Corner c;
    neighbours(uv.u, level.width, texture_->wrap_u, c.x0, c.x1, c.fx);
    neighbours(uv.v, level.height, texture_->wrap_v, c.y0, c.y1, c.fy);
    return c;
}

namespace {

HEDDLE_INLINE Float4 to_floats(const std::uint16_t* texel) {
    Texel4 t;
    std::memcpy(&t, texel, sizeof t);
    return __builtin_convertvector(__builtin_convertvector(t, Int4), Float4);
}

// @param fetch  Float4 fetch(n): texel n & 1 to the right, n & 2 below; 65535 = 1
template <typename Fetch>
HEDDLE_INLINE Float4 bilinear(const Fetch& fetch, float fx, float fy) {
    const float w[4] = {(1.0f - fx) * (1.0f - fy), fx * (1.0f - fy), (1.0f - fx) * fy, fx * fy};
    Float4 sum{};
    for (int n = 0; n < 4; ++n) sum += w[n] * (1.0f / kOne) * fetch(n);
    return sum;
}

} // namespace

// The bilinear mean of raw texels: what raw() gives, without its way through memory.
template <bool Opaque>
HEDDLE_INLINE Float4 FilteredTexture::raw_at(Uv uv) const {
    const Corner c = corner_of(uv, levels_[0]);
    const auto w = static_cast<std::size_t>(levels_[0].width);
    return bilinear(
        [&](int n) {
            const std::size_t at = static_cast<std::size_t>(n & 2 ? c.y1 : c.y0) * w +
                                   static_cast<std::size_t>(n & 1 ? c.x1 : c.x0);
            const std::uint8_t* p = texels_ + at * channels_;
            const Int4 t{decode_[p[0]], decode_[p[green_]], decode_[p[blue_]],
                         Opaque ? 65535 : p[alpha_] * 257 | opaque_};
            return __builtin_convertvector(t, Float4);
        },
        c.fx, c.fy);
}

Rgba FilteredTexture::at_point(Uv uv) const {
    const Float4 sum = raw_at<false>(uv);
    return {sum[0], sum[1], sum[2], sum[3]};
}

float FilteredTexture::coverage_at_point(Uv uv) const {
    if (weight_ == TexelWeight::One) return 1.0f;
    const float a = at_point(uv).a;
    if (weight_ == TexelWeight::Alpha) return a;
    return a >= (static_cast<float>(threshold_) - 0.01f) / kOne ? 1.0f : 0.0f; // rounding is less
}

HEDDLE_INLINE Float4 FilteredTexture::sum_at(Uv uv, std::size_t level) const {
    if (level == 0 && weight_ == TexelWeight::One) return raw_at<true>(uv);
    const Level& l = levels_[level];
    const Corner c = corner_of(uv, l);
    if (level == 0) {
        return bilinear(
            [&](int n) {
                return to_floats(weighted(n & 1 ? c.x1 : c.x0, n & 2 ? c.y1 : c.y0).data());
            },
            c.fx, c.fy);
    }
    const auto w = static_cast<std::size_t>(l.width);
    return bilinear(
        [&](int n) {
            return to_floats(l.texels[static_cast<std::size_t>(n & 2 ? c.y1 : c.y0) * w +
                                      static_cast<std::size_t>(n & 1 ? c.x1 : c.x0)]
                                 .data());
        },
        c.fx, c.fy);
}

Rgba FilteredTexture::filtered(Uv uv, float level) const {
    const float top = static_cast<float>(levels_.size() - 1);
    const float l = std::clamp(level, 0.0f, top);
    const auto below = static_cast<std::size_t>(l);
    const float f = l - static_cast<float>(below);
    Float4 s = sum_at(uv, below);
    float cover = s[3];
    if (below == 0 && weight_ == TexelWeight::Mask) cover = coverage_at_point(uv);
    if (f > 0.0f) {
        const Float4 t = sum_at(uv, below + 1);
        cover += f * (t[3] - cover);
        s += f * (t - s);
    }
    if (weight_ == TexelWeight::One) return {s[0], s[1], s[2], 1.0f};
    if (s[3] <= 0.0f) return {1.0f, 1.0f, 1.0f, cover}; // nothing there to have a colour
    const float k = 1.0f / s[3];
    return {std::min(1.0f, s[0] * k), std::min(1.0f, s[1] * k), std::min(1.0f, s[2] * k), cover};
}

float FilteredTexture::level_of(float footprint_uv) const {
    const float texels = footprint_uv * texels_per_uv_;
    if (!(texels > 1.0f)) return 0.0f;
    const auto bits = std::bit_cast<std::uint32_t>(texels); // exponent and mantissa are log2's line
    return static_cast<float>(bits - 0x3f800000u) * 0x1p-23f;
}

std::array<float, 2> FilteredTexture::red_range() const {
    const auto step = static_cast<std::size_t>(texture_->channels);
    std::uint8_t lo = 255, hi = 0;
    for (std::size_t i = 0; i < texture_->texels.size(); i += step) {
        lo = std::min(lo, texture_->texels[i]);
        hi = std::max(hi, texture_->texels[i]);
    }
    return {static_cast<float>(decode_[lo]) / kOne, static_cast<float>(decode_[hi]) / kOne};
}

std::int64_t FilteredTexture::bytes() const {
    std::int64_t sum = 0;
    for (const Level& l : levels_)
        sum += static_cast<std::int64_t>(l.texels.size() * sizeof(Texel));
    return sum;
}

std::int64_t FilteredTexture::predict_bytes(std::int64_t width, std::int64_t height) {
    std::int64_t sum = 0;
    while (width > 1 || height > 1) {
        width = std::max<std::int64_t>(1, width / 2);
        height = std::max<std::int64_t>(1, height / 2);
        sum += width * height * static_cast<std::int64_t>(sizeof(Texel));
    }
    return sum;
}

} // namespace heddle
