// Rows of the properties panel whose values are no numbers: flags, words, channels, files.
#pragma once

#include "ui/properties_state.h"

namespace kilolux {

void drawFlagRow(Desk& desk, const LightField& row);
void drawWordRow(Desk& desk, const LightField& row);
void drawChannelsRow(Desk& desk, const LightField& row);
void drawFileRow(Desk& desk, const LightField& row);
void drawPresetRow(Desk& desk);  // named luminaires
void drawDoorSwitch(Desk& desk); // one pair or four flaps

// Eight buttons, one a channel, named '<name>.1' and so on for tests; the bits after one was pressed.
std::optional<std::uint64_t> channelButtons(Desk& desk, const std::string& name, const CommonValue& value,
                                            float widthPx);

// A choice of the profiles, or else pictures, in the scene's folder; the URI that was chosen, empty for none.
std::optional<std::string> fileCombo(Desk& desk, const std::string& name, const CommonValue& value,
                                     bool isProfile, float widthPx);

} // namespace kilolux
