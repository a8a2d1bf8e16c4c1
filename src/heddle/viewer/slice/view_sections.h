#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/slice/section_layers.h>

#include <cstdint>
#include <vector>

namespace heddle::viewer {

/// What the section's occlusion leaves of the light, by layer of `sections`: 255 = all; rows from
/// below. Plain fibers have none.
[[nodiscard]] std::vector<std::vector<std::uint8_t>>
bake_light(const Geometry& geometry, const slice::SectionLayers& sections);

/// The sections for pictures: colour and alpha in sizes that keep opacity (yarn/slice_image.h), and
/// the light that occlusion leaves.
class ViewSections {
public:
    /// @param light  by layer, size x size each, 255 = all; rows from below
    /// @throws Error  OutOfMemory
    ViewSections(const slice::SectionLayers& sections,
                 const std::vector<std::vector<std::uint8_t>>& light);
    ~ViewSections();
    ViewSections(const ViewSections&) = delete;
    ViewSections& operator=(const ViewSections&) = delete;
    /// Colours as texture unit 1, light as unit 2.
    void bind() const;

private:
    std::uint32_t color_ = 0, light_ = 0;
};

} // namespace heddle::viewer
