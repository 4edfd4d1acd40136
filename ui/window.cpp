// The loop of the UI thread, see window.h.
#include "ui/window.h"

#include "renderer/settings_presets.h"
#include "ui/file_tasks.h"
#include "ui/glfw_input.h"
#include "ui/imgui_host.h"
#include "ui/layout.h"
#include "ui/panels.h"
#include "ui/quality_part.h"
#include "ui/reference_image.h"
#include "ui/state_file.h"
#include "ui/theme.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>
#include <utility>

namespace kilolux {

namespace {

// Between two UI frames. On a software device each takes time from the picture, so they come half as often.
constexpr double kFrameMs = 1000.0 / 60.0, kSoftwareFrameMs = 1000.0 / 36.0;
constexpr double kSlowFrameMs = 50.0;
constexpr double kSizeSettlesMs = 120.0; // a size that holds so long is rendered at
constexpr int kFramesPerEvent = 3;       // ImGui shows some answers a frame or two later
constexpr std::size_t kKeptTimes = 512;

void keep(std::vector<double>& times, double ms) {
    if (times.size() == kKeptTimes) times.erase(times.begin());
    times.push_back(std::round(ms * 10.0) / 10.0);
}

class Window {
  public:
    explicit Window(const WindowOptions& options) : options_(options), state_(options.stateFile) {}
    ~Window();
    std::optional<Error> open();
    std::optional<Error> run();

  private:
    void chooseScale();
    void wait();
    void drawFrame(const std::vector<InputEvent>& events, double dueMs);
    void takePicture();
    void showPicture();
    void followSize(const ViewportRect& rect);
    void handleKeys();
    void remember();
    bool isBusy() const;

