// What the window shows, as JSON in a file that is replaced whenever it changes (kilolux edit --state FILE):
// for tests and for scripts that drive the window.
#pragma once

#include "ui/desk.h"

#include <string>

namespace kilolux {

// Of the time that UI frames and pictures took.
struct WindowTimes {
    std::uint64_t frames = 0;     // drawn
    std::uint64_t slowFrames = 0; // that came more than 50 ms after the event or picture that called for them
    double longestFrameMs = 0.0;
    std::vector<double> frameMs;    // of the newest ones
    std::vector<double> responseMs; // from an input to the picture that answers it
    std::uint64_t eventsTaken = 0;  // keys, buttons and wheel steps since the start
    int framesDue = 0;              // UI frames that the last event or picture still calls for
};

std::string stateText(const Desk& desk, const WindowTimes& times);

// Replaces the file if the text differs from the one before.
class StateFile {
  public:
    explicit StateFile(std::string path) : path_(std::move(path)) {}
    bool isWanted() const { return !path_.empty(); }
    void write(std::string text);

  private:
    std::string path_, written_;
};

} // namespace kilolux
