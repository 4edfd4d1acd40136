// kilolux edit: says what there is instead of the window until the window exists.
#include "app/commands.h"

#include <memory>
#include <string>

namespace kilolux {

Command addEditCommand(CLI::App& app) {
    CLI::App* edit = app.add_subcommand("edit", "Open the window (not there yet)");
    auto scene = std::make_shared<std::string>();
    edit->add_option("SCENE", *scene, "a .gltf or .glb file");
    return [scene] {
        const std::string name = scene->empty() ? "SCENE.glb" : "'" + *scene + "'";
        printError("the window does not exist yet; render to a file instead: kilolux render " + name +
                   " -o OUT.png");
        return ExitCode::CouldNotWork;
    };
}

} // namespace kilolux
