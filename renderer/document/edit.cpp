#include "renderer/document/edit.h"

#include "renderer/document/edit_rules.h"
#include "renderer/document/light_properties.h"
#include "renderer/document/scene_files.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux {

namespace {

bool operator==(const Trs& a, const Trs& b) {
    return a.translation == b.translation && a.rotation == b.rotation && a.scale == b.scale;
}
bool equal(const LightNode& a, const LightNode& b) {
    return a.id == b.id && a.node == b.node && a.def == b.def && a.muted == b.muted && a.group == b.group;
}
// Where a definition stands in the file is no part of what it is: saving may move it.
bool equal(const LightDef& a, const LightDef& b) {
    bool same = a.name == b.name && a.type == b.type && a.intensity == b.intensity && a.unit == b.unit &&
                a.color == b.color && a.innerConeRad == b.innerConeRad && a.outerConeRad == b.outerConeRad;
    forEachLightProperty([&](const auto& each) { same = same && each.access(a) == each.access(b); });
    return same;
}
bool equal(const Node& a, const Node& b) {
    const bool sameRest = a.restTrs && b.restTrs ? *a.restTrs == *b.restTrs : !a.restTrs && !b.restTrs;
    return a.id == b.id && a.name == b.name && a.parent == b.parent && a.localFromNode == b.localFromNode &&
           sameRest && a.mesh == b.mesh && a.meshChannels == b.meshChannels && a.visible == b.visible;
}
bool equal(const LightGroup& a, const LightGroup& b) {
    return a.id == b.id && a.name == b.name && a.intensity == b.intensity && a.exposureEv == b.exposureEv &&
           a.tint == b.tint && a.muted == b.muted;
}
bool equal(const Camera& a, const Camera& b) {
    return a.id == b.id && a.name == b.name && a.orthographic == b.orthographic && a.yfovRad == b.yfovRad &&
           a.aspect == b.aspect && a.znearM == b.znearM && a.zfarM == b.zfarM && a.xmagM == b.xmagM &&
           a.ymagM == b.ymagM && a.worldFromCamera == b.worldFromCamera && a.node == b.node;
}

struct SameValue {
    template<typename T>
    bool operator()(const T& a, const T& b) const {
        return a == b;
    }
    template<typename T>
    bool operator()(const Whole<T>& a, const Whole<T>& b) const {
        return a == b || (a && b && equal(*a, *b));
    }
    template<typename A, typename B>
    bool operator()(const A&, const B&) const {
        return false;
    }
};

template<typename Array>
int findById(const Array& array, std::uint64_t id) {
    const auto at = std::lower_bound(array.begin(), array.end(), id,
                                     [](const auto& each, std::uint64_t wanted) { return each.id < wanted; });
    return at != array.end() && at->id == id ? static_cast<int>(at - array.begin()) : -1;
}

// The object as a value; monostate if there is none.
EditValue wholeOf(const Scene& scene, EditTarget target, std::uint64_t id) {
    if (!targetExists(scene, target, id)) return {};
    switch (target) {
    case EditTarget::Light:
        return std::make_shared<const LightNode>(scene.lights[findLight(scene, id)]);
    case EditTarget::Definition:
        return std::make_shared<const LightDef>(scene.lightDefs[id]);
    case EditTarget::Node:
        return std::make_shared<const Node>(scene.nodes[id]);
    case EditTarget::Group:
        return std::make_shared<const LightGroup>(scene.groups[findGroup(scene, id)]);
    case EditTarget::Bookmark:
        return std::make_shared<const Camera>(scene.bookmarks[findBookmark(scene, id)]);
    case EditTarget::Scene:
        break;
    }
    return {};
}

// Adds or removes an element of an array that is sorted by id.
template<typename T>
bool putById(std::vector<T>& array, std::uint64_t id, const EditValue& after) {
    const auto at = std::lower_bound(array.begin(), array.end(), id,
                                     [](const T& each, std::uint64_t wanted) { return each.id < wanted; });
    if (std::holds_alternative<std::monostate>(after)) {
        array.erase(at);
        return true;
    }
    const Whole<T>* object = std::get_if<Whole<T>>(&after);
    if (!object || !*object || (*object)->id != id) return false;
    array.insert(at, **object);
    return true;
}

// The same at the end of an array whose indices are ids.
template<typename T>
bool putAtEnd(std::vector<T>& array, std::uint64_t index, const EditValue& after) {
    if (std::holds_alternative<std::monostate>(after)) {
        if (index + 1 != array.size()) return false;
        array.pop_back();
        return true;
    }
    const Whole<T>* object = std::get_if<Whole<T>>(&after);
    if (!object || !*object || index != array.size()) return false;
    array.push_back(**object);
    return true;
}

bool putWhole(Scene& scene, const Edit& edit) {
    const bool had = !std::holds_alternative<std::monostate>(edit.before);
    if (had == !std::holds_alternative<std::monostate>(edit.after))
        return false; // neither appears nor disappears
    switch (edit.target) {
    case EditTarget::Light:
        return putById(scene.lights.write(), edit.id, edit.after);
    case EditTarget::Definition:
        if (!putAtEnd(scene.lightDefs.write(), edit.id, edit.after)) return false;
        // From a journal or as text it comes without what its URIs name.
        if (edit.id < scene.lightDefs.size()) loadFiles(scene.files.get(), scene.lightDefs[edit.id]);
        return true;
    case EditTarget::Node:
        return putAtEnd(scene.nodes.write(), edit.id, edit.after);
    case EditTarget::Group:
        return putById(scene.groups.write(), edit.id, edit.after);
    case EditTarget::Bookmark:
        return putById(scene.bookmarks, edit.id, edit.after);
    case EditTarget::Scene:
        break;
    }
    return false;
}

std::string placeOf(const Scene& scene, const Edit& edit) {
    std::string place = describeTarget(scene, edit.target, edit.id);
    if (edit.field) place += std::string(place.empty() ? "" : ", ") + edit.field->name;
    return place;
}

bool movesNodes(const Edit& edit) {
    return edit.target == EditTarget::Node || (edit.field && edit.field->kind == FieldKind::Transform);
}

} // namespace

