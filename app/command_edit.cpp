// kilolux edit: the window, or a list of edits applied to a scene without it.
#include "app/choices.h"
#include "app/commands.h"

#include "renderer/document/edit_script.h"
#include "renderer/document/file_replace.h"
#include "renderer/settings_presets.h"
#include "ui/window.h"

#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace kilolux {

namespace {

using Json = nlohmann::json;

constexpr const char* kFooter = R"(Examples:
  kilolux edit scene.glb                              open it in the window
  kilolux edit scene.glb --do edits.json              change the file itself
  kilolux edit scene.glb --do edits.json -o new.glb   leave it as it is
  kilolux edit --list                                 every field that can be edited
The list of edits is described in renderer/document/edits.md.)";

struct EditOptions {
    std::string scene, script, output;
    std::string state, size, preset;
    double uiScale = 0.0;
    bool list = false;
    bool json = false;
};

const char* kindWord(FieldKind kind) {
    switch (kind) {
    case FieldKind::Number:
        return "number";
    case FieldKind::OptionalNumber:
        return "number or null";
    case FieldKind::Flag:
        return "true or false";
    case FieldKind::Text:
        return "text";
    case FieldKind::Color:
        return "three numbers";
    case FieldKind::Type:
    case FieldKind::Unit:
    case FieldKind::Word:
        return "word";
    case FieldKind::Profile:
        return "profile's file or null";
    case FieldKind::Picture:
        return "picture's file or null";
    case FieldKind::Channels:
        return "bits, 0 to 255";
    case FieldKind::Transform:
        return "translation, rotation, scale";
    case FieldKind::Frame:
        return "16 numbers";
    case FieldKind::GroupId:
        return "group's name or null";
    case FieldKind::DefIndex:
        break;
    }
    return "";
}

const char* targetWord(EditTarget target) {
    switch (target) {
    case EditTarget::Light:
    case EditTarget::Definition:
        return "light";
    case EditTarget::Node:
        return "node";
    case EditTarget::Group:
        return "group";
    case EditTarget::Bookmark:
        return "bookmark";
    case EditTarget::Scene:
        break;
    }
    return "scene";
}

std::string listFields(ListFormat format) {
    Json list = Json::array();
    std::string text, heading;
    for (const EditField& field : editFields()) {
        if (field.kind == FieldKind::DefIndex) continue; // 'make-unique' sets it
        const bool isNumber = field.kind == FieldKind::Number || field.kind == FieldKind::OptionalNumber;
        Json entry = {{"target", targetWord(field.target)},
                      {"name", field.name},
                      {"kind", kindWord(field.kind)},
                      {"help", field.help}};
        if (isNumber) entry["min"] = field.min, entry["max"] = field.max;
        if (*field.unit) entry["unit"] = field.unit;
        if (heading != targetWord(field.target))
            text += fmt::format("{}{}\n", text.empty() ? "" : "\n", heading = targetWord(field.target));
        const std::string bounds = isNumber ? fmt::format(" {:.4g} to {:.4g}", field.min, field.max) : "";
        text += fmt::format("  {:<20} {} [{}{}{}{}]\n", field.name, field.help, kindWord(field.kind), bounds,
                            *field.unit ? " " : "", field.unit);
        list.push_back(std::move(entry));
    }
    return format == ListFormat::Json ? Json{{"fields", list}}.dump(2) + "\n" : text;
}

Result<Json> readScript(const std::string& path) {
    const Result<std::string> text = readWholeFile(path);
    if (!text) return Error{text.error()};
    try {
        return Json::parse(text.value());
    } catch (const Json::exception& error) {
        // The library's own tag in brackets says nothing to users.
        const std::string what = error.what();
        const std::size_t bracket = what.find("] ");
        return Error{path + ": expected valid JSON, found a " +
                     (bracket == what.npos ? what : what.substr(bracket + 2))};
    }
}

ExitCode applyScript(const EditOptions& options) {
    const Result<Json> script = readScript(options.script);
    if (!script) return printError(script.error()), ExitCode::BadInput;
    SessionOptions sessionOptions;
    sessionOptions.import.loadImages = false; // nothing of them is edited
    auto session = EditSession::open(options.scene, sessionOptions);
    if (!session) return printError(session.error()), ExitCode::BadInput;
    if (const auto error = runEditScript(*session.value(), script.value()))
        return printError(options.script + ": " + error->message), ExitCode::BadInput;
    const auto error =
        options.output.empty() ? session.value()->save() : session.value()->saveAs(options.output);
    if (error) return printError(error->message), ExitCode::CouldNotWork;
    for (const std::string& warning : session.value()->scene().warnings)
        printWarning(warning);
    return ExitCode::Done;
}

ExitCode openWindow(const EditOptions& options) {
    WindowOptions window;
    window.scene = options.scene;
    window.stateFile = options.state;
    window.uiScale = options.uiScale;
    window.preset = options.preset;
    if (Settings settings; !options.preset.empty()) {
        if (const auto error = applyPreset(settings, options.preset))
            return printError(error->message), ExitCode::BadInput;
    }
    if (!options.size.empty()) {
        const Result<PictureSize> size = parsePictureSize(options.size);
        if (!size) return printError(size.error()), ExitCode::BadInput;
        window.width = size.value().width;
        window.height = size.value().height;
    }
    if (const auto error = runWindow(window)) return printError(error->message), ExitCode::CouldNotWork;
    return ExitCode::Done;
}

ExitCode runEdit(const EditOptions& options) {
    if (options.list) {
        fmt::print("{}", listFields(options.json ? ListFormat::Json : ListFormat::Text));
        return ExitCode::Done;
    }
    if (!options.script.empty()) {
        if (!options.scene.empty()) return applyScript(options);
        printError("expected a scene to edit: kilolux edit SCENE.glb --do " + options.script);
        return ExitCode::BadInput;
    }
    return openWindow(options);
}

} // namespace

Command addEditCommand(CLI::App& app) {
    CLI::App* edit = app.add_subcommand("edit", "Edit a scene: in the window, or by a list of edits");
    auto options = std::make_shared<EditOptions>();
    edit->footer(kFooter);
    edit->add_option("SCENE", options->scene, "a .gltf or .glb file");
    CLI::Option* script =
        edit->add_option("--do", options->script, "a JSON file with edits to apply")->option_text("FILE");
    edit->add_option("-o,--output", options->output, "save here instead of in place")
        ->option_text("OUT")
        ->needs(script);
    edit->add_option("--state", options->state, "write what the window shows as JSON, for tests and scripts")
        ->option_text("FILE");
    edit->add_option("--size", options->size, "of the window, in pixels")->option_text("WxH");
    edit->add_option("--preset", options->preset, "quality of the window's picture (kilolux render --list)")
        ->option_text("NAME");
    edit->add_option("--ui-scale", options->uiScale, "of fonts and spacing; by the screen without it")
        ->check(CLI::Range(0.5, 4.0));
    CLI::Option* list = edit->add_flag("--list", options->list, "list the fields that can be edited");
    edit->add_flag("--json", options->json, "with --list: as JSON")->needs(list);
    return [options] { return runEdit(*options); };
}

ExitCode runWindowCommand(const std::string& scene) {
    EditOptions options;
    options.scene = scene;
    return openWindow(options);
}

} // namespace kilolux
