#pragma once

#include <heddle/viewer/view_target.h>

#include <cstdint>
#include <functional>
#include <memory>

namespace heddle::viewer {

/// Draws a picture so that input is answered: coarse at once, as coarse as the time for one asks,
/// then fine in bands of rows. Needs a current context while it lives.
class Refiner {
public:
    /// Draws into a target, within its limit; the coarse one has fewer pixels for the same view.
    using Draw = std::function<void(const ViewTarget& target, bool coarse)>;

    /// @param width, height  pixels, 1 to 8192
    /// @throws Error  as ViewTarget
    Refiner(std::int32_t width, std::int32_t height);

    /// The view has changed: begins again.
    void restart() { stage_ = Stage::Coarse; }
    /// Draws for about `seconds`.
    /// @return        the picture is another than before
    /// @throws Error  what `draw` throws; it begins again then
    bool work(double seconds, const Draw& draw);
    [[nodiscard]] bool done() const { return stage_ == Stage::Done; }
    [[nodiscard]] const ViewTarget& fine() const { return fine_; }
    /// Below `rows_done` rows of the fine one hold, from below; above, the coarse one.
    [[nodiscard]] const ViewTarget& coarse() const { return coarse_ ? *coarse_ : fine_; }
    [[nodiscard]] std::int32_t rows_done() const { return rows_; }

private:
    enum class Stage : std::uint8_t { Coarse, Fine, Done };
    void draw_coarse(double seconds, const Draw& draw);
    void draw_band(double seconds, const Draw& draw);

    ViewTarget fine_;
    std::unique_ptr<ViewTarget> coarse_;
    std::int32_t scale_ = 4; ///< fine pixels a coarse one, along an axis
    std::int32_t band_ = 32; ///< rows
    std::int32_t rows_ = 0;
    Stage stage_ = Stage::Coarse;
};

} // namespace heddle::viewer
