#pragma once

#include <cstdint>

namespace heddle::opengl {

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

} // namespace heddle::opengl
