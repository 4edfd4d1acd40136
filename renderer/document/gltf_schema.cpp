// Checks the JSON against the part of the glTF 2.0 schema that the import uses, from one table per kind of
// object, before any of it is believed. tinygltf reads the document afterwards and does not check ranges
// itself.
#include "renderer/document/gltf_context.h"
#include "renderer/document/gltf_schema_rules.h"

#include <cmath>

namespace kilolux::gltf {

namespace {

// Essential: geometry or the node graph are unusable without, so the import fails. Replaceable: the value is
// removed with a warning, and the object that required it too.
enum class Fault { Essential, Replaceable };

// 5 and 5.0 are the same integer to the schema, but not to a parser that asks for an integer type.
void normalizeInteger(Json& value) {
    if (!value.is_number_float()) return;
    const double number = value.get<double>();
    if (number != std::floor(number) || std::abs(number) > kMaxBytes) return;
    if (number < 0.0) {
        value = static_cast<std::int64_t>(number);
    } else {
        value = static_cast<std::uint64_t>(number);
    }
}

class Checker {
  public:
    explicit Checker(ImportContext& context) : context_(context), root_(context.json) {}

    void checkRoot();

  private:
    std::size_t arraySize(const char* key) const {
        const auto it = root_.find(key);
        return it == root_.end() || !it->is_array() ? 0 : it->size();
    }

    // Empty when the value obeys the rule, else what was expected.
    std::string complaint(const Rule& rule, Json& value) const;
    std::string complaintAboutIndices(const Rule& rule, Json& value) const;

    // False when a required value is missing or wrong (Fault::Replaceable; otherwise it has thrown).
    bool checkObject(Json& object, const std::string& pointer, std::span<const Rule> rules, Fault fault);

    // The objects of a top-level array; entries of the wrong type fail or become empty.
    template<typename Function>
    void forEach(const char* key, Fault fault, Function function);

    // The object's member when it is there and an object; removes one of another type.
    Json* memberObject(Json& object, const char* key, const std::string& pointer, Fault fault);

    void report(const std::string& pointer, const std::string& expected, Fault fault);
    void checkAccessor(Json& accessor, const std::string& pointer);
    void checkMesh(Json& mesh, const std::string& pointer);
    void checkMaterial(Json& material, const std::string& pointer);
    void checkTextureInfo(Json& object, const char* key, const std::string& pointer);
    void checkCamera(Json& camera, const std::string& pointer);
    void checkAnimation(Json& animation, const std::string& pointer);
    bool checkTarget(Json& channel, const std::string& pointer);
    void checkAsset();
    void checkCounts();

