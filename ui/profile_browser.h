// The window that shows photometric profiles: those of the scene's folder, of content/ies and of a folder to
// be chosen, with their polar plots and figures.
#pragma once

#include "ui/desk.h"
#include "ui/profile_facts.h"

#include <future>

struct ImDrawList;

namespace kilolux {

struct ProfileBrowserState {
    bool open = false;
    std::filesystem::path folder; // chosen; empty: none yet
    std::string typed;
    std::future<std::vector<ProfileEntry>> reading; // beside the window
    std::vector<ProfileEntry> entries;
    int chosen = -1;
};

void openProfileBrowser(Desk& desk);
void drawProfileBrowser(Desk& desk);

// A profile for the selected lights, copied beside the scene where it lies elsewhere.
void useProfile(Desk& desk, const std::filesystem::path& profile);

// Where the profiles that the project ships lie.
std::filesystem::path shippedProfiles();

} // namespace kilolux
