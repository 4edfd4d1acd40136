// Saving over the public corpus: every valid file with one light edited, or added where it has none, opens
// again as it was but for the edit, and nothing unknown changes. The corpus lies beside the project; without
// it the test is skipped.
#include "tests/unit/edits/edits_kit.h"

#include <set>

namespace kilolux {
namespace {

namespace fs = std::filesystem;
using namespace test;

std::string jsonTextOf(const std::string& bytes) {
    if (!bytes.starts_with("glTF")) return bytes;
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    return bytes.substr(20, length);
}

std::string restOf(const std::string& bytes) {
    return bytes.starts_with("glTF") ? bytes.substr(20 + jsonTextOf(bytes).size()) : "";
}

// The pointers at which two documents differ, objects and arrays of one length looked into.
void differences(const Json& a, const Json& b, const std::string& at, std::set<std::string>& found) {
    if (a == b) return;
    const bool lookInto =
        a.is_structured() && a.type() == b.type() && (a.is_object() || a.size() == b.size());
    if (!lookInto) {
        found.insert(at);
        return;
    }
    for (auto it = a.begin(); it != a.end(); ++it) {
        const std::string key = a.is_object() ? it.key() : std::to_string(it - a.begin());
        const Json* other = nullptr;
        if (a.is_array()) other = &b[static_cast<std::size_t>(it - a.begin())];
        if (a.is_object() && b.contains(key)) other = &b[key];
        differences(*it, other ? *other : Json(), at + "/" + key, found);
    }
    for (auto it = b.begin(); b.is_object() && it != b.end(); ++it)
        if (!a.contains(it.key())) found.insert(at + "/" + it.key());
}

void checkFile(const fs::path& file, int& edited, int& added) {
    SCOPED_TRACE(file.string());
    const TempFolder folder;
    fs::copy(file.parent_path(), folder.path() / "scene", fs::copy_options::recursive);
    const fs::path path = folder.path() / "scene" / file.filename();
    SessionOptions options;
    options.import.loadImages = false;
    auto opened = EditSession::open(path, options);
    if (!opened) return; // refused with a reason: Corpus.GltfValid tells which
    EditSession& session = *opened.value();
    const std::string original = readBytes(path);
    ASSERT_FALSE(session.save());
    ASSERT_EQ(readBytes(path), original);
    std::set<std::string> allowed;
    const Scene before = session.scene();
    if (before.lights.empty()) {
        ++added;
        LightDef def;
        def.type = LightType::Rect;
        def.unit = LightUnit::Nit;
        ASSERT_FALSE(session.apply("add", addLight(before, session.ids(), def, Trs{{1, 2, 3}}, "new")));
        allowed = {"/nodes", "/scenes/0/nodes", "/extensions", "/extensionsUsed",
                   "/extensions/EXT_lights_area"};
    } else {
        ++edited;
        const LightNode& light = before.lights[before.lights.size() / 2];
        const LightDef& def = before.lightDefs[light.def];
        auto edits =
            setField(before, EditTarget::Light, light.id, "intensity", def.intensity + 0.5, Sharing::EditAll);
        ASSERT_TRUE(edits) << edits.error();
        ASSERT_FALSE(session.apply("edit", edits.value()));
        allowed = {def.pointer + "/intensity"};
    }
    const auto failed = session.save();
    ASSERT_FALSE(failed) << failed->message;
    const std::string now = readBytes(path);
    EXPECT_EQ(restOf(now), restOf(original));
    std::set<std::string> found;
    differences(Json::parse(jsonTextOf(original)), Json::parse(jsonTextOf(now)), "", found);
    EXPECT_FALSE(found.empty());
    for (const std::string& pointer : found)
        EXPECT_TRUE(allowed.contains(pointer)) << pointer;
    const auto again = importGltf(path, options.import);
    ASSERT_TRUE(again) << again.error();
    const Scene &after = again.value(), &wanted = session.scene();
    ASSERT_EQ(after.lights.size(), wanted.lights.size());
    for (std::size_t i = 0; i < after.lights.size(); ++i) {
        const LightDef &is = after.lightDefs[after.lights[i].def],
                       &was = wanted.lightDefs[wanted.lights[i].def];
        for (const EditField& field : editFields()) {
            if (field.target != EditTarget::Definition) continue;
            EXPECT_TRUE(sameValue(field.get(after, std::uint64_t(&is - after.lightDefs.data())),
                                  field.get(wanted, std::uint64_t(&was - wanted.lightDefs.data()))))
                << field.name << " of light " << i;
        }
        EXPECT_EQ(after.nodes[after.lights[i].node].worldFromNode,
                  wanted.nodes[wanted.lights[i].node].worldFromNode);
    }
    EXPECT_EQ(triangleCount(after), triangleCount(wanted));
    while (session.history().canUndo())
        ASSERT_FALSE(session.undo());
    ASSERT_FALSE(session.save());
    EXPECT_EQ(readBytes(path), original);
}

TEST(SaveCorpus, EveryValidFileDiffersOnlyWhereItWasEdited) {
    const fs::path root = fs::path(KILOLUX_SOURCE_DIR) / "../shared/content/gltf";
    if (!fs::exists(root)) GTEST_SKIP() << "no corpus beside the project";
    int edited = 0, added = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        const std::string ending = entry.path().extension().string();
        if (ending == ".gltf" || ending == ".glb") checkFile(entry.path(), edited, added);
    }
    EXPECT_GT(edited, 0);
    EXPECT_GT(added, 0);
    std::printf("%d files with a light edited, %d with one added\n", edited, added);
}

} // namespace
} // namespace kilolux
