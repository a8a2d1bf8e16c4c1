#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

enum class Wrap : std::uint8_t { Repeat, Clamp, Mirror };

/// An image in memory with 8 bits per channel and rows from the top (glTF: v = 0 is the first row).
struct Texture {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::int32_t channels = 0; ///< 1 to 4
    bool srgb = false;         ///< colour channels hold sRGB values; alpha is always linear
    Wrap wrap_u = Wrap::Repeat;
    Wrap wrap_v = Wrap::Repeat;
    std::string name;                 ///< for messages: a file name, or "image 3 of x.glb"
    std::vector<std::uint8_t> texels; ///< width x height x channels, row by row
};

} // namespace heddle