    WindowOptions options_;
    GLFWwindow* window_ = nullptr;
    GlfwInput input_;
    std::unique_ptr<ImGuiHost> host_;
    Desk desk_;
    std::unique_ptr<RenderThread> renderThread_;
    WindowTimes times_;
    StateFile state_;
    bool hasContext_ = false;
    int framesDue_ = kFramesPerEvent;
    double startMs_ = steadyMs();
    double lastFrameMs_ = 0.0;
    glm::ivec2 windowPx_{0};
    glm::ivec2 askedPx_{0}, seenPx_{0}; // of the viewport
    double seenSinceMs_ = 0.0;
    std::atomic<bool> news_ = false; // of a panel's own thread
    std::optional<Error> failed_;
};

Window::~Window() {
    renderThread_.reset();
    desk_.reference.reset(); // its thread wakes the window
    desk_.drawn.reset();
    desk_.shown.reset();
    host_.reset();
    if (hasContext_) ImGui::DestroyContext();
    if (window_) glfwDestroyWindow(window_);
    glfwTerminate();
}

std::optional<Error> Window::open() {
    if (!glfwInit() || !glfwVulkanSupported()) {
        const char* why = nullptr;
        glfwGetError(&why);
        return Error{fmt::format("cannot open a window: {}; without one: kilolux render SCENE.glb -o OUT.png",
                                 why ? why : "this display has no Vulkan")};
    }
    desk_.files = std::make_shared<FileTasks>();
    FileTasks& files = *desk_.files;
    files.rememberedPath = rememberedPath();
    files.remembered = readRemembered(files.rememberedPath);
    desk_.panels = files.remembered.panels;
    desk_.snapping = files.remembered.snapping;
    desk_.gizmoSizePx = files.remembered.gizmoSizePx;
    desk_.limits = files.remembered.limits;
    const std::string& preset = options_.preset.empty() ? files.remembered.preset : options_.preset;
    if (const SettingsPreset* found = findPreset(preset)) applyPreset(desk_.settings, *found);
    desk_.recordsPlaces = state_.isWanted();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    const int width = options_.width > 0 ? options_.width : files.remembered.windowWidth;
    const int height = options_.height > 0 ? options_.height : files.remembered.windowHeight;
    window_ = glfwCreateWindow(width, height, "Kilolux", nullptr, nullptr);
    if (!window_) return Error{"cannot open a window of this size"};
    installInput(window_, input_);
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    hasContext_ = true;
    ImGui::GetIO().IniFilename = nullptr; // the layout is our own
    connectImGui(input_);
    Result<std::unique_ptr<ImGuiHost>> host = ImGuiHost::create(window_);
    if (!host) return Error{host.error()};
    host_ = std::move(host.value());
    chooseScale();
    desk_.wake = [this] {
        news_ = true;
        glfwPostEmptyEvent();
    };
    renderThread_ = std::make_unique<RenderThread>([] { glfwPostEmptyEvent(); });
    renderThread_->setLimits(desk_.limits);
    desk_.renderThread = renderThread_.get();
    if (!options_.scene.empty()) startOpening(desk_, options_.scene, SessionOptions::Recovery::TakeUp, true);
    return std::nullopt;
}

// What the system says, or what the screen's height suggests where it says nothing: text of the same size on
// 2160 lines as on 1080.
void Window::chooseScale() {
    double scale = options_.uiScale > 0.0 ? options_.uiScale : desk_.files->remembered.uiScale;
    if (scale <= 0.0) {
        float systemX = 1.0f, systemY = 1.0f;
        glfwGetWindowContentScale(window_, &systemX, &systemY);
        const GLFWvidmode* mode =
            glfwGetPrimaryMonitor() ? glfwGetVideoMode(glfwGetPrimaryMonitor()) : nullptr;
        const double byHeight = mode ? std::round(mode->height / 1080.0 * 4.0) / 4.0 : 1.0;
        scale = std::clamp(std::max(double(systemX), byHeight), 1.0, 4.0);
    }
    desk_.uiScale = scale;
    theme::apply(scale);
    if (const auto error = theme::loadFonts(scale)) notify(desk_, Notice::Kind::Warning, error->message);
    if (const auto error = host_->uploadFonts()) failed_ = error;
}

// Whether something moves by itself.
bool Window::isBusy() const {
    if (desk_.flying || desk_.files->isOpening() || desk_.files->isSaving()) return true;
    if (!renderThread_->activity().words.empty()) return true;
    return ImGui::GetIO().WantTextInput; // the caret blinks
}

// Until an event, a new picture, or the next frame is due. Without any of them the thread sleeps.
void Window::wait() {
    const double frameMs = host_->isSoftware() ? kSoftwareFrameMs : kFrameMs;
    if (framesDue_ == 0 && isBusy()) {
        framesDue_ = 1;
    } else if (framesDue_ == 0 && (desk_.session || !desk_.notices.empty())) {
        glfwWaitEventsTimeout(0.5); // the file on disk, notices that fade
        framesDue_ = desk_.notices.empty() ? 0 : 1;
    } else if (framesDue_ == 0) {
        glfwWaitEvents();
    }
    // A pointer that moves a thousand times a second is no reason to draw as often.
    for (double restMs = 0.0; (restMs = lastFrameMs_ + frameMs - steadyMs()) > 0.0;)
        glfwWaitEventsTimeout(restMs / 1000.0);
    glfwPollEvents();
}

void Window::takePicture() {
    if (auto error = renderThread_->takeError()) notify(desk_, Notice::Kind::Error, error->message);
    std::shared_ptr<const ShownFrame> frame = renderThread_->takeFrame();
    if (!frame || !desk_.session) return;
    desk_.shown = std::move(frame);
    desk_.viewport.camera = desk_.shown->camera;
    if (!desk_.session->scene().hasExposure && !desk_.meteredEv100) {
        desk_.meteredEv100 = desk_.shown->statistics.exposureEv100;
        desk_.exposureEv100 = *desk_.meteredEv100;
    }
}

// The newest picture, or what a comparison shows in its place.
void Window::showPicture() {
    std::shared_ptr<const ShownFrame> wanted = comparedPicture(desk_);
    if (!wanted || !desk_.session) wanted = desk_.shown;
    if (wanted == desk_.drawn) return;
    desk_.drawn = std::move(wanted);
    host_->setPicture(desk_.drawn.get());
}

// The viewport's size goes to the renderer once it stands still.
void Window::followSize(const ViewportRect& rect) {
    desk_.viewport.rect = rect;
    const glm::ivec2 size{int(rect.width), int(rect.height)};
    const double now = steadyMs();
    if (size != seenPx_) {
        seenPx_ = size;
        seenSinceMs_ = now;
    }
    if (seenPx_ == askedPx_) return;
    if (askedPx_.x == 0 || now - seenSinceMs_ > kSizeSettlesMs) {
        askedPx_ = seenPx_;
        renderThread_->setSize(askedPx_);
    } else {
        framesDue_ = std::max(framesDue_, 1);
    }
}

void Window::handleKeys() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || desk_.files->question != Question::None) return;
    const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
    if (pressed(GLFW_KEY_F1)) desk_.showsHelp = !desk_.showsHelp;
    if (desk_.showsHelp) {
        // It lies over everything: Esc is for it, and nothing is worked at below.
        if (pressed(GLFW_KEY_ESCAPE)) desk_.showsHelp = false;
        return;
    }
    if (io.KeyCtrl) {
        if (pressed(GLFW_KEY_Z)) io.KeyShift ? redo(desk_) : undo(desk_);
        if (pressed(GLFW_KEY_Y)) redo(desk_);
        if (pressed(GLFW_KEY_O)) askToOpen(desk_);
        if (pressed(GLFW_KEY_S)) io.KeyShift ? askToSaveAs(desk_) : saveScene(desk_);
        if (pressed(GLFW_KEY_Q)) requestQuit(desk_);
    } else {
        if (pressed(GLFW_KEY_TAB)) desk_.panels.all = !desk_.panels.all;
        if (pressed(GLFW_KEY_F)) frameSelection(desk_);
    }
    if (!desk_.session) return;
    handleViewKeys(desk_);
    handleLightKeys(desk_);
}

