#pragma once

#include <heddle/viewer/session/session.h>
#include <heddle/window/panel.h>

#include <chrono>

struct GLFWwindow;

namespace heddle::window {

/// Mouse and keys of a window, as changes of a session: docs/raster.md lists them.
class Controls {
public:
    using Clock = std::chrono::steady_clock;

    /// Takes the window's callbacks and its user pointer. All three live as long.
    Controls(GLFWwindow* window, viewer::Session& session, PanelState& panel);

    /// When the first input came that no picture has shown yet; none: Clock::time_point().
    [[nodiscard]] Clock::time_point since() const { return since_; }
    void answered() { since_ = {}; }

private:
    [[nodiscard]] static Controls& of(GLFWwindow* window);
    void touch();
    [[nodiscard]] bool is_down(int button) const;
    void scroll(double notches);
    void move(double x, double y);
    void drag(double right, double down); ///< in parts of the window's height
    void press(int key);
    void pick_block();
    template <typename Change>
    void change(Change&& change);
    template <typename Change>
    void edit_yarn(Change&& change);

    GLFWwindow* window_;
    viewer::Session& session_;
    PanelState& panel_;
    double x_ = 0.0, y_ = 0.0; ///< of the mouse, in the window's own units
    Clock::time_point since_{};
};

} // namespace heddle::window