    ImportContext& context_;
    Json& root_;
};

void Checker::report(const std::string& pointer, const std::string& expected, Fault fault) {
    if (fault == Fault::Essential) fail(pointer, "expected {}", expected);
    context_.warn(pointer, "expected {}; ignored", expected);
}

std::string Checker::complaintAboutIndices(const Rule& rule, Json& value) const {
    const std::size_t size = arraySize(rule.target);
    if (!value.is_array()) return fmt::format("an array of indices under {}", size);
    std::vector<bool> seen(size, false);
    for (Json& element : value) {
        normalizeInteger(element);
        if (!element.is_number_unsigned() || element.get<std::uint64_t>() >= size) {
            return fmt::format("indices under {}, the number of {}, found {}", size, rule.target,
                               printable(element.dump(-1, ' ', false, Json::error_handler_t::replace)));
        }
        const auto index = element.get<std::size_t>();
        if (seen[index]) return fmt::format("each index once, found {} again", index);
        seen[index] = true;
    }
    return {};
}

std::string Checker::complaint(const Rule& rule, Json& value) const {
    if (rule.kind == Kind::Integer || rule.kind == Kind::Index) normalizeInteger(value);
    // Only scalars are quoted: dumping a large subtree would cost more than it tells.
    const auto found = [&] { return value.is_structured() ? value.type_name() : printable(value.dump()); };
    switch (rule.kind) {
    case Kind::Text:
        return value.is_string() ? "" : "a string, found " + found();
    case Kind::Flag:
        return value.is_boolean() ? "" : "true or false, found " + found();
    case Kind::Number:
        if (value.is_number() && value.get<double>() >= rule.min && value.get<double>() <= rule.max)
            return {};
        if (rule.max >= kMaxNumber)
            return fmt::format("a number of at least {}, found {}", rule.min, found());
        return fmt::format("a number from {} to {}, found {}", rule.min, rule.max, found());
    case Kind::Integer:
        if (value.is_number_integer() && value.get<double>() >= rule.min && value.get<double>() <= rule.max) {
            return {};
        }
        if (rule.max >= kMaxInt) return fmt::format("an integer of at least {}, found {}", rule.min, found());
        return fmt::format("an integer from {} to {}, found {}", rule.min, rule.max, found());
    case Kind::Index: {
        const std::size_t size = arraySize(rule.target);
        if (value.is_number_unsigned() && value.get<std::uint64_t>() < size) return {};
        return fmt::format("an index under {}, the number of {}, found {}", size, rule.target, found());
    }
    case Kind::Numbers: {
        bool good = value.is_array() && value.size() == rule.length;
        for (std::size_t i = 0; good && i < rule.length; ++i) {
            good = value[i].is_number() && value[i].get<double>() >= rule.min &&
                   value[i].get<double>() <= rule.max;
        }
        if (good) return {};
        if (rule.max >= kMaxNumber) return fmt::format("an array of {} finite numbers", rule.length);
        return fmt::format("an array of {} numbers from {} to {}", rule.length, rule.min, rule.max);
    }
    case Kind::UniqueIndices:
        return complaintAboutIndices(rule, value);
    }
    return {};
}

bool Checker::checkObject(Json& object, const std::string& pointer, std::span<const Rule> rules,
                          Fault fault) {
    bool usable = true;
    for (const Rule& rule : rules) {
        const auto it = object.find(rule.key);
        if (it == object.end()) {
            if (rule.need == Need::Required) {
                report(pointer, fmt::format("the property '{}'", rule.key), fault);
                usable = false;
            }
            continue;
        }
        const std::string expected = complaint(rule, *it);
        if (expected.empty()) continue;
        report(pointer + "/" + rule.key, expected, fault);
        object.erase(it);
        usable = usable && rule.need == Need::Optional;
    }
    return usable;
}

template<typename Function>
void Checker::forEach(const char* key, Fault fault, Function function) {
    const auto it = root_.find(key);
    if (it == root_.end()) return;
    for (std::size_t i = 0; i < it->size(); ++i) {
        const std::string pointer = fmt::format("/{}/{}", key, i);
        Json& entry = (*it)[i];
        if (!entry.is_object()) {
            report(pointer, "an object", fault);
            entry = Json::object();
        }
        function(entry, pointer);
    }
}

Json* Checker::memberObject(Json& object, const char* key, const std::string& pointer, Fault fault) {
    const auto it = object.find(key);
    if (it == object.end()) return nullptr;
    if (it->is_object()) return &*it;
    report(pointer + "/" + key, "an object", fault);
    object.erase(it);
    return nullptr;
}

void Checker::checkAccessor(Json& accessor, const std::string& pointer) {
    checkObject(accessor, pointer, kAccessorRules, Fault::Essential);
    if (accessor["componentType"] == 5124)
        fail(pointer + "/componentType", "expected 5120 to 5123, 5125 or 5126");
    static const std::set<std::string> kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    const std::string type = accessor["type"];
    if (!kTypes.contains(type)) {
        // Unknown to this version of glTF and perhaps unused; as a matrix it is refused wherever it is used.
        context_.warn(pointer + "/type", "expected SCALAR, VEC2 to VEC4 or MAT2 to MAT4, found '{}'",
                      printable(type));
        accessor["type"] = "MAT4";
    }
    // Bounds are derived from the data instead of believed.
    accessor.erase("min");
    accessor.erase("max");
    Json* sparse = memberObject(accessor, "sparse", pointer, Fault::Essential);
    if (!sparse) return;
    const std::string sparsePointer = pointer + "/sparse";
    checkObject(*sparse, sparsePointer, kSparseRules, Fault::Essential);
    for (const auto& [key, rules] : {std::pair{"indices", std::span<const Rule>(kSparseIndicesRules)},
                                     std::pair{"values", std::span<const Rule>(kSparseValuesRules)}}) {
        Json* part = memberObject(*sparse, key, sparsePointer, Fault::Essential);
        if (!part) fail(sparsePointer, "expected the property '{}'", key);
        checkObject(*part, sparsePointer + "/" + key, rules, Fault::Essential);
    }
    if ((*sparse)["count"] > accessor["count"]) {
        fail(sparsePointer + "/count", "expected at most the accessor's count");
    }
}

void Checker::checkMesh(Json& mesh, const std::string& pointer) {
    checkObject(mesh, pointer, kNameRules, Fault::Replaceable);
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array()) fail(pointer, "expected an array 'primitives'");
    const Rule attributeRule{"", Kind::Index, Need::Optional, "accessors"};
    for (std::size_t i = 0; i < primitives->size(); ++i) {
        Json& primitive = (*primitives)[i];
        const std::string primitivePointer = fmt::format("{}/primitives/{}", pointer, i);
        if (!primitive.is_object()) fail(primitivePointer, "expected an object");
        checkObject(primitive, primitivePointer, kPrimitiveRules, Fault::Essential);
        if (primitive.contains("targets")) {
            context_.warnOnce("morph targets", primitivePointer,
                              "morph targets are shown in their rest pose");
        }
        Json* attributes = memberObject(primitive, "attributes", primitivePointer, Fault::Essential);
        if (!attributes) fail(primitivePointer, "expected the property 'attributes'");
        for (auto& [name, value] : attributes->items()) {
            const std::string expected = complaint(attributeRule, value);
            if (!expected.empty()) fail(primitivePointer + "/attributes/" + name, "expected {}", expected);
        }
    }
}

void Checker::checkTextureInfo(Json& object, const char* key, const std::string& pointer) {
    Json* info = memberObject(object, key, pointer, Fault::Replaceable);
    if (info && !checkObject(*info, pointer + "/" + key, kTextureInfoRules, Fault::Replaceable))
        object.erase(key);
}

void Checker::checkMaterial(Json& material, const std::string& pointer) {
    checkObject(material, pointer, kMaterialRules, Fault::Replaceable);
    for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"}) {
        checkTextureInfo(material, key, pointer);
    }
    if (Json* pbr = memberObject(material, "pbrMetallicRoughness", pointer, Fault::Replaceable)) {
        const std::string pbrPointer = pointer + "/pbrMetallicRoughness";
        checkObject(*pbr, pbrPointer, kMetallicRoughnessRules, Fault::Replaceable);
        checkTextureInfo(*pbr, "baseColorTexture", pbrPointer);
        checkTextureInfo(*pbr, "metallicRoughnessTexture", pbrPointer);
    }
    const Json mode = material.value("alphaMode", Json("OPAQUE"));
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") {
        report(pointer + "/alphaMode", "OPAQUE, MASK or BLEND", Fault::Replaceable);
        material.erase("alphaMode");
    }
}

