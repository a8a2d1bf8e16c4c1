#include <heddle/window/window.h>

#include <heddle/base/error.h>
#include <heddle/window/panel.h>
#include <heddle/window/presenter.h>

#include <epoxy/gl.h>
// after epoxy, which has OpenGL's names
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace heddle::window {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kCoarseSeconds = 0.06; ///< of a picture while the view moves
constexpr double kWait = 0.25;          ///< seconds that an idle window sleeps, at most

[[noreturn]] void fail(const std::string& what) {
    throw Error(ErrorCode::Device, "view: " + what,
                "use a display with OpenGL 4.5, or --headless for pictures without one");
}

/// What GLFW last complained of.
std::string& glfw_words() {
    static std::string words;
    return words;
}

/// GLFW, a window whose context is current, and Dear ImGui in it.
class OpenWindow {
public:
    OpenWindow(const WindowOptions& options, const std::string& title) {
        glfwSetErrorCallback([](int, const char* text) { glfw_words() = text; });
        if (glfwInit() != GLFW_TRUE) fail("no window: " + glfw_words());
        for (const int api : {GLFW_EGL_CONTEXT_API, GLFW_NATIVE_CONTEXT_API}) {
            glfwDefaultWindowHints();
            glfwWindowHint(GLFW_CONTEXT_CREATION_API, api);
            glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
            glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
            glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
            glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
            window_ =
                glfwCreateWindow(options.width, options.height, title.c_str(), nullptr, nullptr);
            if (window_ != nullptr) break;
        }
        if (window_ == nullptr) {
            glfwTerminate();
            fail("no window with OpenGL 4.5: " + glfw_words());
        }
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(1);
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr; // nothing is written that was not asked for
    }
    ~OpenWindow() {
        ImGui::DestroyContext();
        glfwDestroyWindow(window_);
        glfwTerminate();
    }
    OpenWindow(const OpenWindow&) = delete;
    OpenWindow& operator=(const OpenWindow&) = delete;

    [[nodiscard]] GLFWwindow* get() const { return window_; }

private:
    GLFWwindow* window_ = nullptr;
};

/// ImGui's halves for GLFW and OpenGL; the callbacks that were set before go on being called.
struct ImGuiHalves {
    explicit ImGuiHalves(GLFWwindow* window) {
        ImGui_ImplGlfw_InitForOpenGL(window, true);
        ImGui_ImplOpenGL3_Init("#version 450 core");
    }
    ~ImGuiHalves() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
    }
    ImGuiHalves(const ImGuiHalves&) = delete;
    ImGuiHalves& operator=(const ImGuiHalves&) = delete;
};

/// Mouse and keys, as changes of a session.
class Controls {
public:
    Controls(GLFWwindow* window, Session& session, PanelState& panel)
        : window_(window), session_(session), panel_(panel) {
        glfwSetWindowUserPointer(window, this);
        glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
            if (action != GLFW_RELEASE) of(w).press(key);
        });
        glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { of(w).scroll(y); });
        glfwSetCursorPosCallback(window,
                                 [](GLFWwindow* w, double x, double y) { of(w).move(x, y); });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int, int) { of(w).touch(); });
        glfwSetCharCallback(window, [](GLFWwindow* w, unsigned) { of(w).touch(); });
    }

    /// When the first input came that no picture has shown yet; none: Clock::time_point().
    [[nodiscard]] Clock::time_point since() const { return since_; }
    void answered() { since_ = {}; }

