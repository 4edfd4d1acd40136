// What lies over the picture without being part of it: what the program says, and what takes long, with the
// way out of it.
#include "ui/file_tasks.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>

namespace kilolux {

namespace {

constexpr double kShowAfterS = 0.3; // what is over by then needs no words

struct Activity {
    std::string title;                 // "Opening gallery.glb"
    std::string detail;                // "Reading textures"
    double share = 0.0;                // 0 to 1
    const char* cancelPlace = nullptr; // null: it cannot be given up
    void (*cancel)(Desk&) = nullptr;
};

template<typename T>
bool isLong(const Desk& desk, const BackgroundTask<T>& task) {
    return task.isRunning() && desk.nowS - task.sinceS > kShowAfterS;
}

std::vector<Activity> activities(const Desk& desk) {
    const FileTasks& files = *desk.files;
    std::vector<Activity> all;
    if (isLong(desk, files.opening)) {
        all.push_back({"Opening " + files.openingPath.filename().string(), files.opening.watch->doing(),
                       files.opening.watch->share(), "activity.cancel", cancelOpening});
    }
    if (isLong(desk, files.saving)) {
        all.push_back({files.goOn ? "Saving, then going on" : "Saving", files.saving.watch->doing(),
                       files.saving.watch->share(), "activity.cancelSave", cancelSaving});
    }
    const RenderThread::Activity rendering = desk.renderThread->activity();
    if (rendering.words.empty() || !desk.session) return all;
    if (steadyMs() - rendering.sinceMs < 1000.0 * kShowAfterS) return all;
    if (rendering.opens) {
        all.push_back({"Opening " + desk.session->path().filename().string(), rendering.words,
                       rendering.share, "activity.close", requestClose});
    } else {
        all.push_back({rendering.words, "", rendering.share, desk.view.empty() ? nullptr : "activity.view",
                       [](Desk& d) { setView(d, ""); }});
    }
    return all;
}

void drawRow(Desk& desk, const Activity& activity) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(activity.title.c_str());
    if (activity.cancelPlace) {
        const float width = ImGui::CalcTextSize("Cancel").x + 2 * ImGui::GetStyle().FramePadding.x;
        ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
        if (textButton(desk, activity.cancelPlace, "Cancel")) activity.cancel(desk);
    }
    progressBar(desk, activity.share);
    if (activity.detail.empty()) return;
    ImGui::PushFont(theme::smallFont());
    ImGui::TextDisabled("%s", activity.detail.c_str());
    ImGui::PopFont();
}

} // namespace

void drawActivities(Desk& desk, const ViewportRect& rect) {
    const std::vector<Activity> all = activities(desk);
    if (all.empty()) return;
    const float width = std::min(px(desk, 320), float(rect.width) - px(desk, 16));
    if (width < px(desk, 64)) return;
    ImGui::SetNextWindowPos({float(rect.center().x), float(rect.y) + px(desk, 16)}, ImGuiCond_Always,
                            {0.5f, 0});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::SetNextWindowBgAlpha(0.92f);
    ImGui::Begin("activity", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0) ImGui::Spacing();
        drawRow(desk, all[i]);
    }
    ImGui::End();
}

void drawNotices(Desk& desk, const ViewportRect& rect) {
    std::erase_if(desk.notices, [&](const Notice& notice) {
        return notice.kind != Notice::Kind::Error && notice.shownUntilS < desk.nowS;
    });
    if (desk.notices.empty()) return;
    const float width = std::min(px(desk, 440), float(rect.width) - px(desk, 16));
    if (width < px(desk, 64)) return;
    ImGui::SetNextWindowPos({float(rect.x) + px(desk, 8), float(rect.y + rect.height) - px(desk, 8)},
                            ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::SetNextWindowBgAlpha(0.92f);
    ImGui::Begin("notices", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    std::size_t closed = desk.notices.size();
    for (std::size_t i = 0; i < desk.notices.size(); ++i) {
        const Notice& notice = desk.notices[i];
        const bool error = notice.kind == Notice::Kind::Error, plain = notice.kind == Notice::Kind::Info;
        ImGui::PushID(int(i));
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(ImColor(error   ? theme::kError
                                   : plain ? theme::kDim
                                           : theme::kWarning),
                           "%s", plain ? theme::kInfo : theme::kWarn);
        ImGui::SameLine();
        ImGui::PushTextWrapPos(ImGui::GetWindowContentRegionMax().x - px(desk, 32));
        ImGui::TextUnformatted(notice.text.c_str());
        ImGui::PopTextWrapPos();
        if (error) {
            ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - px(desk, 24));
            if (iconButton(desk, "notice.close", theme::kClose, "Close")) closed = i;
        }
        ImGui::PopID();
    }
    ImGui::End();
    if (closed < desk.notices.size()) desk.notices.erase(desk.notices.begin() + std::ptrdiff_t(closed));
}

} // namespace kilolux