void Checker::checkCamera(Json& camera, const std::string& pointer) {
    bool usable = checkObject(camera, pointer, kCameraRules, Fault::Replaceable);
    const std::string type = usable ? camera["type"].get<std::string>() : "";
    if (usable && type != "perspective" && type != "orthographic") {
        report(pointer + "/type", "perspective or orthographic", Fault::Replaceable);
        usable = false;
    }
    if (usable) {
        Json* lens = memberObject(camera, type.c_str(), pointer, Fault::Replaceable);
        if (!lens) report(pointer, fmt::format("the property '{}'", type), Fault::Replaceable);
        const auto rules =
            type == "perspective" ? std::span<const Rule>(kPerspectiveRules) : kOrthographicRules;
        usable = lens && checkObject(*lens, pointer + "/" + type, rules, Fault::Replaceable);
    }
    // A camera is kept at its index, so that the others keep theirs.
    if (!usable) camera = Json{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.01}}}};
}

// Channels and samplers that cannot be used become null, so that the others keep their index.
void Checker::checkAnimation(Json& animation, const std::string& pointer) {
    checkObject(animation, pointer, kNameRules, Fault::Replaceable);
    for (const char* key : {"channels", "samplers"}) {
        const auto it = animation.find(key);
        if (it != animation.end() && it->is_array()) continue;
        report(pointer, fmt::format("an array '{}'", key), Fault::Replaceable);
        animation["channels"] = animation["samplers"] = Json::array();
    }
    for (const auto& [key, rules] : {std::pair{"channels", std::span<const Rule>(kAnimationChannelRules)},
                                     std::pair{"samplers", std::span<const Rule>(kAnimationSamplerRules)}}) {
        Json& entries = animation[key];
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const std::string place = fmt::format("{}/{}/{}", pointer, key, i);
            if (!entries[i].is_object()) report(place, "an object", Fault::Replaceable);
            const bool usable =
                entries[i].is_object() && checkObject(entries[i], place, rules, Fault::Replaceable);
            if (!usable || (key == std::string_view("channels") && !checkTarget(entries[i], place)))
                entries[i] = nullptr;
        }
    }
}

