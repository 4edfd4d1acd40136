// Reading and writing what is remembered, see settings_store.h.
#include "ui/settings_store.h"

#include "renderer/document/file_replace.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace kilolux {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kMostRecent = 10, kMostLocked = 100'000;

// One list of members for both directions.
template<typename Io>
void visit(Io& io, Remembered& r) {
    io("windowWidth", r.windowWidth, 320, 16384);
    io("windowHeight", r.windowHeight, 240, 16384);
    io("uiScale", r.uiScale, 0.0, 4.0);
    io("leftWidth", r.leftWidth, kLeftWidth.least, kLeftWidth.most);
    io("rightWidth", r.rightWidth, kRightWidth.least, kRightWidth.most);
    io("panels", r.panels.all);
    io("lights", r.panels.lights);
    io("properties", r.panels.properties);
    io("outlines", r.panels.outlines);
    io("gizmos", r.panels.gizmos);
    io("snapAlways", r.snapping.always);
    io("snapMoveM", r.snapping.moveM, 1e-4, 100.0);
    io("snapAngleDeg", r.snapping.angleDeg, 0.01, 180.0);
    io("snapScale", r.snapping.scale, 1e-3, 10.0);
    io("gizmoSizePx", r.gizmoSizePx, kGizmoSizePx.least, kGizmoSizePx.most);
    io("movingFrameMs", r.limits.movingFrameMs, 10.0, 10000.0);
    io("leastScale", r.limits.leastScale, 0.1, 1.0);
    io("meanFrames", r.limits.meanFrames, 1u, 100000u);
    io("sliceMs", r.limits.sliceMs, 0.0, 1000.0);
    io("restMs", r.limits.restMs, 0.0, 10000.0);
    io("mostPixels", r.limits.mostPixels, 0u, 1u << 26);
    io("preset", r.preset);
}

struct Reader {
    const Json& json;

    void operator()(const char* name, bool& value) const {
        const auto found = json.find(name);
        if (found != json.end() && found->is_boolean()) value = found->get<bool>();
    }
    void operator()(const char* name, std::string& value) const {
        const auto found = json.find(name);
        if (found != json.end() && found->is_string()) value = found->get<std::string>();
    }
    template<typename T>
    void operator()(const char* name, T& value, T least, T most) const {
        const auto found = json.find(name);
        if (found == json.end() || !found->is_number()) return;
        const double number = found->get<double>();
        if (std::isfinite(number)) value = T(std::clamp(number, double(least), double(most)));
    }
};

struct Writer {
    Json json = Json::object();

    void operator()(const char* name, bool value) { json[name] = value; }
    void operator()(const char* name, const std::string& value) { json[name] = value; }
    template<typename T>
    void operator()(const char* name, T value, T, T) {
        json[name] = value;
    }
};

std::vector<std::string> textsOf(const Json& json, std::size_t most) {
    std::vector<std::string> texts;
    if (!json.is_array()) return texts;
    for (const Json& text : json)
        if (text.is_string() && texts.size() < most) texts.push_back(text.get<std::string>());
    return texts;
}

} // namespace

fs::path rememberedPath() {
    if (const char* xdg = std::getenv("XDG_CONFIG_HOME"); xdg && *xdg)
        return fs::path(xdg) / "kilolux" / "window.json";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".config" / "kilolux" / "window.json";
    return {};
}

Remembered readRemembered(const fs::path& path) {
    Remembered remembered;
    const Result<std::string> text = readWholeFile(path);
    const Json json = text ? Json::parse(text.value(), nullptr, false) : Json();
    if (!json.is_object()) return remembered;
    Reader reader{json};
    visit(reader, remembered);
    if (const auto recent = json.find("recent"); recent != json.end())
        remembered.recent = textsOf(*recent, kMostRecent);
    const auto locked = json.find("locked");
    if (locked == json.end() || !locked->is_object()) return remembered;
    for (const std::string& scene : remembered.recent)
        if (const auto names = locked->find(scene); names != locked->end())
            remembered.locked[scene] = textsOf(*names, kMostLocked);
    return remembered;
}

std::optional<Error> writeRemembered(const fs::path& path, const Remembered& remembered) {
    if (path.empty()) return std::nullopt;
    std::error_code ignored; // the write tells
    fs::create_directories(path.parent_path(), ignored);
    Writer writer;
    Remembered copy = remembered;
    visit(writer, copy);
    writer.json["recent"] = remembered.recent;
    writer.json["locked"] = Json::object();
    for (const auto& [scene, names] : remembered.locked) {
        const auto& recent = remembered.recent;
        const bool isRecent = std::find(recent.begin(), recent.end(), scene) != recent.end();
        if (isRecent && !names.empty()) writer.json["locked"][scene] = names;
    }
    // Names of files may be no valid UTF-8.
    return replaceFile(path, writer.json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::string rememberedName(const fs::path& scene) {
    std::error_code failed;
    const fs::path absolute = fs::absolute(scene, failed);
    return failed ? scene.string() : absolute.string();
}

void rememberScene(Remembered& remembered, const fs::path& scene) {
    const std::string text = rememberedName(scene);
    std::erase(remembered.recent, text);
    remembered.recent.insert(remembered.recent.begin(), text);
    if (remembered.recent.size() > kMostRecent) remembered.recent.resize(kMostRecent);
}

} // namespace kilolux
