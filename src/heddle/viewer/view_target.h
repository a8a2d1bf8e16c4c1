#pragma once

#include <heddle/raster/section_layers.h>

#include <cstdint>
#include <vector>

namespace heddle::viewer {

/// A picture of linear colour times alpha in the driver's memory, into which slabs are blended.
class ViewTarget {
public:
    /// @throws Error  OutOfMemory
    ViewTarget(std::int32_t width, std::int32_t height);
    ~ViewTarget();
    ViewTarget(const ViewTarget&) = delete;
    ViewTarget& operator=(const ViewTarget&) = delete;

    /// Draws go here, each over what is there; it is clear now.
    void begin() const;
    /// Draws `count` quads of four corners.
    static void draw_quads(std::uint32_t count);
    /// RGBA, linear, times alpha, rows from below.
    [[nodiscard]] std::vector<float> read() const;

private:
    std::int32_t width_, height_;
    std::uint32_t frame_ = 0, color_ = 0, vertices_ = 0;
};

/// The sections for pictures: colour and alpha in sizes that keep opacity (geom/slice_image.h), and the
/// light that occlusion leaves.
class ViewSections {
public:
    /// @param light  by layer, size x size each, 255 = all; rows from below
    /// @throws Error  OutOfMemory
    ViewSections(const raster::SectionLayers& sections,
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
