// The commands of the program. Each adds itself to the command line and hands back what to run when the user
// chose it.
#pragma once

#include "app/messages.h"

#include <CLI/App.hpp>
#include <functional>
#include <string>

namespace kilolux {

using Command = std::function<ExitCode()>;

// kilolux render SCENE -o OUT: a picture, statistics and targets to files.
Command addRenderCommand(CLI::App& app);

// kilolux probe SCENE --pixel X,Y: everything about one pixel.
Command addProbeCommand(CLI::App& app);

// kilolux bench SCENES -o FOLDER: speed against error.
Command addBenchCommand(CLI::App& app);

// kilolux edit [SCENE]: the window, or a list of edits.
Command addEditCommand(CLI::App& app);

// kilolux [SCENE]: the window. Without a scene it tells how to begin.
ExitCode runWindowCommand(const std::string& scene);

} // namespace kilolux
