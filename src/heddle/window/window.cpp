#include <heddle/window/window.h>

#include <heddle/base/error.h>
#include <heddle/window/controls.h>
#include <heddle/window/panel.h>
#include <heddle/window/presenter.h>
#include <heddle/window/watched_window.h>

#include <epoxy/gl.h>
// after epoxy, which defines the names of OpenGL
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace heddle::window {
namespace {

using Clock = Controls::Clock;

constexpr double kCoarseSeconds = 0.06; ///< per picture, while the view moves
constexpr double kWait = 0.25;          ///< seconds that an idle window sleeps at most

[[noreturn]] void fail(const std::string& what) {
    throw Error(ErrorCode::Device, "view: " + what,
                "use a display with OpenGL 4.5, or --headless for pictures without one");
}

/// The last error message of GLFW.
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
        ImGui::GetIO().IniFilename = nullptr; // no settings file is written
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

/// The GLFW and OpenGL backends of ImGui; callbacks that were set before are still called.
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

/// The lifetime of one context. The next one continues with the state it ends with.
struct Run {
    viewer::ViewedObject subject;
    viewer::Settings settings;
    const WindowOptions& options;
    const Progress& progress;
    const std::function<void(std::int64_t)>& shown;
    Answers answers;
    WindowCounts counts;
    std::int64_t frames = 0;

    void once();
    void frame(GLFWwindow* window,
               viewer::Session& session,
               Controls& controls,
               PanelState& panel,
               const Presenter& presenter);
};

void Run::frame(GLFWwindow* window,
                viewer::Session& session,
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
    if (width < 1 || height < 1) return; // the window is minimized
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
    viewer::Session session(*context, subject, settings, options.width, options.height);
    const Presenter presenter;
    PanelState panel;
    Controls controls(window.get(), session, panel);
    const ImGuiHalves imgui(window.get());
    while (glfwWindowShouldClose(window.get()) == GLFW_FALSE) {
        if (progress.cancelled()) break;
        frame(window.get(), session, controls, panel, presenter);
        context->check("view");
        shown(++frames);
    }
}

} // namespace

WindowCounts run_window(const viewer::ViewedObject& subject,
                        const viewer::Settings& settings,
                        const WindowOptions& options,
                        const Progress& progress) {
    return run_watched_window(subject, settings, options, progress, [](std::int64_t) {});
}

WindowCounts run_watched_window(const viewer::ViewedObject& subject,
                                const viewer::Settings& settings,
                                const WindowOptions& options,
                                const Progress& progress,
                                const std::function<void(std::int64_t)>& shown) {
    constexpr int kMaxLosses = 3;
    Run run{subject, settings, options, progress, shown, {}, {}};
    for (int loss = 0;; ++loss) {
        try {
            run.once();
            break;
        } catch (const opengl::LostContext&) {
            if (loss == kMaxLosses) throw;
        }
    }
    run.answers.summarize(run.counts);
    return run.counts;
}

} // namespace heddle::window
