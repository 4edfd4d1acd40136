// Dialogs of file work, see file_dialogs.h.
#include "ui/file_dialogs.h"

#include "ui/file_tasks.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>
#include <utility>

namespace kilolux {

namespace {

namespace fs = std::filesystem;

bool beginDialog(Desk& desk, const char* title, double width) {
    if (!ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(px(desk, width), screen.x - px(desk, 16)), 0});
    return ImGui::BeginPopupModal(title, nullptr,
                                  ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
}

void close(Desk& desk) {
    desk.files->question = Question::None;
    ImGui::CloseCurrentPopup();
}

void goOn(Desk& desk) {
    close(desk);
    if (auto action = std::exchange(desk.files->goOn, nullptr)) action(desk);
}

// The folder's rows; what was double-clicked or confirmed comes back as a path.
fs::path drawFolder(Desk& desk) {
    FileTasks& files = *desk.files;
    fs::path chosen, enter;
    if (iconButton(desk, "dialog.up", theme::kUp, "Folder above")) enter = files.folder.parent_path();
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    textWithin(files.folder.string(), ImGui::GetContentRegionAvail().x);
    const float height = std::min(px(desk, 320), ImGui::GetIO().DisplaySize.y - px(desk, 180));
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::kEmpty);
    ImGui::BeginChild("entries", {0, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleColor();
    for (const FileTasks::Entry& entry : files.entries) {
        const std::string text =
            fmt::format("{}  {}", entry.isFolder ? theme::kFolder : theme::kFile, entry.name);
        if (ImGui::Selectable(text.c_str(), files.typed == entry.name,
                              ImGuiSelectableFlags_AllowDoubleClick)) {
            const bool twice = ImGui::IsMouseDoubleClicked(0);
            if (entry.isFolder) {
                if (twice) enter = files.folder / entry.name;
            } else {
                files.typed = entry.name;
                if (twice) chosen = files.folder / entry.name;
            }
        }
        mark(desk, "dialog.entry." + entry.name);
    }
    if (files.entries.empty()) ImGui::TextDisabled("No folders, .glb or .gltf files here");
    ImGui::EndChild();
    if (!files.folderError.empty())
        ImGui::TextColored(ImColor(theme::kError), "%s", files.folderError.c_str());
    if (!enter.empty()) listFolder(files, enter);
    return chosen;
}

// A typed path leads to a folder, which is shown, or to a file, which comes back.
fs::path typedPath(FileTasks& files) {
    if (files.typed.empty()) return {};
    const fs::path whole = files.folder / files.typed; // an absolute path replaces the folder
    std::error_code ignored;
    if (!fs::is_directory(whole, ignored)) return whole;
    listFolder(files, whole);
    files.typed.clear();
    return {};
}

void drawFileDialog(Desk& desk, const char* title, const char* action) {
    if (!beginDialog(desk, title, 560)) return;
    FileTasks& files = *desk.files;
    fs::path chosen = drawFolder(desk);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputTextWithHint("##typed", "Name or path", &files.typed,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    mark(desk, "dialog.typed");
    ImGui::Spacing();
    if (textButton(desk, "dialog.ok", action) || entered) chosen = typedPath(files);
    ImGui::SameLine();
    const bool cancelled = textButton(desk, "dialog.cancel", "Cancel") || ImGui::IsKeyPressed(256 /* Esc */);
    const bool saves = files.question == Question::SaveFileAs;
    if (cancelled || !chosen.empty()) close(desk);
    ImGui::EndPopup();
    if (cancelled) return giveUpGoingOn(desk);
    if (chosen.empty()) return;
    if (!saves) return openScene(desk, chosen);
    std::error_code ignored;
    if (fs::exists(chosen, ignored) && !fs::equivalent(chosen, desk.session->path(), ignored)) {
        files.replaced = chosen;
        files.question = Question::ReplaceFile;
    } else {
        saveSceneAs(desk, chosen);
    }
}

struct Choice {
    const char* name;
    const char* text;
};

// A question with its answers side by side; the index of the pressed one, the last one for Esc, -1: none yet.
int ask(Desk& desk, const char* title, const std::string& text, const std::vector<Choice>& choices) {
    if (!beginDialog(desk, title, 440)) return -1;
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::Dummy({0, px(desk, 8)});
    int pressed = -1;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (i > 0) ImGui::SameLine();
        if (textButton(desk, choices[i].name, choices[i].text)) pressed = int(i);
    }
    if (ImGui::IsKeyPressed(256 /* Esc */)) pressed = int(choices.size()) - 1;
    if (pressed >= 0) close(desk);
    ImGui::EndPopup();
    return pressed;
}

void askUnsaved(Desk& desk) {
    const std::string name = desk.session ? desk.session->path().filename().string() : "";
    const int answer =
        ask(desk, "Unsaved changes", fmt::format("{} has changes that are not saved.", name),
            {{"unsaved.save", "Save"}, {"unsaved.discard", "Discard"}, {"unsaved.cancel", "Cancel"}});
    if (answer == 0) {
        saveScene(desk); // and goes on
    } else if (answer == 1) {
        if (desk.session) desk.files->discardedVersion = desk.session->version();
        goOn(desk);
    } else if (answer == 2) {
        giveUpGoingOn(desk);
    }
}

void askRecover(Desk& desk) {
    FileTasks& files = *desk.files;
    const int answer = ask(
        desk, "Recover changes",
        fmt::format("The last session with {} ended without saving. {} change{} can be recovered.",
                    files.openingPath.filename().string(), files.recoverable,
                    files.recoverable == 1 ? "" : "s"),
        {{"recover.yes", "Recover"}, {"recover.no", "Open the saved file"}, {"recover.cancel", "Cancel"}});
    if (answer == 0) startOpening(desk, files.openingPath, SessionOptions::Recovery::TakeUp, false);
    if (answer == 1) startOpening(desk, files.openingPath, SessionOptions::Recovery::PutAside, false);
}

void askChangedOnDisk(Desk& desk) {
    const int answer =
        ask(desk, "Changed on disk",
            fmt::format("Another program has changed {} since it was opened. Saving replaces what it wrote.",
                        desk.session ? desk.session->path().filename().string() : ""),
            {{"disk.overwrite", "Overwrite"}, {"disk.saveAs", "Save as..."}, {"disk.cancel", "Cancel"}});
    if (answer == 0) saveScene(desk, Overwriting::Anything);
    if (answer == 1) askToSaveAs(desk);
    if (answer == 2) giveUpGoingOn(desk);
}

void askReplace(Desk& desk) {
    const int answer = ask(desk, "Replace file",
                           fmt::format("{} is there already.", desk.files->replaced.filename().string()),
                           {{"replace.yes", "Replace"}, {"replace.cancel", "Cancel"}});
    if (answer == 0) saveSceneAs(desk, desk.files->replaced);
    if (answer == 1) giveUpGoingOn(desk);
}

} // namespace

void drawFileDialogs(Desk& desk) {
    switch (desk.files->question) {
    case Question::None:
        return;
    case Question::OpenFile:
        return drawFileDialog(desk, "Open a scene", "Open");
    case Question::SaveFileAs:
        return drawFileDialog(desk, "Save as", "Save");
    case Question::UnsavedChanges:
        return askUnsaved(desk);
    case Question::Recover:
        return askRecover(desk);
    case Question::ChangedOnDisk:
        return askChangedOnDisk(desk);
    case Question::ReplaceFile:
        return askReplace(desk);
    }
}

void drawFirstRun(Desk& desk, const ViewportRect& rect) {
    const float width = std::min(px(desk, 420), float(rect.width) - px(desk, 24));
    ImGui::SetNextWindowPos({float(rect.center().x), float(rect.center().y)}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::Begin("first run", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::TextUnformatted("Open a scene to light it");
    ImGui::PushStyleColor(ImGuiCol_Text, theme::kDim);
    ImGui::TextWrapped("Drop a .glb or .gltf file onto this window, or choose one.");
    ImGui::PopStyleColor();
    ImGui::Dummy({0, px(desk, 4)});
    if (textButton(desk, "first.open", "Open...")) askToOpen(desk);
    const std::vector<std::string> recent = desk.files->remembered.recent;
    if (!recent.empty()) {
        ImGui::Dummy({0, px(desk, 8)});
        ImGui::TextDisabled("Recent");
    }
    constexpr std::size_t kShown = 6;
    for (std::size_t i = 0; i < recent.size() && i < kShown; ++i) {
        const fs::path path = recent[i];
        ImGui::PushID(int(i));
        if (ImGui::Selectable("##recent")) openScene(desk, path);
        mark(desk, fmt::format("first.recent.{}", i));
        tooltip(recent[i].c_str());
        ImGui::SameLine(0, 0);
        ImGui::TextUnformatted(path.filename().string().c_str());
        ImGui::SameLine();
        ImGui::PushStyleColor(ImGuiCol_Text, theme::kDim);
        textWithin(path.parent_path().string(), ImGui::GetContentRegionAvail().x);
        ImGui::PopStyleColor();
        ImGui::PopID();
    }
    ImGui::Dummy({0, px(desk, 8)});
    ImGui::PushStyleColor(ImGuiCol_Text, theme::kDim);
    ImGui::TextWrapped(
        "Right mouse and W A S D fly, Alt and left mouse orbits, the wheel comes closer, F frames "
        "what is selected, Tab hides the panels. F1 shows every key.");
    ImGui::PopStyleColor();
    ImGui::End();
}

} // namespace kilolux
