#pragma once

#include <heddle/geom/mesh.h>
#include <heddle/geom/texture.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace heddle {

/// What a texel counts for when texels are averaged.
enum class TexelWeight : std::uint8_t {
    One,   ///< alpha is ignored and reads 1
    Alpha, ///< colour is weighted by alpha, alpha is averaged
    Mask   ///< colour is weighted by the covered fraction, alpha becomes that fraction
};

/// Four channels in [0, 1], colour linear.
struct Rgba {
    float r = 1.0f, g = 1.0f, b = 1.0f, a = 1.0f;
};

/// A texture that can be read at a point or averaged over a footprint. Box-filtered levels in linear
/// light, 16 bits a channel; the finest level is read from the texture itself, which must outlive it.
///
/// With `Mask` the averaged alpha is the fraction of the area in which the bilinear alpha reaches
/// the threshold: unlike averaged alpha compared with the threshold, it keeps thin leaves.
class FilteredTexture {
public:
    /// @param threshold  in texture alpha, above 1 nothing is covered; used by TexelWeight::Mask
    /// @param levels     build the coarser levels; false: `filtered` is not to be called
    /// @throws Error     InvalidArgument: no texels, channels not in 1 to 4, or an array that is
    ///                   shorter than width x height x channels
    FilteredTexture(const Texture& texture, TexelWeight weight, float threshold, bool levels);

    /// Bilinear, at the finest level: the texture as it is. Grey textures give r = g = b.
    [[nodiscard]] Rgba at_point(Uv uv) const;
    /// Alpha at a point; with TexelWeight::Mask 1 where it reaches the threshold, else 0.
    [[nodiscard]] float coverage_at_point(Uv uv) const;
    /// Trilinear. @param level  from `level_of`, clamped to what there is
    [[nodiscard]] Rgba filtered(Uv uv, float level) const;

    /// Level whose texels are as large as `footprint`, a length in uv (the square root of an area):
    /// log2 of the footprint in texels, by a straight line between powers of two (within 0.09).
    [[nodiscard]] float level_of(float footprint_uv) const;
    /// Geometric mean of width and height.
    [[nodiscard]] float texels_per_uv() const { return texels_per_uv_; }
    /// Least and greatest red value: a height map's range.
    [[nodiscard]] std::array<float, 2> red_range() const;

    /// Memory of the levels that were built, in bytes.
    [[nodiscard]] std::int64_t bytes() const;
    /// What `bytes` will give for a texture of this size.
    [[nodiscard]] static std::int64_t predict_bytes(std::int64_t width, std::int64_t height);

private:
    using Texel =
        std::array<std::uint16_t, 4>; ///< colour x weight, and the weight in [3]; 65535 = 1

    struct Level {
        std::int32_t width = 0;
        std::int32_t height = 0;
        std::vector<Texel> texels; ///< empty at level 0
    };
    using Float4 [[gnu::vector_size(16)]] = float; ///< four channels
    struct Corner {
        std::int32_t x0, x1, y0, y1;
        float fx, fy;
    };

    [[nodiscard]] Texel raw(std::int32_t x, std::int32_t y) const;
    [[nodiscard]] Texel weighted(std::int32_t x, std::int32_t y) const;
    [[nodiscard]] Corner corner_of(Uv uv, const Level& level) const;
    [[nodiscard]] std::uint32_t quarters_covered(std::int32_t x, std::int32_t y) const;
    [[nodiscard]] Texel base_texel(std::int32_t x, std::int32_t y) const;
    [[nodiscard]] Texel source_texel(const Level& from, std::int32_t x, std::int32_t y) const;
    [[nodiscard]] Texel
    box_average(const Level& from, const Level& to, std::int32_t x, std::int32_t y) const;
    template <bool Opaque>
    [[nodiscard]] Float4 raw_at(Uv uv) const;
    [[nodiscard]] Float4 sum_at(Uv uv, std::size_t level) const;

    const Texture* texture_;
    const std::uint8_t* texels_ = nullptr;
    std::size_t channels_ = 0, green_ = 0, blue_ = 0, alpha_ = 0; ///< offsets within a texel
    int opaque_ = 0;                                              ///< 65535 where alpha is missing
    TexelWeight weight_;
    std::uint32_t threshold_ = 0; ///< 65536 and more: no alpha reaches it
    float texels_per_uv_ = 0.0f;
    std::array<std::uint16_t, 256> decode_{}; ///< colour byte to linear
    std::vector<Level> levels_;
};

} // namespace heddle
