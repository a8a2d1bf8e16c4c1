#pragma once

#include <heddle/opengl/shader.h>
#include <heddle/viewer/session/progressive_renderer.h>

#include <cstdint>

namespace heddle::window {

/// Shows a picture in the window's framebuffer, over white and as sRGB. Needs a current context.
class Presenter {
public:
    Presenter();
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    void
    show(const viewer::ProgressiveRenderer& picture, std::int32_t width, std::int32_t height) const;

private:
    std::uint32_t vertices_ = 0;
    opengl::Program program_;
};

} // namespace heddle::window
