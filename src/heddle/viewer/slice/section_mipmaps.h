#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/slice/section_layers.h>

#include <cstdint>
#include <vector>

namespace heddle::viewer {

/// The light that the occlusion of the section lets through, by layer of `sections`: 255 = all;
/// rows from the bottom. Plain fibers have none.
[[nodiscard]] std::vector<std::vector<std::uint8_t>>
bake_light(const Geometry& geometry, const slice::SectionLayers& sections);

/// The sections for pictures: mipmaps of colour and alpha that preserve opacity
/// (yarn/slice_image.h), and the light that occlusion lets through.
class SectionMipmaps {
public:
    /// @param light  by layer, size x size each, 255 = all; rows from the bottom
    /// @throws Error  OutOfMemory
    SectionMipmaps(const slice::SectionLayers& sections,
                   const std::vector<std::vector<std::uint8_t>>& light);
    ~SectionMipmaps();
    SectionMipmaps(const SectionMipmaps&) = delete;
    SectionMipmaps& operator=(const SectionMipmaps&) = delete;
    /// Binds colours to texture unit 1 and light to unit 2.
    void bind() const;

private:
    std::uint32_t color_ = 0, light_ = 0;
};

} // namespace heddle::viewer
