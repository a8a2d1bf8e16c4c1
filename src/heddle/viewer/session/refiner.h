#pragma once

#include <heddle/viewer/view_target.h>

#include <cstdint>
#include <functional>
#include <memory>

namespace heddle::viewer {

/// Draws a picture so that input is answered quickly: first a coarse one, as coarse as the time
/// limit demands, then the fine one in bands of rows. Needs a current context while it lives.
class Refiner {
public:
    /// Draws into a target, within its limit; the coarse target has fewer pixels for the same view.
    using Draw = std::function<void(const ViewTarget& target, bool coarse)>;

    /// @param width, height  pixels, 1 to 8192
    /// @throws Error  as ViewTarget
    Refiner(std::int32_t width, std::int32_t height);

    /// The view has changed: starts again.
    void restart() { stage_ = Stage::Coarse; }
    /// Draws for about `seconds`.
    /// @return        whether the picture has changed
    /// @throws Error  as `draw` throws; the picture then starts again
    bool work(double seconds, const Draw& draw);
    [[nodiscard]] bool done() const { return stage_ == Stage::Done; }
    [[nodiscard]] const ViewTarget& fine() const { return fine_; }
    /// The fine picture is valid below row `rows_done`, from the bottom; above, the coarse one is.
    [[nodiscard]] const ViewTarget& coarse() const { return coarse_ ? *coarse_ : fine_; }
    [[nodiscard]] std::int32_t rows_done() const { return rows_; }

private:
    enum class Stage : std::uint8_t { Coarse, Fine, Done };
    void draw_coarse(double seconds, const Draw& draw);
    void draw_band(double seconds, const Draw& draw);

    ViewTarget fine_;
    std::unique_ptr<ViewTarget> coarse_;
    std::int32_t scale_ = 4; ///< fine pixels per coarse pixel along an axis
    std::int32_t band_ = 32; ///< rows
    std::int32_t rows_ = 0;
    Stage stage_ = Stage::Coarse;
};

} // namespace heddle::viewer