// Of an animation's channel.
bool Checker::checkTarget(Json& channel, const std::string& pointer) {
    if (!channel.contains("target")) report(pointer, "the property 'target'", Fault::Replaceable);
    Json* target = memberObject(channel, "target", pointer, Fault::Replaceable);
    return target && checkObject(*target, pointer + "/target", kAnimationTargetRules, Fault::Replaceable);
}

void Checker::checkAsset() {
    Json* asset = memberObject(root_, "asset", "", Fault::Essential);
    if (!asset) fail("/", "expected the property 'asset', which every glTF 2.0 file has");
    for (const char* key : {"version", "minVersion"}) {
        const auto it = asset->find(key);
        if (it == asset->end() && key == std::string_view("version")) {
            fail("/asset", "expected the property 'version'");
        }
        if (it == asset->end()) continue;
        const std::string version = it->is_string() ? it->get<std::string>() : it->type_name();
        const bool good = key == std::string_view("version") ? version.starts_with("2.") : version == "2.0";
        if (!good) fail(fmt::format("/asset/{}", key), "expected glTF 2.0, found '{}'", printable(version));
    }
}

// Every entry costs its parsed structures, up to about a kilobyte, however short its text.
void Checker::checkCounts() {
    static constexpr const char* kArrays[] = {"accessors", "buffers",   "bufferViews", "cameras",
                                              "images",    "materials", "meshes",      "nodes",
                                              "samplers",  "textures",  "scenes",      "animations"};
    std::uint64_t entries = 0;
    for (const char* key : kArrays) {
        const auto it = root_.find(key);
        if (it == root_.end()) continue;
        if (!it->is_array()) fail(fmt::format("/{}", key), "expected an array");
        // tinygltf keeps three kilobytes per material.
        entries += it->size() * (key == std::string_view("materials") ? 4 : 1);
        if (key != std::string_view("meshes")) continue;
        for (const Json& mesh : *it) {
            const auto primitives = mesh.is_object() ? mesh.find("primitives") : mesh.end();
            if (mesh.is_object() && primitives != mesh.end()) entries += primitives->size();
        }
    }
    const std::uint64_t maxEntries = 50'000 + context_.fileBytes / 100;
    if (entries > maxEntries)
        fail("/", "expected at most {} objects in a file of this size, found {}", maxEntries, entries);
}

void Checker::checkRoot() {
    checkAsset();
    checkCounts();
    const auto rulesFor = [this](std::span<const Rule> rules, Fault fault) {
        return [this, rules, fault](Json& object, const std::string& pointer) {
            checkObject(object, pointer, rules, fault);
        };
    };
    forEach("buffers", Fault::Essential, rulesFor(kBufferRules, Fault::Essential));
    forEach("bufferViews", Fault::Essential, [this](Json& object, const std::string& pointer) {
        checkObject(object, pointer, kBufferViewRules, Fault::Essential);
        if (object.value("byteStride", 4) % 4 != 0) fail(pointer + "/byteStride", "expected a multiple of 4");
    });
    forEach("accessors", Fault::Essential, [this](Json& o, const std::string& p) { checkAccessor(o, p); });
    forEach("meshes", Fault::Essential, [this](Json& o, const std::string& p) { checkMesh(o, p); });
    forEach("nodes", Fault::Essential, [this](Json& object, const std::string& pointer) {
        checkObject(object, pointer, kNodeRules, Fault::Essential);
        checkObject(object, pointer, kNodeReplaceableRules, Fault::Replaceable);
    });
    forEach("scenes", Fault::Essential, rulesFor(kSceneRules, Fault::Essential));
    forEach("images", Fault::Replaceable, rulesFor(kImageRules, Fault::Replaceable));
    forEach("samplers", Fault::Replaceable, rulesFor(kSamplerRules, Fault::Replaceable));
    forEach("textures", Fault::Replaceable, rulesFor(kTextureRules, Fault::Replaceable));
    forEach("materials", Fault::Replaceable, [this](Json& o, const std::string& p) { checkMaterial(o, p); });
    forEach("cameras", Fault::Replaceable, [this](Json& o, const std::string& p) { checkCamera(o, p); });
    forEach("animations", Fault::Replaceable,
            [this](Json& o, const std::string& p) { checkAnimation(o, p); });
    const Rule sceneRule{"scene", Kind::Index, Need::Optional, "scenes"};
    checkObject(root_, "", std::span(&sceneRule, 1), Fault::Essential);
}

} // namespace

void checkSchema(ImportContext& context) {
    Checker(context).checkRoot();
}

} // namespace kilolux::gltf