void Window::drawFrame(const std::vector<InputEvent>& events, double dueMs) {
    const double beginMs = steadyMs();
    // What goes on by itself, as a held key flies, answers this moment.
    desk_.inputMs = events.empty() ? beginMs : events.back().atMs;
    desk_.nowS = (beginMs - startMs_) / 1000.0;
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {float(windowPx_.x), float(windowPx_.y)};
    // After a rest the first step is a usual one: nothing moved meanwhile.
    io.DeltaTime = float(std::clamp((beginMs - lastFrameMs_) / 1000.0, 0.001, 0.1));
    lastFrameMs_ = beginMs;
    feedImGui(events);
    times_.eventsTaken +=
        std::uint64_t(std::count_if(events.begin(), events.end(), [](const InputEvent& event) {
            return event.kind != InputEvent::Kind::Move && event.kind != InputEvent::Kind::Text;
        }));
    takePicture();
    const Layout layout = makeLayout(desk_, windowPx_);
    followSize(layout.viewport);
    desk_.places.clear();
    ImGui::NewFrame();
    handleKeys();
    drawLayout(desk_, layout);
    showPicture();
    ImGui::Render();
    showCursor(window_);
    if (auto error = host_->present(windowPx_, layout.viewport)) failed_ = error;
    const double endMs = steadyMs();
    const double tookMs = endMs - dueMs;
    ++times_.frames;
    times_.slowFrames += tookMs > kSlowFrameMs;
    times_.longestFrameMs = std::max(times_.longestFrameMs, tookMs);
    keep(times_.frameMs, tookMs);
}

void Window::remember() {
    rememberLocks(desk_);
    FileTasks& files = *desk_.files;
    Remembered& remembered = files.remembered;
    int width = 0, height = 0;
    glfwGetWindowSize(window_, &width, &height);
    if (width > 0 && height > 0) remembered.windowWidth = width, remembered.windowHeight = height;
    remembered.panels = desk_.panels;
    remembered.snapping = desk_.snapping;
    remembered.gizmoSizePx = desk_.gizmoSizePx;
    remembered.limits = desk_.limits;
    remembered.preset = presetName(desk_.settings);
    // Remembering is a convenience: a folder that cannot be written to is no reason to stay.
    writeRemembered(files.rememberedPath, remembered);
}

std::optional<Error> Window::run() {
    while (!desk_.quits && !failed_) {
        wait();
        const double dueMs = input_.queue.empty() ? steadyMs() : 0.0;
        glfwGetFramebufferSize(window_, &windowPx_.x, &windowPx_.y);
        int pointsX = 1, pointsY = 1;
        glfwGetWindowSize(window_, &pointsX, &pointsY);
        input_.pxPerPoint = {double(windowPx_.x) / std::max(pointsX, 1),
                             double(windowPx_.y) / std::max(pointsY, 1)};
        const bool hidden =
            windowPx_.x == 0 || windowPx_.y == 0 || glfwGetWindowAttrib(window_, GLFW_ICONIFIED);
        renderThread_->setPaused(hidden);
        if (glfwWindowShouldClose(window_)) {
            glfwSetWindowShouldClose(window_, GLFW_FALSE);
            requestQuit(desk_);
        }
        if (!input_.dropped.empty()) openScene(desk_, input_.dropped.front());
        input_.dropped.clear();
        if (hidden) {
            // Nothing is drawn, but a button or key that is let go must not stay down.
            while (!input_.queue.empty())
                feedImGui(input_.queue.takeFrame());
            ImGui::GetIO().ClearInputCharacters();
            glfwWaitEventsTimeout(0.2);
            continue;
        }
        desk_.nowS = (steadyMs() - startMs_) / 1000.0;
        const bool filesChanged = pollFileTasks(desk_);
        if (filesChanged || !input_.queue.empty() || std::exchange(input_.changed, false) ||
            renderThread_->hasNews() || news_.exchange(false))
            framesDue_ = kFramesPerEvent;
        while (framesDue_ > 0 && !failed_) {
            const std::vector<InputEvent> events = input_.queue.takeFrame();
            const double beganMs = events.empty() ? (dueMs > 0.0 ? dueMs : steadyMs()) : events.front().atMs;
            --framesDue_;
            const std::uint64_t shownBefore = desk_.shown ? desk_.shown->number : 0;
            drawFrame(events, beganMs);
            if (desk_.shown && desk_.shown->number != shownBefore && desk_.shown->requestedMs > 0.0)
                keep(times_.responseMs, steadyMs() - desk_.shown->requestedMs);
            if (input_.queue.empty()) break;
            framesDue_ = kFramesPerEvent;
        }
        times_.framesDue = framesDue_;
        if (state_.isWanted()) state_.write(stateText(desk_, times_));
    }
    remember();
    if (!failed_) closeScene(desk_);
    return failed_;
}

} // namespace

std::optional<Error> runWindow(const WindowOptions& options) {
    Window window(options);
    if (auto error = window.open()) return error;
    return window.run();
}

} // namespace kilolux
