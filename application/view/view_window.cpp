// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The only place that knows GLFW and OpenGL, which are for showing alone, and with drift_window.cpp Dear ImGui.
#include "application/view/view_window.h"

#include <fmt/format.h>
#define GLFW_INCLUDE_NONE
#include <GL/gl.h>
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <dlfcn.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "application/view/drift_window.h"

namespace application {
namespace {

using render_system::Result;
using render_system::Status;
using render_system::StatusCode;

std::string& last_glfw_error() {
    static std::string error;
    return error;
}

/// Xlib ends a program whose display went away with words of its own and exit code 1, which says something else here.
/// Asked for by name: Wayland needs no Xlib.
void tell_of_lost_display() {
    using Handler = int (*)(void*);
    const auto set_handler = reinterpret_cast<Handler (*)(Handler)>(dlsym(RTLD_DEFAULT, "XSetIOErrorHandler"));
    if (!set_handler) return;
    set_handler([](void*) -> int {
        std::fputs("pathtracer: error: view: the display went away; start it again where there is one\n", stderr);
        std::_Exit(2);  // threads are at work
    });
}

/// GLFW as long as it is needed.
struct Glfw {
    bool is_up = false;
    Glfw() {
        glfwSetErrorCallback([](int, const char* text) { last_glfw_error() = text; });
        is_up = glfwInit() == GLFW_TRUE;
        if (is_up) tell_of_lost_display();
    }
    ~Glfw() {
        if (is_up) glfwTerminate();
    }
};

/// What is asked of OpenGL itself: a texture to show a picture in. By address, so that nothing links to libGL.
struct Gl {
    decltype(&glGenTextures) gen_textures = address<decltype(&glGenTextures)>("glGenTextures");
    decltype(&glBindTexture) bind_texture = address<decltype(&glBindTexture)>("glBindTexture");
    decltype(&glTexParameteri) tex_parameter = address<decltype(&glTexParameteri)>("glTexParameteri");
    decltype(&glTexImage2D) tex_image = address<decltype(&glTexImage2D)>("glTexImage2D");
    decltype(&glPixelStorei) pixel_store = address<decltype(&glPixelStorei)>("glPixelStorei");
    decltype(&glViewport) viewport = address<decltype(&glViewport)>("glViewport");
    decltype(&glClear) clear = address<decltype(&glClear)>("glClear");

    template <class Function>
    static Function address(const char* name) {
        return reinterpret_cast<Function>(glfwGetProcAddress(name));
    }
};

/// Something that a person did. Kept as events: press and release may both come between two frames.
struct InputEvent {
    enum Kind : uint8_t { Key, Press, Release, Move, Wheel, Other } kind = Other;
    int code = 0;             ///< of the key or button
    int modifiers = 0;        ///< that were held with the button
    double x = 0.0, y = 0.0;  ///< where the mouse moved to, or, of the wheel, how far it turned
};

std::vector<InputEvent>& input_events() {
    static std::vector<InputEvent> events;
    return events;
}

/// Dear ImGui, which comes later, calls these too.
void note_input_events(GLFWwindow* window) {
    const auto other = [](GLFWwindow*, int, int) { input_events().push_back({}); };
    glfwSetCursorPosCallback(window, [](GLFWwindow*, double x, double y) {
        input_events().push_back({InputEvent::Move, 0, 0, x, y});
    });
    // Where: where it moved to last. To ask for its place would tell that of now, which may be another one already.
    glfwSetMouseButtonCallback(window, [](GLFWwindow*, int button, int action, int modifiers) {
        input_events().push_back({action == GLFW_PRESS ? InputEvent::Press : InputEvent::Release, button, modifiers});
    });
    glfwSetScrollCallback(window, [](GLFWwindow*, double x, double y) {
        input_events().push_back({InputEvent::Wheel, 0, 0, x, y});
    });
    glfwSetKeyCallback(window, [](GLFWwindow*, int key, int, int action, int) {
        input_events().push_back({action == GLFW_PRESS ? InputEvent::Key : InputEvent::Other, key});
    });
    glfwSetFramebufferSizeCallback(window, other);
    glfwSetWindowRefreshCallback(window, [](GLFWwindow*) { input_events().push_back({}); });
}

constexpr float RADIANS_PER_HEIGHT = 3.0f;

class Window {
public:
    Window(GLFWwindow* window, const Options& options, ViewSession& session, DriftPanel& panel, ViewLog& log)
        : window_(window), options_(options), session_(session), panel_(panel), drift_(panel), log_(log) {
        gl_.gen_textures(1, &texture_);
        glfwGetCursorPos(window_, &mouse_x_, &mouse_y_);
    }

