// The program's entry: reads the command line, runs the chosen command and turns everything that can go wrong
// into one line on stderr and an exit code.
#include "app/choices.h"
#include "app/commands.h"

#include "renderer/nearest_name.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <new>

namespace kilolux {
namespace {

constexpr const char* kHelpFooter = R"(Start with:
  kilolux SCENE.glb                    the window
  kilolux render SCENE.glb -o OUT.png
  kilolux render --help

Exit codes: 0 done, 1 lint findings, 2 bad input or arguments, 3 could not work (device, disk).)";

const CLI::App& chosenCommand(const CLI::App& app) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    return chosen.empty() ? app : *chosen.front();
}

bool isSceneName(const std::string& text) {
    return text.ends_with(".glb") || text.ends_with(".gltf");
}

// A mistyped option or command is told the nearest known one.
std::string unexpectedArgument(const CLI::App& command, const std::string& argument,
                               const std::string& help) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(subcommand->get_name());
    const std::vector<std::string_view> views(names.begin(), names.end());
    const std::string_view nearest = nearestName(argument, views);
    const std::string meant = nearest.empty() ? std::string() : fmt::format("; did you mean '{}'?", nearest);
    return fmt::format("unexpected argument '{}'{} ({})", argument, meant, help);
}

std::string helpHint(const CLI::App& command) {
    return fmt::format("see '{} --help'",
                       command.get_parent() ? "kilolux " + command.get_name() : std::string("kilolux"));
}

// `scene`: what stands where a scene to open would.
std::string argumentError(const CLI::App& app, const CLI::ParseError& error, const std::string& scene) {
    const CLI::App& command = chosenCommand(app);
    const std::vector<std::string> unknown = app.remaining(true);
    if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::ExtrasError) || unknown.empty())
        return fmt::format("{} ({})", error.what(), helpHint(command));
    const bool sceneIsWrong = !scene.empty() && !isSceneName(scene);
    return unexpectedArgument(command, sceneIsWrong ? scene : unknown.front(), helpHint(command));
}

ExitCode runCommandLine(int argc, char** argv) {
    CLI::App app{"Kilolux, a lighting tool for scenes with very many shadowed area lights.", "kilolux"};
    app.footer(kHelpFooter);
    app.set_version_flag("--version", "kilolux " KILOLUX_VERSION, "print the version and exit");
    app.set_help_flag("-h,--help", "print this help and exit");
    bool list = false;
    bool json = false;
    app.add_flag("--list", list, "list methods, views and settings");
    app.add_flag("--json", json, "with --list: as JSON")->needs("--list");
    app.require_subcommand(0, 1);
    std::string scene;
    app.add_option("SCENE", scene, "a .gltf or .glb file to open in the window");
    const Command render = addRenderCommand(app);
    const Command probe = addProbeCommand(app);
    const Command bench = addBenchCommand(app);
    const Command edit = addEditCommand(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // Success is how CLI11 hands --help and --version over.
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
            app.exit(error);
            return ExitCode::Done;
        }
        printError(argumentError(app, error, scene));
        return ExitCode::BadInput;
    }
    if (list) {
        fmt::print("{}", listChoices(json ? ListFormat::Json : ListFormat::Text));
        return ExitCode::Done;
    }
    if (app.got_subcommand("render")) return render();
    if (app.got_subcommand("probe")) return probe();
    if (app.got_subcommand("bench")) return bench();
    if (app.got_subcommand("edit")) return edit();
    if (!scene.empty() && !isSceneName(scene)) {
        printError(unexpectedArgument(app, scene, helpHint(app)));
        return ExitCode::BadInput;
    }
    return runWindowCommand(scene);
}

} // namespace
} // namespace kilolux

int main(int argc, char** argv) {
    using kilolux::ExitCode;
    ExitCode code = ExitCode::CouldNotWork;
    try {
        code = kilolux::runCommandLine(argc, argv);
    } catch (const std::bad_alloc&) {
        kilolux::printError("out of memory");
    } catch (const std::exception& error) {
        kilolux::printError(error.what());
    }
    // A list piped into a full disk must not look like success.
    if (std::fflush(stdout) != 0 && code == ExitCode::Done) {
        kilolux::printError("cannot write to standard output");
        code = ExitCode::CouldNotWork;
    }
    return static_cast<int>(code);
}
