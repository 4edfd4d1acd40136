// Makes the edits of what a user does, against the document as it stands. Nothing here changes the document:
// the edits are applied by applyEdits(), or by a session with its history.
#pragma once

#include "renderer/document/edit.h"

namespace kilolux {

using Edits = std::vector<Edit>;

// Hands out ids that nothing in a session has had.
class EditIds {
  public:
    EditIds() = default;
    explicit EditIds(const Scene& scene) { avoid(scene); }
    std::uint64_t next() { return next_++; }
    // Ids below are taken from now on, and those that the scene holds.
    void avoid(const Scene& scene);
    void avoid(const Edit& edit);

  private:
    std::uint64_t next_ = 1;
};

// Whether an edit of a shared definition makes this light's own first, or changes all that share it.
enum class Sharing { MakeUnique, EditAll };

// Sets one field, and what must follow it: a type takes over the intensity in a unit that suits it, a tube
// has a radius, an inner cone stays within the outer one. Fields of a definition are named with the light
// that shows it; `sharing` decides about the others. Nothing to do gives no edits.
Result<Edits> setField(const Scene& scene, EditTarget target, std::uint64_t id, const EditField& field,
                       EditValue value, Sharing sharing = Sharing::MakeUnique);
// By name; for a light the fields of its definition are found as well.
Result<Edits> setField(const Scene& scene, EditTarget target, std::uint64_t id, std::string_view field,
                       EditValue value, Sharing sharing = Sharing::MakeUnique);

// The field of that name on a light, its definition included; null: there is none.
const EditField* findLightField(std::string_view name);

// A new light of its own node, below `parent` (a node's index, -1: the root). What is made is told by the
// last edit's id.
Edits addLight(const Scene& scene, EditIds& ids, const LightDef& def, const Trs& transform, std::string name,
               int parent = -1);

// A light at the same place below the same parent that shares the definition of `light`.
Edits duplicateLight(const Scene& scene, EditIds& ids, std::uint64_t light);

// Takes the light off its node. The node stays, as other parts of the file may refer to it; one that the tool
// made is left out when saving.
Edits deleteLight(const Scene& scene, std::uint64_t light);

// Gives the light a copy of its definition; no edits where it has its own.
Edits makeUnique(const Scene& scene, std::uint64_t light);

Edits addGroup(EditIds& ids, LightGroup group);
Edits deleteGroup(const Scene& scene, std::uint64_t group); // its members stay, without a group
Edits addBookmark(EditIds& ids, Camera camera);
Edits deleteBookmark(const Scene& scene, std::uint64_t bookmark);

} // namespace kilolux