    void run() {
        double looked_at = -1.0;
        int frames = 1;  // to be drawn: after an input Dear ImGui takes a few
        while (glfwWindowShouldClose(window_) == GLFW_FALSE && !session_.is_stuck()) {
            constexpr double TURN_SECONDS = 0.004, CALM_SECONDS = 0.1;
            constexpr int FRAMES_OF_INPUT = 3;
            glfwWaitEventsTimeout(TURN_SECONDS);
            place_picture();
            if (!input_events().empty() || flies()) frames = FRAMES_OF_INPUT;
            take_input();
            if (session_.take_news()) frames = FRAMES_OF_INPUT;
            play();
            // A picture that only converges is shown ten times a second: drawing takes the cores' time.
            const double now = glfwGetTime();
            if (!session_.is_waiting() && frames == 0 && now - looked_at < CALM_SECONDS) continue;
            if (now - looked_at >= CALM_SECONDS) frames = std::max(frames, 1);
            looked_at = now;
            if (panel_.update()) frames = std::max(frames, 1);
            if (session_.update()) {
                upload();
                frames = std::max(frames, 1);
            }
            if (frames == 0) continue;
            --frames;
            draw();
        }
    }

private:
    void upload() {
        const Channels<uint8_t>& image = session_.image();
        gl_.bind_texture(GL_TEXTURE_2D, texture_);
        gl_.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl_.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl_.pixel_store(GL_UNPACK_ALIGNMENT, 1);
        gl_.tex_image(GL_TEXTURE_2D, 0, GL_RGB, static_cast<GLsizei>(image.width), static_cast<GLsizei>(image.height),
                      0, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
    }

    void draw() {
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        draw_picture();
        draw_figures();
        if (shows_panels_) drift_.draw();
        draw_errors();
        ImGui::Render();
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_, &width, &height);
        gl_.viewport(0, 0, width, height);
        gl_.clear(GL_COLOR_BUFFER_BIT);
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        glfwSwapBuffers(window_);
    }

    /// The picture fills the window as far as its sides allow.
    void place_picture() {
        int width = 1, height = 1;
        glfwGetWindowSize(window_, &width, &height);
        const float scale = std::max(std::min(static_cast<float>(width) / static_cast<float>(options_.width),
                                              static_cast<float>(height) / static_cast<float>(options_.height)),
                                     1e-3f);
        size_ = {scale * static_cast<float>(options_.width), scale * static_cast<float>(options_.height)};
        corner_ = {0.5f * (static_cast<float>(width) - size_.x), 0.5f * (static_cast<float>(height) - size_.y)};
    }

    void draw_picture() {
        ImDrawList* list = ImGui::GetBackgroundDrawList();
        const ImVec2 end{corner_.x + size_.x, corner_.y + size_.y};
        list->AddImage(reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(texture_)), corner_, end);
        if (session_.composition().show != Show::Split) return;
        const float x = corner_.x + session_.composition().split * size_.x;
        list->AddLine({x, corner_.y}, {x, end.y}, IM_COL32(255, 255, 255, 160), 1.0f);
    }

    void take_input() {
        const std::vector<InputEvent> events = std::exchange(input_events(), {});
        const ImGuiIO& io = ImGui::GetIO();
        for (const InputEvent& event : events) {
            if (event.kind == InputEvent::Key && !io.WantTextInput) take_key(event.code);
            if (event.kind == InputEvent::Press && !is_on_panel()) press(event);
            if (event.kind == InputEvent::Move) drag(event);
            if (event.kind == InputEvent::Release) release(event);
            constexpr double STEP = 0.9;
            if (event.kind == InputEvent::Wheel && !is_on_panel())
                session_.move("zoom", [&](ViewCamera& camera) { camera.zoom(std::pow(STEP, event.y)); });
        }
        fly();
    }

    /// Asked of each event's own place: what Dear ImGui wants, it says of the place of its last frame.
    bool is_on_panel() const {
        return shows_panels_ && (figures_.holds(mouse_x_, mouse_y_) || drift_.place().holds(mouse_x_, mouse_y_));
    }

