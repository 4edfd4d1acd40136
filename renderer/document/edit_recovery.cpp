// A session's journal: what it holds, and how a session goes on from it.
//
// Records are JSON. {"change": ..., "merged": ...} is a change, {"undo": change} and {"redo": change} say
// what undoing and redoing applied. {"state": ...} is written right before the scene's file is replaced: the
// document as saved, with the session's ids, for those who find that file. Changes made while that file was
// written stand before the state; its "behind" counts them, and they are not part of it. A journal is
// continuous: the records from its start fit the file it names, those behind a state and the ones that it
// counts fit the file that the state names.
#include "renderer/document/edit_json.h"
#include "renderer/document/edit_session.h"
#include "renderer/document/file_hash.h"
#include "renderer/document/file_replace.h"
#include "renderer/document/scene_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace kilolux {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

bool isStateOf(const Json& record, std::uint64_t fileHash) {
    const auto state = record.is_object() ? record.find("state") : record.end();
    if (!record.is_object() || state == record.end() || !state->is_object()) return false;
    const auto file = state->find("file");
    std::uint64_t hash = 0;
    return file != state->end() && file->is_string() && parseHash(file->get<std::string>(), hash) &&
           hash == fileHash;
}

bool isChange(const Json& record) {
    return !(record.is_object() && record.contains("state"));
}

// The records that lead from the file of that hash to the last document; nothing where it fits no such file.
std::optional<std::vector<Json>> recordsFrom(const JournalContent& content, std::uint64_t fileHash) {
    std::vector<Json> records, changes;
    std::size_t start = content.baseHash == fileHash ? 0 : SIZE_MAX; // into `changes`
    for (const std::string& text : content.records) {
        Json record = Json::parse(text, nullptr, false);
        if (isStateOf(record, fileHash)) {
            const Json& state = record["state"];
            const auto behind = state.find("behind");
            const std::size_t count =
                behind != state.end() && behind->is_number_unsigned() ? behind->get<std::size_t>() : 0;
            start = changes.size() - std::min(count, changes.size());
            records = {std::move(record)};
        } else if (isChange(record)) {
            // A state of another file was followed by no replacement of it, or by a restored older file.
            changes.push_back(std::move(record));
        }
    }
    if (start == SIZE_MAX) return std::nullopt;
    records.insert(records.end(), std::make_move_iterator(changes.begin() + std::ptrdiff_t(start)),
                   std::make_move_iterator(changes.end()));
    return records;
}

template<typename T>
std::optional<Error> readArray(const Json& state, const char* key, std::vector<T>& target) {
    const auto array = state.find(key);
    if (array == state.end() || !array->is_array()) return Error{std::string(key) + ": expected an array"};
    for (const Json& each : *array) {
        target.emplace_back();
        if (std::optional<Error> error = fromJson(each, target.back())) return error;
    }
    return std::nullopt;
}

template<typename T>
Json arrayJson(const std::vector<T>& objects) {
    Json array = Json::array();
    for (const T& object : objects)
        array.push_back(toJson(object));
    return array;
}

bool isSortedById(const auto& array) {
    return std::is_sorted(array.begin(), array.end(),
                          [](const auto& a, const auto& b) { return a.id < b.id; });
}

