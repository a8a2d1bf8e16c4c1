#pragma once

#include <heddle/slice/section_layers.h>

#include <cstdint>

namespace heddle::slice {

/// The images of all sections in the driver's memory, as texture arrays. Needs a current Context.
class SectionTextures {
public:
    /// @throws Error  OutOfMemory
    explicit SectionTextures(const SectionLayers& sections);
    ~SectionTextures();
    SectionTextures(const SectionTextures&) = delete;
    SectionTextures& operator=(const SectionTextures&) = delete;

    /// Binds distances to texture unit 0 and colours to unit 1.
    void bind() const;

private:
    std::uint32_t distance_ = 0;
    std::uint32_t color_ = 0;
};

} // namespace heddle::slice