    double share_of_width(double x) const {
        return (x - static_cast<double>(corner_.x)) / static_cast<double>(size_.x);
    }
    double share_of_height(double y) const {
        return (y - static_cast<double>(corner_.y)) / static_cast<double>(size_.y);
    }

    void press(const InputEvent& event) {
        constexpr double NEAR_PIXELS = 6.0;
        const double off = share_of_width(mouse_x_) - static_cast<double>(session_.composition().split);
        const bool on_line = std::abs(off) * static_cast<double>(size_.x) < NEAR_PIXELS;
        slides_ = event.code == GLFW_MOUSE_BUTTON_LEFT && session_.composition().show == Show::Split && on_line;
        held_ = event.code;
        pans_ = held_ == GLFW_MOUSE_BUTTON_MIDDLE || (event.modifiers & GLFW_MOD_SHIFT) != 0;
        has_dragged_ = false;
        dragged_x_ = mouse_x_;
        dragged_y_ = mouse_y_;
    }

    void drag(const InputEvent& event) {
        constexpr double CLICK_PIXELS = 3.0;  // a hand that clicks is not quite still
        mouse_x_ = event.x;
        mouse_y_ = event.y;
        if (held_ < 0) return;
        const double x = mouse_x_ - dragged_x_, y = mouse_y_ - dragged_y_;
        if (std::hypot(x, y) < (has_dragged_ ? 1e-9 : CLICK_PIXELS)) return;
        has_dragged_ = true;
        dragged_x_ = mouse_x_;
        dragged_y_ = mouse_y_;
        const double right = x / static_cast<double>(size_.y), down = y / static_cast<double>(size_.y);
        if (slides_) return session_.set_split(static_cast<float>(share_of_width(mouse_x_)));
        if (pans_) return session_.move("pan", [&](ViewCamera& camera) { camera.pan(right, -down); });
        if (held_ == GLFW_MOUSE_BUTTON_RIGHT)
            return session_.move("look", [&](ViewCamera& camera) { camera.look(right, -down); });
        session_.move(
            "orbit", [&](ViewCamera& camera) { camera.orbit(-RADIANS_PER_HEIGHT * right, RADIANS_PER_HEIGHT * down); });
    }

    void release(const InputEvent& event) {
        if (event.code != held_) return;
        if (held_ == GLFW_MOUSE_BUTTON_LEFT && !has_dragged_ && !slides_) pick();
        held_ = -1;
        slides_ = false;
    }

    void pick() {
        const auto picked = session_.pick_at(share_of_width(mouse_x_), share_of_height(mouse_y_));
        picked_ = picked ? fmt::format("{}: instance {}, material {} {}, {:.4g} off", picked->node, picked->instance,
                                       picked->material, picked->material_name, picked->distance)
                         : "nothing there";
        log_.say("input", {{"kind", "pick"}, {"found", picked_}});
    }

    void take_key(int key) {
        if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window_, GLFW_TRUE);
        if (key == GLFW_KEY_TAB) session_.switch_core();
        if (key == GLFW_KEY_1) session_.set_show(Show::One);
        if (key == GLFW_KEY_2) session_.set_show(Show::Split);
        if (key == GLFW_KEY_3) session_.set_show(Show::Difference);
        if (key == GLFW_KEY_LEFT_BRACKET) session_.set_gain(session_.composition().gain / 2);
        if (key == GLFW_KEY_RIGHT_BRACKET) session_.set_gain(session_.composition().gain * 2);
        if (key == GLFW_KEY_T) next_filter();
        if (key == GLFW_KEY_F) session_.frame_all();
        if (key == GLFW_KEY_C) session_.next_camera();
        if (key == GLFW_KEY_P) save(kSavedEndings[0], &ViewSession::save);
        if (key == GLFW_KEY_X) save(kSavedEndings[1], &ViewSession::save_values);
        if (key == GLFW_KEY_K) save(kSavedEndings[2], &ViewSession::save_camera);
        constexpr double STEP_SECONDS = 1.0 / 24.0;
        if (key == GLFW_KEY_SPACE) session_.play_or_pause();
        if (key == GLFW_KEY_COMMA) session_.scrub(session_.seconds() - STEP_SECONDS);
        if (key == GLFW_KEY_PERIOD) session_.scrub(session_.seconds() + STEP_SECONDS);
        if (key == GLFW_KEY_N) drift_.next_finding();
        if (key == GLFW_KEY_O) drift_.propose();
        if (key == GLFW_KEY_ENTER) drift_.apply();
        if (key == GLFW_KEY_H) shows_panels_ = !shows_panels_;
    }

