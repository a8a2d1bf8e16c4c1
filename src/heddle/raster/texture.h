#pragma once

#include <heddle/raster/section_layers.h>

#include <cstdint>

namespace heddle::raster {

/// The images of all sections in the driver's memory, as arrays of layers. Needs a current Context.
class SectionTextures {
public:
    /// @throws Error  OutOfMemory
    explicit SectionTextures(const SectionLayers& sections);
    ~SectionTextures();
    SectionTextures(const SectionTextures&) = delete;
    SectionTextures& operator=(const SectionTextures&) = delete;

    /// Distances as texture unit 0, colours as unit 1.
    void bind() const;

private:
    std::uint32_t distance_ = 0;
    std::uint32_t color_ = 0;
};

/// A frame buffer without images, for shaders that write to buffers. Needs a current Context.
class EmptyFrame {
public:
    EmptyFrame();
    ~EmptyFrame();
    EmptyFrame(const EmptyFrame&) = delete;
    EmptyFrame& operator=(const EmptyFrame&) = delete;

    /// Draws go here, `width` x `height` px, without depth test.
    void bind(std::int32_t width, std::int32_t height) const;
    /// Draws quads of four corners, as many as the bound indirect buffer says.
    static void draw_indirect();

private:
    std::uint32_t frame_ = 0;
    std::uint32_t vertices_ = 0;
};

} // namespace heddle::raster
