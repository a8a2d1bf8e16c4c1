#pragma once

#include <heddle/geom/texture.h>
#include <heddle/surface/texture_view.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace heddle {

/// A texture that can be read at a point or averaged over a footprint. Its levels are box-filtered
/// in linear light with 16 bits per channel. The finest level is the texture itself, which must
/// outlive this.
///
/// With TexelWeight::Mask, the averaged alpha is the fraction of the area where the bilinear alpha
/// reaches the threshold. Thin leaves do not vanish, as they do if averaged alpha is compared with
/// the threshold.
class FilteredTexture {
public:
    /// @param threshold  in texture alpha, for TexelWeight::Mask; above 1 nothing is covered
    /// @param levels     true: build the coarser levels; false: filtered() reads the finest only
    /// @throws Error     InvalidArgument: no texels, channels not in 1 to 4, or an array that is
    ///                   shorter than width x height x channels
    FilteredTexture(const Texture& texture, TexelWeight weight, float threshold, bool levels);
    FilteredTexture(const FilteredTexture&) = delete; // its view points into it
    FilteredTexture& operator=(const FilteredTexture&) = delete;
    ~FilteredTexture() = default;

    /// Returns a view for the host, which is valid while this lives.
    [[nodiscard]] const TextureView& view() const { return view_; }
    /// These call the functions of the view.
    [[nodiscard]] Rgba at_point(Uv uv) const;
    [[nodiscard]] float coverage_at_point(Uv uv) const;
    [[nodiscard]] Rgba filtered(Uv uv, float level) const;
    [[nodiscard]] float level_of(float footprint_uv) const { return view_.level_of(footprint_uv); }
    [[nodiscard]] float texels_per_uv() const { return view_.texels_per_uv; }
    /// Returns the smallest and the largest red value: the range of a height map.
    [[nodiscard]] std::array<float, 2> red_range() const;

    /// Returns the memory of the levels that were built, in bytes.
    [[nodiscard]] std::int64_t bytes() const;
    /// Returns what bytes() will be for a texture of this size.
    [[nodiscard]] static std::int64_t predict_bytes(std::int64_t width, std::int64_t height);

private:
    void add_level();

    const Texture* texture_;
    TextureView view_;
    std::array<std::uint16_t, 256> decode_{};
    std::vector<std::vector<Texel>> texels_; ///< of levels 1 and above
    std::vector<TextureLevel> levels_;
};

} // namespace heddle