    void next_filter() { session_.set_filter(static_cast<FilterMode>((static_cast<int>(session_.filter()) + 1) % 3)); }

    double held(int key) const { return glfwGetKey(window_, key) == GLFW_PRESS ? 1.0 : 0.0; }
    bool flies() const {
        return held(GLFW_KEY_W) != held(GLFW_KEY_S) || held(GLFW_KEY_D) != held(GLFW_KEY_A) ||
               held(GLFW_KEY_E) != held(GLFW_KEY_Q);
    }

    /// Two fifths of the way to what is looked at in half a second.
    void fly() {
        constexpr double PER_SECOND = 0.8, LONGEST_SECONDS = 0.1;
        const double now = glfwGetTime(), step = PER_SECOND * std::min(now - flown_at_, LONGEST_SECONDS);
        flown_at_ = now;
        if (!flies()) return;
        const double forward = held(GLFW_KEY_W) - held(GLFW_KEY_S), right = held(GLFW_KEY_D) - held(GLFW_KEY_A),
                     up = held(GLFW_KEY_E) - held(GLFW_KEY_Q);
        session_.move("fly", [&](ViewCamera& camera) { camera.fly(step * forward, step * right, step * up); });
    }

    /// By the clock, however long the cores take for a moment.
    void play() {
        const double now = glfwGetTime(), before = std::exchange(played_at_, now);
        if (!session_.is_playing()) return;
        elapsed_ += now - before;
        const double shown = session_.seconds();
        session_.play_on(elapsed_);
        if (session_.seconds() != shown) elapsed_ = 0.0;
    }

    void save(const char* ending, Result<std::string> (ViewSession::*write)(const std::string&) const) {
        const std::string file = saved_file(options_, ending).string();
        const Result<std::string> saved = (session_.*write)(file);
        said_ = saved.ok() ? "saved " + file + *saved : saved.status.message;
        log_.say(saved.ok() ? "input" : "error", {{"kind", "save"}, {"message", said_}});
    }

    void draw_figures() {
        if (!shows_panels_) return;
        ImGui::SetNextWindowPos({8.0f, 8.0f}, ImGuiCond_FirstUseEver);
        ImGui::Begin("pathtracer", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
        figures_ = PanelPlace::of_window();
        for (size_t i = 0; i < session_.core_count(); ++i) {
            const CorePicture& one = session_.picture_of(i);
            ImGui::Text("%s%s", i == session_.active() ? "> " : "  ", session_.core_name(i).c_str());
            if (!session_.problem_of(i).empty()) ImGui::TextUnformatted(session_.problem_of(i).c_str());
            constexpr double MEBIBYTE = 1024.0 * 1024.0;
            if (one.request > 0)
                ImGui::Text("  %llu samples, %.1f ms a pass, %.2f Mrays/s, %.1f MiB",
                            static_cast<unsigned long long>(one.stats.samples), one.pass_ms, one.mrays_per_s,
                            static_cast<double>(one.stats.memory_bytes) / MEBIBYTE);
        }
        ImGui::Text("window %.1f ms", 1e3 * static_cast<double>(ImGui::GetIO().DeltaTime));
        ImGui::SameLine();
        constexpr const char* FILTERS[] = {"filter (T): none", "filter (T): spatial", "filter (T): temporal"};
        if (ImGui::SmallButton(FILTERS[static_cast<int>(session_.filter())])) next_filter();
        if (session_.composition().show == Show::Difference)
            ImGui::Text("difference x %d", session_.composition().gain);
        float split = session_.composition().split;
        if (session_.composition().show == Show::Split && ImGui::SliderFloat("split", &split, 0.0f, 1.0f))
            session_.set_split(split);
        auto seconds = static_cast<float>(session_.seconds());
        if (session_.is_animated() &&
            ImGui::SliderFloat("seconds", &seconds, 0.0f, static_cast<float>(session_.duration())))
            session_.scrub(static_cast<double>(seconds));
        if (!picked_.empty()) ImGui::TextUnformatted(picked_.c_str());
        if (!said_.empty()) ImGui::TextUnformatted(said_.c_str());
        ImGui::TextUnformatted(
            "Tab core  1 2 3 one, split, difference  [ ] gain  F frame  C camera  P X K save  H panels  N finding  O "
            "port");
        if (session_.is_animated()) ImGui::TextUnformatted("Space play, pause  , . a step back, on");
        ImGui::End();
    }

    /// Over the lower edge of the picture.
    void draw_errors() {
        std::string text = session_.reload_error();
        for (size_t i = 0; i < session_.core_count() && text.empty(); ++i) text = session_.problem_of(i);
        if (text.empty()) text = session_.unfiltered_of(session_.active());
        if (text.empty()) return;
        constexpr ImGuiWindowFlags PLAIN = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;
        ImGui::SetNextWindowPos({corner_.x, corner_.y + size_.y}, ImGuiCond_Always, {0.0f, 1.0f});
        ImGui::SetNextWindowSize({size_.x, 0.0f});
        ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(120, 0, 0, 220));
        ImGui::Begin("errors", nullptr, PLAIN);
        ImGui::TextWrapped("%s", text.c_str());
        ImGui::End();
        ImGui::PopStyleColor();
    }