// The nodes of a session from those of the saved file; `opened` gets the session's ids, and `sessionIndex`
// tells where each node of the file stands in the session.
std::optional<Error> takeNodes(const Json& state, const Scene& file, Scene& scene, Scene& opened,
                               std::vector<int>& sessionIndex) {
    const auto entries = state.find("nodes");
    if (entries == state.end() || !entries->is_array()) return Error{"nodes: expected an array"};
    sessionIndex.assign(file.nodes.size(), -1);
    std::vector<Node> nodes;
    std::vector<bool> isExact; // stands in the state with every digit, its parent as in the session
    for (const Json& entry : *entries) {
        if (!entry.is_array() || entry.size() != 2 || !entry[0].is_number_integer())
            return Error{"nodes: expected pairs"};
        const auto place = entry[0].get<std::int64_t>();
        const bool inFile = place >= 0 && place < static_cast<std::int64_t>(file.nodes.size());
        Node node;
        if (inFile) node = file.nodes[static_cast<std::size_t>(place)];
        isExact.push_back(entry[1].is_object());
        if (isExact.back() && (inFile || place == -1)) {
            Node exact;
            if (std::optional<Error> error = fromJson(entry[1], exact)) return error;
            if (inFile) exact.mesh = node.mesh, exact.visible = node.visible;
            node = exact;
        } else if (entry[1].is_number_unsigned() && inFile) {
            node.id = entry[1].get<std::uint64_t>();
        } else {
            return Error{"nodes: expected a place in the file with an id or a node"};
        }
        if (inFile) {
            sessionIndex[static_cast<std::size_t>(place)] = static_cast<int>(nodes.size());
            opened.nodes[static_cast<std::size_t>(place)].id = node.id;
        }
        nodes.push_back(std::move(node));
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        int& parent = nodes[i].parent;
        if (!isExact[i] && parent >= 0) parent = sessionIndex[static_cast<std::size_t>(parent)];
        if (parent >= static_cast<int>(nodes.size())) return Error{"nodes: expected a parent that exists"};
    }
    scene.nodes = std::move(nodes);
    return std::nullopt;
}

void putAside(const fs::path& path) {
    std::error_code ignored;
    fs::rename(path, path.string() + ".old", ignored);
}

} // namespace

std::size_t EditSession::recoverableChanges(const fs::path& path, const fs::path& journal) {
    const Result<std::string> bytes = readWholeFile(journal), file = readWholeFile(path);
    if (!bytes || !file) return 0;
    const Result<JournalContent> content = parseJournal(bytes.value());
    if (!content) return 0;
    const auto records = recordsFrom(content.value(), hashBytes(file.value()));
    return records ? static_cast<std::size_t>(std::count_if(records->begin(), records->end(), isChange)) : 0;
}

// Nodes that the file does not have, and those whose lights may be edited, stand here with every digit; of
// the others the place in the file is enough.
Json savedStateJson(const Scene& scene, const Scene& opened, const SavePlan& plan, std::uint64_t fileHash) {
    std::set<std::uint64_t> exact; // ids, which name one node in both scenes
    for (const Scene* each : {&scene, &opened})
        for (const LightNode& light : each->lights.read())
            exact.insert(each->nodes.read()[light.node].id);
    Json nodes = Json::array();
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const int place = plan.nodeIndices[i];
        const Node& node = scene.nodes[i];
        if (place >= 0 && !exact.contains(node.id)) {
            nodes.push_back(Json::array({place, node.id}));
        } else {
            nodes.push_back(Json::array({place, toJson(node)}));
        }
    }
    std::vector<LightDef> defs = scene.lightDefs.read();
    for (std::size_t i = 0; i < defs.size(); ++i)
        defs[i].pointer = plan.defPointers[i];
    Json state = {{"file", hashText(fileHash)},
                  {"nodes", std::move(nodes)},
                  {"defs", arrayJson(defs)},
                  {"lights", arrayJson(scene.lights.read())},
                  {"groups", arrayJson(scene.groups.read())},
                  {"bookmarks", arrayJson(scene.bookmarks)}};
    if (scene.hasExposure) state["exposureEv100"] = scene.exposureEv100;
    return state;
}

// The session's document from the saved file, which has just been imported, and the state that names it.
std::optional<Error> EditSession::takeState(const Json& state) {
    const Scene file = opened_;
    Scene scene = file, opened = file;
    std::vector<int> sessionIndex;
    if (std::optional<Error> error = takeNodes(state, file, scene, opened, sessionIndex)) return error;
    std::vector<LightDef> defs;
    std::vector<LightNode> lights;
    std::vector<LightGroup> groups;
    scene.bookmarks.clear();
    if (std::optional<Error> error = readArray(state, "defs", defs)) return error;
    if (std::optional<Error> error = readArray(state, "lights", lights)) return error;
    if (std::optional<Error> error = readArray(state, "groups", groups)) return error;
    if (std::optional<Error> error = readArray(state, "bookmarks", scene.bookmarks)) return error;
    const bool inRange = std::all_of(lights.begin(), lights.end(), [&](const LightNode& light) {
        return light.node >= 0 && light.node < static_cast<int>(scene.nodes.size()) && light.def >= 0 &&
               light.def < static_cast<int>(defs.size());
    });
    if (!inRange || !isSortedById(lights) || !isSortedById(groups) || !isSortedById(scene.bookmarks))
        return Error{"lights: expected references to what exists, sorted by id"};
    for (LightDef& def : defs)
        loadFiles(scene.files.get(), def);
    scene.lightDefs = std::move(defs);
    scene.lights = std::move(lights);
    scene.groups = groups;
    opened.groups = std::move(groups);
    opened.bookmarks = scene.bookmarks;
    for (LightNode& light : opened.lights) {
        const std::size_t group = light.group; // counted from 1 by the import
        light.group =
            group > 0 && group <= scene.groups.size() ? std::as_const(scene).groups[group - 1].id : 0;
    }
    // Cameras refer to their node by its index.
    for (Camera& camera : scene.cameras)
        if (camera.node >= 0) camera.node = sessionIndex[static_cast<std::size_t>(camera.node)];
    updateWorldTransforms(scene);
    scene_ = std::move(scene);
    opened_ = std::move(opened);
    ids_.avoid(scene_);
    return std::nullopt;
}