bool sameValue(const EditValue& a, const EditValue& b) {
    return std::visit(SameValue{}, a, b);
}

int findLight(const Scene& scene, std::uint64_t id) {
    return findById(scene.lights, id);
}
int findGroup(const Scene& scene, std::uint64_t id) {
    return findById(scene.groups, id);
}
int findBookmark(const Scene& scene, std::uint64_t id) {
    return findById(scene.bookmarks, id);
}

bool targetExists(const Scene& scene, EditTarget target, std::uint64_t id) {
    switch (target) {
    case EditTarget::Light: {
        // Between two edits of a change its node may be missing; the rules refuse that at the end.
        const int at = findLight(scene, id);
        return at >= 0 && scene.lights[at].node >= 0 &&
               scene.lights[at].node < static_cast<int>(scene.nodes.size());
    }
    case EditTarget::Definition:
        return id < scene.lightDefs.size();
    case EditTarget::Node:
        return id < scene.nodes.size();
    case EditTarget::Group:
        return findGroup(scene, id) >= 0;
    case EditTarget::Bookmark:
        return findBookmark(scene, id) >= 0;
    case EditTarget::Scene:
        return true;
    }
    return false;
}

std::string describeTarget(const Scene& scene, EditTarget target, std::uint64_t id) {
    const bool exists = targetExists(scene, target, id);
    const auto named = [&](const char* kind, const std::string& name) {
        return name.empty() ? fmt::format("{} {}", kind, id) : fmt::format("{} '{}'", kind, name);
    };
    switch (target) {
    case EditTarget::Light: {
        const int node = exists ? scene.lights[findLight(scene, id)].node : -1;
        const bool hasNode = node >= 0 && node < static_cast<int>(scene.nodes.size());
        return named("light", hasNode ? scene.nodes[node].name : "");
    }
    case EditTarget::Definition:
        // By a light that shows it: definitions have no place of their own in lists.
        for (const LightNode& light : scene.lights)
            if (light.def == static_cast<int>(id)) return describeTarget(scene, EditTarget::Light, light.id);
        return named("light definition", exists ? scene.lightDefs[id].name : "");
    case EditTarget::Node:
        return named("node", exists ? scene.nodes[id].name : "");
    case EditTarget::Group:
        return named("group", exists ? scene.groups[findGroup(scene, id)].name : "");
    case EditTarget::Bookmark:
        return named("bookmark", exists ? scene.bookmarks[findBookmark(scene, id)].name : "");
    case EditTarget::Scene:
        break;
    }
    return "";
}

int userCount(const Scene& scene, int def) {
    return static_cast<int>(std::count_if(scene.lights.begin(), scene.lights.end(),
                                          [&](const LightNode& light) { return light.def == def; }));
}

Edit inverted(Edit edit) {
    std::swap(edit.before, edit.after);
    return edit;
}

std::optional<Error> applyInPlace(Scene& scene, const Edit& edit) {
    if (!edit.field) {
        if (!sameValue(wholeOf(scene, edit.target, edit.id), edit.before) || !putWhole(scene, edit))
            return Error{placeOf(scene, edit) + ": expected the state that the edit was made for"};
        return std::nullopt;
    }
    if (edit.field->isShorthand || edit.field->target != edit.target ||
        !targetExists(scene, edit.target, edit.id))
        return Error{placeOf(scene, edit) + ": expected something that exists"};
    if (std::optional<Error> error = checkValue(*edit.field, edit.after))
        return Error{placeOf(scene, edit) + ": " + error->message};
    // A node stays one that is given by a matrix, or by parts.
    const bool isTransform = edit.field->kind == FieldKind::Transform;
    const bool sameForm = !isTransform || edit.before.index() == edit.after.index();
    if (!sameForm || !sameValue(edit.field->get(scene, edit.id), edit.before))
        return Error{placeOf(scene, edit) + ": expected the value that the edit was made for"};
    edit.field->set(scene, edit.id, edit.after);
    return std::nullopt;
}

std::optional<Error> applyEdits(Scene& scene, std::span<const Edit> edits, Rules rules) {
    Scene changed = scene; // shares every array that is not written
    for (const Edit& edit : edits) {
        if (std::optional<Error> error = applyInPlace(changed, edit)) return error;
    }
    for (const Edit& edit : edits) {
        if (rules == Rules::Skip) break;
        if (std::optional<Error> error = checkTouched(changed, edit)) return error;
    }
    if (std::any_of(edits.begin(), edits.end(), movesNodes)) updateWorldTransforms(changed);
    scene = std::move(changed);
    return std::nullopt;
}

std::optional<Error> revertEdits(Scene& scene, std::span<const Edit> edits) {
    std::vector<Edit> backwards;
    for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
        backwards.push_back(inverted(*edit));
    return applyEdits(scene, backwards);
}

} // namespace kilolux
