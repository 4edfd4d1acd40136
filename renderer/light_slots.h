// Which slot of the light records a light has: the same one for life, however the document sorts, groups,
// mutes or undoes, because lists and samples of earlier frames name lights by slot. A freed slot stays dead
// until nothing can name it any more and then goes to a new light in the next epoch.
#pragma once

#include "renderer/gpu_lights.h"
#include "renderer/settings.h"

#include <cstdint>
#include <map>
#include <vector>

namespace kilolux {

class LightSlots {
  public:
    // Frames that a freed slot stays dead: longer than a visible list remembers (setting listMemory)
    // or an edit lasts (setting editFrames).
    static constexpr std::uint64_t kRestFrames = 32;

    // How long edits are remembered, and how many; from the next update() on, until then by the defaults.
    void setEditMemory(const Settings& settings);

    // Takes over the lights of a frame: `lights` are the records of Scene::lights in order, `ids` their
    // LightNode::id (kDomeLightId for the dome), all different and none 0. The first call marks nothing as
    // edited. A record that differs from the frame before raises its slot's epoch and is edited for
    // some frames (setting editFrames); a range that was derived and still is may differ, as it follows the
    // exposure. Frames count up.
    void update(const GpuLights& lights, const std::vector<std::uint64_t>& ids, std::uint64_t frame);

    // Slot records as the device wants them; dead ones have LIGHT_FLAG_DEAD.
    const std::vector<shared::LightHot>& hot() const { return hot_; }
    const std::vector<shared::LightCold>& cold() const { return cold_; }
    const std::vector<shared::LightShaping>& shapings() const {
        return shapings_;
    } // of living lights, by slot

    // Whether the last update() changed a record in any way, flags included.
    bool changed() const { return changed_; }
    // Whether it changed what the picture converges to.
    bool edited() const { return edited_; }

    // Slots of the local lights edited in the last frames, ascending: at most `freshLights`, the strongest.
    std::vector<std::uint32_t> fresh() const;
    std::vector<std::uint32_t> directional() const; // living ones and the dome, ascending
    std::uint32_t slotOf(std::uint64_t id) const;   // of a living light; 0xffffffff for others

  private:
    struct Slot {
        std::uint64_t id = 0; // 0: dead
        std::uint32_t epoch = 0;
        std::uint64_t diedFrame = 0;
        std::uint64_t editedFrame = 0;
        std::uint64_t firstEditedFrame = 0; // of the edits that follow one another without a rest
        bool wasEdited = false;
        bool rangeDerived = false;
    };
    std::uint32_t take(std::uint64_t id, std::uint64_t frame);
    bool takeShaping(std::uint32_t slot, const GpuLights& lights, std::uint32_t typeFlags);

    std::vector<Slot> slots_;
    std::map<std::uint64_t, std::uint32_t> slotOfId_;
    std::vector<shared::LightHot> hot_; // with flags
    std::vector<shared::LightCold> cold_;
    std::vector<shared::LightHot> plain_; // without flags of this class, to see what an edit changed
    std::map<std::uint32_t, shared::LightShaping> shapingOfSlot_;
    std::vector<shared::LightShaping> shapings_;
    std::uint64_t editFrames_ = std::uint64_t(Settings{}.editFrames);
    std::uint64_t editFirstFrames_ = std::uint64_t(Settings{}.editFirstFrames);
    std::size_t freshLights_ = std::size_t(Settings{}.freshLights);
    bool first_ = true, changed_ = false, edited_ = false;
};

} // namespace kilolux
