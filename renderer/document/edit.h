// Edits: the one way in which a document changes. An edit names what it changes by ids that last, and holds
// the value before and after, so that it can be undone, written to the journal and replayed. A change is what
// the user did in one go: several edits with one name.
#pragma once

#include "renderer/document/result.h"
#include "renderer/document/scene.h"

#include <optional>
#include <span>
#include <variant>

namespace kilolux {

// What an edit's id means: the LightNode::id, the index in Scene::lightDefs or Scene::nodes (which only grow
// and shrink at their end), LightGroup::id, Camera::id of a bookmark, nothing.
enum class EditTarget : std::uint8_t { Light, Definition, Node, Group, Bookmark, Scene };

// monostate: an optional number that is absent, or an object that does not exist. Whole objects are shared
// with the history.
template<typename T>
using Whole = std::shared_ptr<const T>;
using EditValue = std::variant<std::monostate, bool, double, std::string, glm::dvec3, Trs, glm::dmat4,
                               LightType, LightUnit, std::uint64_t, Whole<LightNode>, Whole<LightDef>,
                               Whole<Node>, Whole<LightGroup>, Whole<Camera>>;

bool sameValue(const EditValue& a, const EditValue& b);

enum class FieldKind : std::uint8_t {
    Number,
    OptionalNumber,
    Flag,
    Text,
    Color,     // three numbers from 0 up
    Type,      // a word of kLightTypeWords
    Unit,      // a word of kLightUnitWords
    Word,      // one of EditField::words
    Profile,   // URI of a photometric profile; empty: none
    Picture,   // URI of an image; empty: none
    Channels,  // bits 0 to 7
    Transform, // Trs; a dmat4 where the file gives the node's matrix
    Frame,     // dmat4 without scale
    GroupId,   // LightGroup::id; 0 is none
    DefIndex,
};

// One row of the table of everything that can be edited: what the command line names, panels show and edits
// refer to.
struct EditField {
    EditTarget target;
    const char* name;
    FieldKind kind;
    double min = 0.0; // of numbers, both bounds included
    double max = 0.0;
    const char* unit = "";
    const char* help = "";
    EditValue (*get)(const Scene&, std::uint64_t id) = nullptr; // the object exists
    void (*set)(Scene&, std::uint64_t id, const EditValue&) = nullptr;
    std::span<const char* const> words = {}; // of a Word
    // Stands for several other fields and sets them all; reads as the first of them. An edit is of those.
    bool isShorthand = false;
};
std::span<const EditField> editFields();
const EditField* findEditField(EditTarget target, std::string_view name); // null: there is none

struct Edit {
    EditTarget target = EditTarget::Light;
    std::uint64_t id = 0;
    const EditField* field = nullptr; // null: the whole object, which appears or disappears
    EditValue before, after;
};

struct Change {
    std::string name;     // what the user reads behind 'Undo'
    std::string mergeKey; // changes with one key that follow each other are one step of a drag; empty: never
    std::vector<Edit> edits;
};

Edit inverted(Edit edit);

// Puts the edits into effect one after the other, or none of them: when a value before is not what the
// document holds, a target does not exist, or the result breaks a rule (edit_rules.h).
// Rules may be left out between the steps of building one change.
enum class Rules { Check, Skip };
std::optional<Error> applyEdits(Scene& scene, std::span<const Edit> edits, Rules rules = Rules::Check);

// One edit without the rules and without a copy: for building a change step by step on a document that is
// thrown away. World transforms stay as they are.
std::optional<Error> applyInPlace(Scene& scratch, const Edit& edit);

// applyEdits() backwards with each edit inverted.
std::optional<Error> revertEdits(Scene& scene, std::span<const Edit> edits);

// --- looking things up ---

// Positions in the arrays, which are sorted by id; -1 if there is none.
int findLight(const Scene& scene, std::uint64_t id);
int findGroup(const Scene& scene, std::uint64_t id);
int findBookmark(const Scene& scene, std::uint64_t id);

bool targetExists(const Scene& scene, EditTarget target, std::uint64_t id);

// "light 'Lamp'", "group 'Key'", for messages.
std::string describeTarget(const Scene& scene, EditTarget target, std::uint64_t id);

// How many lights share a definition.
int userCount(const Scene& scene, int def);

} // namespace kilolux
