#pragma once

#include <cstdint>

namespace heddle::opengl {

/// A framebuffer without images, for shaders that write to buffers. Needs a current Context.
class EmptyFramebuffer {
public:
    EmptyFramebuffer();
    ~EmptyFramebuffer();
    EmptyFramebuffer(const EmptyFramebuffer&) = delete;
    EmptyFramebuffer& operator=(const EmptyFramebuffer&) = delete;

    /// Makes it the target of draws, with `width` x `height` px and no depth test.
    void bind(std::int32_t width, std::int32_t height) const;
    /// Draws quads of four corners; the bound indirect buffer has their number.
    static void draw_indirect();

private:
    std::uint32_t frame_ = 0;
    std::uint32_t vertices_ = 0;
};

} // namespace heddle::opengl