    GLFWwindow* window_;
    const Options& options_;
    ViewSession& session_;
    DriftPanel& panel_;
    DriftWindow drift_;
    ViewLog& log_;
    Gl gl_;
    GLuint texture_ = 0;
    ImVec2 corner_, size_{1.0f, 1.0f};
    double mouse_x_ = 0.0, mouse_y_ = 0.0, flown_at_ = 0.0;
    double played_at_ = 0.0, elapsed_ = 0.0;    ///< seconds that were not shown yet
    double dragged_x_ = 0.0, dragged_y_ = 0.0;  ///< up to where a drag was followed
    PanelPlace figures_;
    int held_ = -1;  ///< the button that drags; -1: none
    bool pans_ = false, slides_ = false, has_dragged_ = false, shows_panels_ = true;
    std::string picked_, said_;
};

}  // namespace

std::filesystem::path saved_file(const Options& options, const char* ending) {
    if (!options.output.empty()) return std::filesystem::path(options.output).replace_extension(ending);
    return std::filesystem::path(options.scene).stem().string() + "_view" + ending;
}

Status check_display() {
    const auto is_set = [](const char* name) {
        const char* value = std::getenv(name);
        return value != nullptr && *value != '\0';
    };
    if (is_set("DISPLAY")) return Status::success();
    return Status::error(StatusCode::no_device,
                         "view: there is no display: DISPLAY is not set; start it in a desktop session or with "
                         "xvfb-run, or use 'pathtracer render'");
}

Status run_window(const Options& options, ViewSession& session, DriftPanel& panel, ViewLog& log) {
    const Glfw glfw;
    if (!glfw.is_up)
        return Status::error(StatusCode::no_device, "view: no window can be opened: " + last_glfw_error() +
                                                        "; is the display of DISPLAY there?");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
    constexpr uint32_t LEAST_WIDTH = 640, LEAST_HEIGHT = 360;
    const std::unique_ptr<GLFWwindow, decltype(&glfwDestroyWindow)> window(
        glfwCreateWindow(static_cast<int>(std::max(options.width, LEAST_WIDTH)),
                         static_cast<int>(std::max(options.height, LEAST_HEIGHT)),
                         ("pathtracer - " + options.scene).c_str(), nullptr, nullptr),
        glfwDestroyWindow);
    if (!window)
        return Status::error(StatusCode::no_device, "view: no OpenGL 3.0 here: " + last_glfw_error() +
                                                        "; install a driver (Debian: libgl1-mesa-dri)");
    glfwMakeContextCurrent(window.get());
    glfwSwapInterval(0);
    note_input_events(window.get());
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // no file of its own in the user's folder
    ImGui::StyleColorsDark();
    ImGui_ImplGlfw_InitForOpenGL(window.get(), true);
    ImGui_ImplOpenGL3_Init("#version 130");
    Window(window.get(), options, session, panel, log).run();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    if (session.is_stuck())
        return Status::error(StatusCode::no_device, "view: " + session.problem_of(session.active()));
    return Status::success();
}

}  // namespace application
