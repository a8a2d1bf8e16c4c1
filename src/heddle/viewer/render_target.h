#pragma once

#include <cstdint>
#include <vector>

namespace heddle::viewer {

/// 8 bits per channel, sRGB, opaque, rows from the top.
struct RgbImage {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<std::uint8_t> rgb;
};

/// A picture of linear premultiplied colour in the driver's memory, over which layers are blended.
/// Needs a current Context while it lives.
class RenderTarget {
public:
    /// @param width, height  pixels, 1 to 8192
    /// @throws Error  InvalidArgument: sizes; OutOfMemory
    RenderTarget(std::int32_t width, std::int32_t height);
    ~RenderTarget();
    RenderTarget(const RenderTarget&) = delete;
    RenderTarget& operator=(const RenderTarget&) = delete;

    [[nodiscard]] std::int32_t width() const { return width_; }
    [[nodiscard]] std::int32_t height() const { return height_; }

    /// Limits all draws except those of maps to rows [first, end), from the bottom.
    void limit(std::int32_t first, std::int32_t end) const;
    /// Clears it within the limit.
    void clear() const;
    /// Makes it the target of draws, each blended over the contents, premultiplied. No depth test.
    void begin() const;
    /// Draws `count` quads of four corners with the program in use.
    static void draw_quads(std::uint32_t count);
    /// Draws all pixels with the program in use, whose vertex shader is kAllPixelsGlsl.
    static void draw_all();
    /// Reads RGBA, linear, premultiplied, rows from the bottom.
    [[nodiscard]] std::vector<float> read() const;
    /// The picture over white.
    [[nodiscard]] RgbImage image() const;
    /// Binds the colours to texture unit `unit`.
    void bind_color(std::uint32_t unit) const;

private:
    std::int32_t width_, height_;
    std::uint32_t frame_ = 0, color_ = 0, vertices_ = 0;
};

} // namespace heddle::viewer
