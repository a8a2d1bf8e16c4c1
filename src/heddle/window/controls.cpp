#include <heddle/window/controls.h>

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heddle::window {
namespace {

/// The light follows the mouse; the eye would move in the opposite direction.
void turn_light(viewer::Settings& s, double right, double down) {
    viewer::Orbit light{.from = s.slices.light, .up = s.orbit.up};
    light.turn(-right * std::numbers::pi, -down * std::numbers::pi);
    s.slices.light = light.from;
}

} // namespace

Controls::Controls(GLFWwindow* window, viewer::Session& session, PanelState& panel)
    : window_(window), session_(session), panel_(panel) {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
        if (action != GLFW_RELEASE) of(w).press(key);
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { of(w).scroll(y); });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).move(x, y); });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int, int) { of(w).touch(); });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned) { of(w).touch(); });
}

Controls& Controls::of(GLFWwindow* window) {
    return *static_cast<Controls*>(glfwGetWindowUserPointer(window));
}

void Controls::touch() {
    if (since_ == Clock::time_point{}) since_ = Clock::now();
}

bool Controls::is_down(int button) const {
    return glfwGetMouseButton(window_, button) == GLFW_PRESS;
}

template <typename Change>
void Controls::change(Change&& change) {
    viewer::Settings next = session_.settings();
    change(next);
    session_.set(next);
}

template <typename Change>
void Controls::edit_yarn(Change&& change) {
    this->change([&](viewer::Settings& s) {
        const auto kind = static_cast<std::size_t>(panel_.kind);
        if (kind < s.yarns.size()) change(s.yarns[kind]);
    });
}

void Controls::scroll(double notches) {
    touch();
    if (ImGui::GetIO().WantCaptureMouse) return;
    change([&](viewer::Settings& s) { s.orbit.zoom(std::pow(1.15, notches)); });
}

void Controls::move(double x, double y) {
    int width = 1;
    int height = 1;
    glfwGetWindowSize(window_, &width, &height);
    const double step = 1.0 / std::max(height, 1);
    const double right = (x - x_) * step;
    const double down = (y - y_) * step;
    x_ = x;
    y_ = y;
    if (!is_down(GLFW_MOUSE_BUTTON_LEFT) && !is_down(GLFW_MOUSE_BUTTON_MIDDLE) &&
        !is_down(GLFW_MOUSE_BUTTON_RIGHT)) {
        return;
    }
    touch();
    if (!ImGui::GetIO().WantCaptureMouse) drag(right, down);
}

void Controls::drag(double right, double down) {
    const bool shift = glfwGetKey(window_, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS;
    const bool left = is_down(GLFW_MOUSE_BUTTON_LEFT);
    change([&](viewer::Settings& s) {
        if (is_down(GLFW_MOUSE_BUTTON_MIDDLE) || (left && shift)) {
            s.orbit.pan(right, -down);
        } else if (left) {
            s.orbit.turn(right * std::numbers::pi, down * std::numbers::pi);
        } else {
            turn_light(s, right, down);
        }
    });
}

/// Picks the pixel under the mouse: windows may have more pixels than units.
void Controls::pick_block() {
    int width = 1;
    int height = 1;
    glfwGetWindowSize(window_, &width, &height);
    const double pixels = static_cast<double>(session_.picture().fine().height()) / height;
    session_.pick_block(x_ * pixels, y_ * pixels);
}

void Controls::press(int key) {
    touch();
    if (ImGui::GetIO().WantTextInput) return;
    switch (key) {
    case GLFW_KEY_F: session_.frame_all(); break;
    case GLFW_KEY_V: session_.voxelize(); break;
    case GLFW_KEY_S: session_.save_picture(); break;
    case GLFW_KEY_W: session_.save_voxels(); break;
    case GLFW_KEY_E: session_.save_scene(); break;
    case GLFW_KEY_B: pick_block(); break;
    case GLFW_KEY_ESCAPE: session_.stop_job(); break;
    case GLFW_KEY_Q: glfwSetWindowShouldClose(window_, GLFW_TRUE); break;
    case GLFW_KEY_1: change([](viewer::Settings& s) { s.show = viewer::Show::Slices; }); break;
    case GLFW_KEY_2: change([](viewer::Settings& s) { s.show = viewer::Show::Voxels; }); break;
    case GLFW_KEY_LEFT_BRACKET: edit_yarn([](viewer::YarnEdit& e) { e.radius /= 1.1; }); break;
    case GLFW_KEY_RIGHT_BRACKET: edit_yarn([](viewer::YarnEdit& e) { e.radius *= 1.1; }); break;
    case GLFW_KEY_COMMA: edit_yarn([](viewer::YarnEdit& e) { e.twist -= 0.1; }); break;
    case GLFW_KEY_PERIOD: edit_yarn([](viewer::YarnEdit& e) { e.twist += 0.1; }); break;
    default: break;
    }
}

} // namespace heddle::window
