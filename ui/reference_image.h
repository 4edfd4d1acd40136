// Comparing pictures in the viewport: a stored one, a split view with a line that is dragged, and the error
// against a live reference. See panels.h.
#pragma once

#include "ui/live_reference.h"
#include "ui/picture_export.h"
#include "ui/render_thread.h"

#include <memory>
#include <string>

namespace kilolux {

struct Desk;

enum class Comparing { Off, Stored, Split, Error, Reference };

struct ReferenceState {
    Comparing mode = Comparing::Off;
    std::shared_ptr<const ShownFrame> stored;
    std::string storedExposure; // what it was taken with, in words
    double splitAt = 0.5;       // of the picture's width: the stored one is on the left
    bool dragging = false;

    // --- live error
    bool measures = false;
    std::shared_ptr<LiveReference> live; // made when first wanted; its thread stays
    std::string method = "split";
    std::uint64_t wantedKey = 0;
    std::uint32_t comparedFrames = 0; // of the reference, when a picture was last measured
    std::uint32_t comparedMean = 0;   // of that picture
    std::string comparedPreset;
    bool comparing = false;
    std::shared_ptr<const ErrorReport> report;

    // --- what was composed last, and of what
    std::shared_ptr<const ShownFrame> composed;
    const void* composedOf[3] = {};
    double composedAt = 0.0;
    Comparing composedMode = Comparing::Off;
};

// What a reference is rendered with: the settings as they are, but of the best quality, so that all presets
// are measured against one.
Settings referenceSettings(const Settings& settings);

// Left of `at` (a share of the width) `left`, right of it `right`, which gives the size.
std::shared_ptr<const ShownFrame> splitPicture(const ShownFrame& left, const ShownFrame& right, double at);

// The map of a report in the colours of amounts, and what they mean.
std::shared_ptr<const ShownFrame> errorPicture(const ErrorReport& report);
Legend errorLegend();

// The live reference begins anew: what it was of is closed. The stored picture stays.
void forgetReference(Desk& desk);

void toggleStored(Desk& desk); // shows the stored picture, or no longer

// The part of the view panel: store, toggle, split, error.
void drawReferencePart(Desk& desk);

// What the window draws in place of the newest picture; null: that one.
std::shared_ptr<const ShownFrame> comparedPicture(const Desk& desk);

} // namespace kilolux
