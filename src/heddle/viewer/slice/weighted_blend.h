#pragma once

#include <heddle/opengl/shader.h>
#include <heddle/viewer/view_target.h>

#include <cstdint>

namespace heddle::viewer {

/// Blending that no order shows in: colours weigh by how near they are to what is nearest, and what
/// shines through is the product over all [McGuire and Bavoil 2013]. Needs a current Context while it lives.
class WeightedBlend {
public:
    /// @throws Error  OutOfMemory
    WeightedBlend(std::int32_t width, std::int32_t height);
    ~WeightedBlend();
    WeightedBlend(const WeightedBlend&) = delete;
    WeightedBlend& operator=(const WeightedBlend&) = delete;

    /// Draws by what kWeighGlsl is part of go here; nothing is drawn yet.
    void begin() const;
    /// Puts the sums over what the target holds, which draws go to afterwards.
    void resolve(const ViewTarget& target) const;

private:
    std::int32_t width_, height_;
    std::uint32_t frame_ = 0, sums_ = 0, through_ = 0, vertices_ = 0;
    opengl::Program resolve_;
};

} // namespace heddle::viewer