std::optional<Error> EditSession::replay(const Json& record) {
    if (!record.is_object() || record.empty()) return Error{"expected a record of a known kind"};
    if (const auto state = record.find("state"); state != record.end()) return takeState(*state);
    for (const char* kind : {"change", "undo", "redo"}) {
        const auto found = record.find(kind);
        if (found == record.end()) continue;
        Change change;
        if (std::optional<Error> error = fromJson(*found, change)) return error;
        for (const Edit& edit : change.edits)
            ids_.avoid(edit);
        ++recoveredChanges_;
        if (kind == std::string_view("undo")) return history_.replayUndo(scene_, std::move(change));
        if (kind == std::string_view("redo")) return history_.replayRedo(scene_, std::move(change));
        const auto merged = record.find("merged");
        const bool merges = merged != record.end() && merged->is_boolean() && merged->get<bool>();
        return history_.apply(scene_, std::move(change), merges ? Merging::Allow : Merging::Never);
    }
    return Error{"expected a record of a known kind"};
}

std::optional<Error> EditSession::recover(const JournalContent& content) {
    const auto records = recordsFrom(content, source_.diskHash);
    if (!records) return Error{"they belong to another version of the file"};
    const Scene scene = scene_, opened = opened_;
    for (std::size_t i = 0; i < records->size(); ++i) {
        if (std::optional<Error> error = replay((*records)[i])) {
            scene_ = scene;
            opened_ = opened;
            history_ = History();
            recoveredChanges_ = 0;
            return Error{fmt::format("record {}: {}", i, error->message)};
        }
    }
    history_.seal();
    return std::nullopt;
}

std::optional<Error> EditSession::openJournal(const fs::path& path, SessionOptions::Recovery recovery) {
    JournalContent content;
    bool usable = false;
    if (const Result<std::string> bytes = readWholeFile(path)) {
        Result<JournalContent> parsed = parseJournal(bytes.value());
        usable = static_cast<bool>(parsed);
        if (usable) content = std::move(parsed.value());
        Result<std::unique_ptr<Journal>> locked =
            usable ? Journal::resume(path, content) : Journal::lock(path);
        if (!locked) return Error{locked.error()};
        std::unique_ptr<Journal> journal = std::move(locked.value());
        if (usable && !content.records.empty() && recovery == SessionOptions::Recovery::TakeUp) {
            if (std::optional<Error> error = recover(content)) {
                warning_ = Error{
                    fmt::format("{}: changes of an earlier session cannot be taken up: {}; they are kept in "
                                "'{}.old'",
                                source_.path.string(), error->message, path.string())};
            } else {
                journal_ = std::make_shared<SessionJournal>(std::move(journal));
                return std::nullopt;
            }
        }
        if (usable && content.records.empty() && content.baseHash == source_.diskHash) {
            journal_ = std::make_shared<SessionJournal>(std::move(journal));
            return std::nullopt;
        }
        if (!usable || !content.records.empty()) putAside(path);
    }
    Result<std::unique_ptr<Journal>> created = Journal::create(path, source_.diskHash);
    if (!created) return Error{created.error()};
    journal_ = std::make_shared<SessionJournal>(std::move(created.value()));
    return std::nullopt;
}

} // namespace kilolux
