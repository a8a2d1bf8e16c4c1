#pragma once

#include <heddle/viewer/session/session.h>
#include <heddle/window/panel.h>

#include <chrono>

struct GLFWwindow;

namespace heddle::window {

/// Mouse and keyboard input of a window, turned into changes of a session: docs/raster.md lists it.
class Controls {
public:
    using Clock = std::chrono::steady_clock;

    /// Sets the window's callbacks and user pointer. All three arguments must outlive this.
    Controls(GLFWwindow* window, viewer::Session& session, PanelState& panel);

    /// The time of the first input that no picture shows yet; Clock::time_point() if there is none.
    [[nodiscard]] Clock::time_point since() const { return since_; }
    void answered() { since_ = {}; }

private:
    [[nodiscard]] static Controls& of(GLFWwindow* window);
    void touch();
    [[nodiscard]] bool is_down(int button) const;
    void scroll(double notches);
    void move(double x, double y);
    void drag(double right, double down); ///< as fractions of the window's height
    void press(int key);
    void pick_block();
    template <typename Change>
    void change(Change&& change);
    template <typename Change>
    void edit_yarn(Change&& change);

    GLFWwindow* window_;
    viewer::Session& session_;
    PanelState& panel_;
    double x_ = 0.0, y_ = 0.0; ///< position of the mouse, in window units
    Clock::time_point since_{};
};

} // namespace heddle::window
