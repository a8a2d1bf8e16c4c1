#pragma once

#include <heddle/geom/texture.h>
#include <heddle/surface/texture_view.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace heddle {

/// A texture that can be read at a point or averaged over a footprint. Box-filtered levels in
/// linear light, 16 bits a channel; the finest level is read from the texture itself, which must
/// outlive it.
///
/// With `Mask` the averaged alpha is the fraction of the area in which the bilinear alpha reaches
/// the threshold: unlike averaged alpha compared with the threshold, it keeps thin leaves.
class FilteredTexture {
public:
    /// @param threshold  in texture alpha, above 1 nothing is covered; used by TexelWeight::Mask
    /// @param levels     build the coarser levels; false: `filtered` reads the finest at any level
    /// @throws Error     InvalidArgument: no texels, channels not in 1 to 4, or an array that is
    ///                   shorter than width x height x channels
    FilteredTexture(const Texture& texture, TexelWeight weight, float threshold, bool levels);
    FilteredTexture(const FilteredTexture&) = delete; // its view points into it
    FilteredTexture& operator=(const FilteredTexture&) = delete;
    ~FilteredTexture() = default;

    /// What reads it, on the host; valid while this lives.
    [[nodiscard]] const TextureView& view() const { return view_; }
    /// As the view's.
    [[nodiscard]] Rgba at_point(Uv uv) const;
    [[nodiscard]] float coverage_at_point(Uv uv) const;
    [[nodiscard]] Rgba filtered(Uv uv, float level) const;
    [[nodiscard]] float level_of(float footprint_uv) const { return view_.level_of(footprint_uv); }
    [[nodiscard]] float texels_per_uv() const { return view_.texels_per_uv; }
    /// Least and greatest red value: a height map's range.
    [[nodiscard]] std::array<float, 2> red_range() const;

    /// Memory of the levels that were built, in bytes.
    [[nodiscard]] std::int64_t bytes() const;
    /// What `bytes` will give for a texture of this size.
    [[nodiscard]] static std::int64_t predict_bytes(std::int64_t width, std::int64_t height);

private:
    void add_level();

    const Texture* texture_;
    TextureView view_;
    std::array<std::uint16_t, 256> decode_{};
    std::vector<std::vector<Texel>> texels_; ///< of levels 1 and on
    std::vector<TextureLevel> levels_;
};

} // namespace heddle
