#pragma once

#include <cstdint>
#include <vector>

namespace heddle::viewer {

/// 8 bits a channel, sRGB, opaque, rows from the top.
struct ViewImage {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<std::uint8_t> rgb;
};

/// A picture of linear colour times alpha in the driver's memory, over which layers are blended.
/// Needs a current Context while it lives.
class ViewTarget {
public:
    /// @param width, height  pixels, 1 to 8192
    /// @throws Error  InvalidArgument: sizes; OutOfMemory
    ViewTarget(std::int32_t width, std::int32_t height);
    ~ViewTarget();
    ViewTarget(const ViewTarget&) = delete;
    ViewTarget& operator=(const ViewTarget&) = delete;

    [[nodiscard]] std::int32_t width() const { return width_; }
    [[nodiscard]] std::int32_t height() const { return height_; }

    /// From now on rows [first, end) alone change, from below: of all draws but those of maps.
    void limit(std::int32_t first, std::int32_t end) const;
    /// Makes it clear, within the limit.
    void clear() const;
    /// Draws go here, each over what is there: colours come times alpha. No depth test.
    void begin() const;
    /// Draws `count` quads of four corners by the program in use.
    static void draw_quads(std::uint32_t count);
    /// Draws all pixels by the program in use, whose vertices are kAllPixelsGlsl's.
    static void draw_all();
    /// RGBA, linear, times alpha, rows from below.
    [[nodiscard]] std::vector<float> read() const;
    /// What is seen over white.
    [[nodiscard]] ViewImage image() const;
    /// The colours as texture unit `unit`, for what shows them.
    void bind_color(std::uint32_t unit) const;

private:
    std::int32_t width_, height_;
    std::uint32_t frame_ = 0, color_ = 0, vertices_ = 0;
};

} // namespace heddle::viewer
