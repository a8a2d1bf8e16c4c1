#pragma once

#include <heddle/opengl/shader.h>
#include <heddle/viewer/render_target.h>

#include <cstdint>

namespace heddle::viewer {

/// Order-independent blending: colours are weighted by distance behind the nearest surface, and the
/// transmittance is a product [McGuire and Bavoil 2013]. Needs a current Context while it lives.
class WeightedBlend {
public:
    /// @throws Error  OutOfMemory
    WeightedBlend(std::int32_t width, std::int32_t height);
    ~WeightedBlend();
    WeightedBlend(const WeightedBlend&) = delete;
    WeightedBlend& operator=(const WeightedBlend&) = delete;

    /// Makes it the target of draws with kWeighGlsl, and clears it.
    void begin() const;
    /// Blends the sums over the contents of the target, which is the target of later draws.
    void resolve(const RenderTarget& target) const;

private:
    std::int32_t width_, height_;
    std::uint32_t frame_ = 0, sums_ = 0, through_ = 0, vertices_ = 0;
    opengl::Program resolve_;
};

} // namespace heddle::viewer