private:
    static Controls& of(GLFWwindow* window) {
        return *static_cast<Controls*>(glfwGetWindowUserPointer(window));
    }
    void touch() {
        if (since_ == Clock::time_point{}) since_ = Clock::now();
    }
    [[nodiscard]] bool down(int button) const {
        return glfwGetMouseButton(window_, button) == GLFW_PRESS;
    }

    template <typename Change>
    void change(Change&& change) {
        Settings next = session_.settings();
        change(next);
        session_.set(next);
    }

    void scroll(double notches) {
        touch();
        if (ImGui::GetIO().WantCaptureMouse) return;
        change([&](Settings& s) { s.orbit.zoom(std::pow(1.15, notches)); });
    }

    void move(double x, double y) {
        const double dx = x - x_;
        const double dy = y - y_;
        x_ = x;
        y_ = y;
        const bool left = down(GLFW_MOUSE_BUTTON_LEFT);
        const bool middle = down(GLFW_MOUSE_BUTTON_MIDDLE);
        const bool right = down(GLFW_MOUSE_BUTTON_RIGHT);
        if (left || middle || right) touch();
        if (ImGui::GetIO().WantCaptureMouse || !(left || middle || right)) return;
        int width = 1;
        int height = 1;
        glfwGetWindowSize(window_, &width, &height);
        const double step = 1.0 / std::max(height, 1);
        const bool shift = glfwGetKey(window_, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS;
        change([&](Settings& s) {
            if (middle || (left && shift))
                s.orbit.pan(dx * step, -dy * step);
            else if (left)
                s.orbit.turn(dx * step * std::numbers::pi, dy * step * std::numbers::pi);
            else
                turn_light(s, dx * step, dy * step);
        });
    }

    /// The light goes with the mouse, as the eye would the other way.
    static void turn_light(Settings& s, double dx, double dy) {
        viewer::Orbit light{.from = s.slices.light, .up = s.orbit.up};
        light.turn(-dx * std::numbers::pi, -dy * std::numbers::pi);
        s.slices.light = light.from;
    }

    void press(int key) {
        touch();
        if (ImGui::GetIO().WantTextInput) return;
        YarnEdit none;
        const auto edit = [&](Settings& s) -> YarnEdit& {
            const auto kind = static_cast<std::size_t>(panel_.kind);
            return kind < s.yarns.size() ? s.yarns[kind] : none;
        };
        switch (key) {
        case GLFW_KEY_F: session_.frame_all(); break;
        case GLFW_KEY_V: session_.voxelize(); break;
        case GLFW_KEY_S: session_.save_picture(); break;
        case GLFW_KEY_W: session_.save_voxels(); break;
        case GLFW_KEY_E: session_.save_scene(); break;
        case GLFW_KEY_B: session_.pick_block(x_, y_); break;
        case GLFW_KEY_ESCAPE: session_.stop_job(); break;
        case GLFW_KEY_Q: glfwSetWindowShouldClose(window_, GLFW_TRUE); break;
        case GLFW_KEY_1: change([](Settings& s) { s.show = Show::Slices; }); break;
        case GLFW_KEY_2: change([](Settings& s) { s.show = Show::Voxels; }); break;
        case GLFW_KEY_LEFT_BRACKET: change([&](Settings& s) { edit(s).radius /= 1.1; }); break;
        case GLFW_KEY_RIGHT_BRACKET: change([&](Settings& s) { edit(s).radius *= 1.1; }); break;
        case GLFW_KEY_COMMA: change([&](Settings& s) { edit(s).twist -= 0.1; }); break;
        case GLFW_KEY_PERIOD: change([&](Settings& s) { edit(s).twist += 0.1; }); break;
        default: break;
        }
    }

    GLFWwindow* window_;
    Session& session_;
    PanelState& panel_;
    double x_ = 0.0, y_ = 0.0;
    Clock::time_point since_{};
};

/// Times of answers, for the report.
struct Answers {
    std::vector<double> ms;

    void summarize(WindowCounts& counts) {
        counts.inputs = static_cast<std::int64_t>(ms.size());
        if (ms.empty()) return;
        std::sort(ms.begin(), ms.end());
        counts.median_ms = ms[ms.size() / 2];
        counts.worst_ms = ms.back();
    }
};

/// One context's life. What it ends with goes on in the next.
struct Run {
    Subject subject;
    Settings settings;
    const WindowOptions& options;
    const Progress& progress;
    Answers answers;
    WindowCounts counts;
    std::int64_t frames = 0;

    void once();
    void frame(GLFWwindow* window,
               Session& session,
               Controls& controls,
               PanelState& panel,
               const Presenter& presenter);
};

void Run::frame(GLFWwindow* window,
                Session& session,
                Controls& controls,
                PanelState& panel,
                const Presenter& presenter) {
    if (session.busy())
        glfwPollEvents();
    else
        glfwWaitEventsTimeout(kWait);
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    if (width < 1 || height < 1) return; // it is an icon now
    session.resize(std::min(width, 8192), std::min(height, 8192));
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    draw_panel(session, panel);
    ImGui::Render();
    (void)session.work(kCoarseSeconds);
    presenter.show(session.picture(), width, height);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(window);
    settings = session.settings();
    subject.levels = session.subject().levels; // for the next context, if this one is lost
    if (controls.since() == Clock::time_point{}) return;
    const std::chrono::duration<double, std::milli> took = Clock::now() - controls.since();
    panel.answer_ms = took.count();
    answers.ms.push_back(took.count());
    controls.answered();
}

void Run::once() {
    const OpenWindow window(options, subject.name + " - heddle");
    const std::unique_ptr<opengl::Context> context = opengl::Context::of_window();
    counts.driver = context->driver();
    ++counts.contexts;
    Session session(*context, subject, settings, options.width, options.height);
    const Presenter presenter;
    PanelState panel;
    Controls controls(window.get(), session, panel);
    const ImGuiHalves imgui(window.get());
    while (glfwWindowShouldClose(window.get()) == GLFW_FALSE) {
        if (progress.cancelled()) break;
        frame(window.get(), session, controls, panel, presenter);
        context->check("view");
        if (++frames == options.lose_after)
            opengl::check_status(GL_GUILTY_CONTEXT_RESET, 0, "view");
    }
}

} // namespace

WindowCounts run_window(const Subject& subject,
                        const Settings& settings,
                        const WindowOptions& options,
                        const Progress& progress) {
    constexpr int kMostLosses = 3;
    Run run{subject, settings, options, progress, {}, {}};
    for (int loss = 0;; ++loss) {
        try {
            run.once();
            break;
        } catch (const opengl::LostContext&) {
            if (loss == kMostLosses) throw;
        }
    }
    run.answers.summarize(run.counts);
    return run.counts;
}

} // namespace heddle::window
