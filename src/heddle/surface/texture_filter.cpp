#include <heddle/surface/texture_filter.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/geom/color.h>

#include <algorithm>
#include <cmath>

namespace heddle {

namespace {

// Returns the 16-bit linear value of a colour byte. It is rounded to integers, so that the last bit
// of pow, which differs between C libraries, has no effect.
std::uint16_t linear_from_byte(int byte, bool srgb) {
    if (!srgb) return static_cast<std::uint16_t>(byte * 257);
    const double linear = linear_from_srgb_byte<double>(static_cast<std::uint8_t>(byte));
    return static_cast<std::uint16_t>(std::lround(linear * 65535.0));
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

// Returns how many of the centres of a finest texel's quarters are covered by bilinear alpha. There
// the four nearest texels have weights 9/16, 3/16, 3/16 and 1/16.
std::uint32_t quarters_covered(const TextureView& t, std::int32_t x, std::int32_t y) {
    using texture_detail::wrapped_texel;
    std::uint32_t alpha[3][3], least = 65535, most = 0;
    for (std::int32_t v = 0; v < 3; ++v)
        for (std::int32_t u = 0; u < 3; ++u) {
            const std::uint32_t a = t.raw(wrapped_texel(x + u - 1, t.levels[0].width, t.wrap_u),
                                          wrapped_texel(y + v - 1, t.levels[0].height, t.wrap_v))
                                        .c[3];
            alpha[v][u] = a;
            least = std::min(least, a);
            most = std::max(most, a);
        }
    if (least >= t.threshold) return 4;
    if (most < t.threshold) return 0;
    std::uint32_t n = 0;
    for (std::uint32_t v = 0; v < 3; v += 2)
        for (std::uint32_t u = 0; u < 3; u += 2)
            n += 9 * alpha[1][1] + 3 * (alpha[1][u] + alpha[v][1]) + alpha[v][u] >= 16 * t.threshold
                     ? 1u
                     : 0u;
    return n;
}

// Returns a texel as it is averaged for the next level.
Texel source_texel(const TextureView& t, const TextureLevel& from, std::int32_t x, std::int32_t y) {
    using texture_detail::times;
    if (from.texels != nullptr) return from.texels[texture_detail::texel_index(from, x, y)];
    if (t.weight != TexelWeight::Mask) return t.weighted(x, y);
    const Texel raw = t.raw(x, y);
    const std::uint32_t w = quarters_covered(t, x, y) * 65535u / 4u;
    return {{times(raw.c[0], w), times(raw.c[1], w), times(raw.c[2], w),
             static_cast<std::uint16_t>(w)}};
}

// Returns the mean over the source texels that texel (x, y) overlaps, weighted by the overlap, so
// that odd sizes have the right mean.
Texel box_average(const TextureView& t,
                  const TextureLevel& from,
                  const TextureLevel& to,
                  std::int32_t x,
                  std::int32_t y) {
    const std::int64_t x_lo = std::int64_t{x} * from.width, x_hi = x_lo + from.width;
    const std::int64_t y_lo = std::int64_t{y} * from.height, y_hi = y_lo + from.height;
    std::array<std::uint64_t, 4> sum{};
    for (std::int64_t sy = y_lo / to.height; sy * to.height < y_hi; ++sy)
        for (std::int64_t sx = x_lo / to.width; sx * to.width < x_hi; ++sx) {
            const std::int64_t wx =
                std::min(x_hi, (sx + 1) * to.width) - std::max(x_lo, sx * to.width);
            const std::int64_t wy =
                std::min(y_hi, (sy + 1) * to.height) - std::max(y_lo, sy * to.height);
            const Texel texel =
                source_texel(t, from, static_cast<std::int32_t>(sx), static_cast<std::int32_t>(sy));
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += static_cast<std::uint64_t>(wx * wy) * texel.c[c];
        }
    const auto total =
        static_cast<std::uint64_t>(from.width) * static_cast<std::uint64_t>(from.height);
    Texel mean;
    for (std::size_t c = 0; c < 4; ++c)
        mean.c[c] = static_cast<std::uint16_t>((sum[c] + total / 2) / total);
    return mean;
}

} // namespace

FilteredTexture::FilteredTexture(const Texture& texture,
                                 TexelWeight weight,
                                 float threshold,
                                 bool levels)
    : texture_(&texture) {
    check_texture(texture);
    const bool has_alpha = texture.channels == 2 || texture.channels == 4;
    if (!has_alpha && weight == TexelWeight::Alpha) weight = TexelWeight::One;
    for (int i = 0; i < 256; ++i)
        decode_[static_cast<std::size_t>(i)] = linear_from_byte(i, texture.srgb);
    view_.texels = texture.texels.data();
    view_.decode = decode_.data();
    view_.channels = texture.channels;
    view_.green = texture.channels < 3 ? 0 : 1;
    view_.blue = texture.channels < 3 ? 0 : 2;
    view_.alpha = texture.channels - 1;
    view_.opaque = has_alpha ? 0 : 65535;
    view_.threshold =
        static_cast<std::uint32_t>(std::clamp(threshold, 0.0f, 2.0f) * texture_detail::kOne + 0.5f);
    view_.texels_per_uv =
        std::sqrt(static_cast<float>(texture.width) * static_cast<float>(texture.height));
    view_.weight = weight;
    view_.wrap_u = texture.wrap_u;
    view_.wrap_v = texture.wrap_v;
    levels_.push_back({nullptr, texture.width, texture.height});
    view_.levels = levels_.data();
    while (levels && (levels_.back().width > 1 || levels_.back().height > 1)) add_level();
    view_.level_count = static_cast<std::int32_t>(levels_.size());
}

void FilteredTexture::add_level() {
    const TextureLevel from = levels_.back();
    TextureLevel to{nullptr, std::max(1, from.width / 2), std::max(1, from.height / 2)};
    const auto w = static_cast<std::size_t>(to.width);
    std::vector<Texel>& texels = texels_.emplace_back(w * static_cast<std::size_t>(to.height));
    parallel_chunks(static_cast<std::size_t>(to.height), 16, [&](std::size_t y0, std::size_t y1) {
        for (std::size_t y = y0; y < y1; ++y)
            for (std::size_t x = 0; x < w; ++x)
                texels[y * w + x] = box_average(view_, from, to, static_cast<std::int32_t>(x),
                                                static_cast<std::int32_t>(y));
    });
    to.texels = texels.data();
    levels_.push_back(to);
    view_.levels = levels_.data();
}

Rgba FilteredTexture::at_point(Uv uv) const {
    return view_.at_point(uv);
}

float FilteredTexture::coverage_at_point(Uv uv) const {
    return view_.coverage_at_point(uv);
}

Rgba FilteredTexture::filtered(Uv uv, float level) const {
    return view_.filtered(uv, level);
}

std::array<float, 2> FilteredTexture::red_range() const {
    const auto step = static_cast<std::size_t>(texture_->channels);
    std::uint8_t lo = 255, hi = 0;
    for (std::size_t i = 0; i < texture_->texels.size(); i += step) {
        lo = std::min(lo, texture_->texels[i]);
        hi = std::max(hi, texture_->texels[i]);
    }
    return {static_cast<float>(decode_[lo]) / texture_detail::kOne,
            static_cast<float>(decode_[hi]) / texture_detail::kOne};
}

std::int64_t FilteredTexture::bytes() const {
    std::int64_t sum = 0;
    for (const std::vector<Texel>& level : texels_)
        sum += static_cast<std::int64_t>(level.size() * sizeof(Texel));
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
