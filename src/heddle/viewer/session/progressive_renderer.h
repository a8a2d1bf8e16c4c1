#pragma once

#include <heddle/viewer/render_target.h>

#include <cstdint>
#include <functional>
#include <memory>

namespace heddle::viewer {

/// Draws a picture so that input is answered quickly: first a coarse one, as coarse as the time
/// limit demands, then the fine one in bands of rows. Needs a current context while it lives.
class ProgressiveRenderer {
public:
    /// Draws into a target, within its limit; the coarse target has fewer pixels for the same view.
    using Draw = std::function<void(const RenderTarget& target, bool coarse)>;

    /// @param width, height  pixels, 1 to 8192
    /// @throws Error  as RenderTarget
    ProgressiveRenderer(std::int32_t width, std::int32_t height);

    /// The view has changed: starts again.
    void restart() { stage_ = Phase::Coarse; }
    /// Draws for about `seconds`.
    /// @return        whether the picture has changed
    /// @throws Error  as `draw` throws; the picture then starts again
    bool work(double seconds, const Draw& draw);
    [[nodiscard]] bool done() const { return stage_ == Phase::Done; }
    [[nodiscard]] const RenderTarget& fine() const { return fine_; }
    /// The fine picture is valid below row `rows_done`, from the bottom; above, the coarse one is.
    [[nodiscard]] const RenderTarget& coarse() const { return coarse_ ? *coarse_ : fine_; }
    [[nodiscard]] std::int32_t rows_done() const { return rows_; }

private:
    enum class Phase : std::uint8_t { Coarse, Fine, Done };
    void draw_coarse(double seconds, const Draw& draw);
    void draw_band(double seconds, const Draw& draw);

    RenderTarget fine_;
    std::unique_ptr<RenderTarget> coarse_;
    std::int32_t scale_ = 4; ///< fine pixels per coarse pixel along an axis
    std::int32_t band_ = 32; ///< rows
    std::int32_t rows_ = 0;
    Phase stage_ = Phase::Coarse;
};

} // namespace heddle::viewer
