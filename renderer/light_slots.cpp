#include "renderer/light_slots.h"

#include "renderer/document/light_units.h"
#include "shaders/shared/sampling.h"

#include <algorithm>
#include <cstring>
#include <set>

namespace kilolux {

using namespace shared;

namespace {

bool isGlobal(std::uint32_t typeFlags) {
    const std::uint32_t type = typeFlags & LIGHT_TYPE_MASK;
    return type == LIGHT_DIRECTIONAL || type == LIGHT_DOME;
}

template<typename T>
bool sameBytes(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

} // namespace

std::uint32_t LightSlots::take(std::uint64_t id, std::uint64_t frame) {
    std::uint32_t slot = 0;
    while (slot < slots_.size() && (slots_[slot].id != 0 || frame < slots_[slot].diedFrame + kRestFrames))
        ++slot;
    if (slot == slots_.size()) {
        slots_.emplace_back();
        hot_.push_back(LightHot{});
        plain_.push_back(LightHot{});
        cold_.push_back(LightCold{});
    }
    slots_[slot].id = id;
    slotOfId_[id] = slot;
    return slot;
}

// Whether the slot's shaping is another one than before. A light function that goes on in time is: without a
// new epoch, what is remembered of the light's visibility gave 3 to 5 % more error (FLIP) under moving
// caustics and a flicker, not less.
bool LightSlots::takeShaping(std::uint32_t slot, const GpuLights& lights, std::uint32_t typeFlags) {
    const std::uint32_t place = typeFlags >> LIGHT_SHAPING_SHIFT;
    const auto before = shapingOfSlot_.find(slot);
    if (place == 0) {
        if (before == shapingOfSlot_.end()) return false;
        shapingOfSlot_.erase(before);
        return true;
    }
    const LightShaping& now = lights.tables.shapings[place - 1];
    const bool same = before != shapingOfSlot_.end() && sameBytes(before->second, now);
    shapingOfSlot_[slot] = now;
    return !same;
}

void LightSlots::setEditMemory(const Settings& settings) {
    editFrames_ = std::uint64_t(settings.editFrames);
    editFirstFrames_ = std::uint64_t(settings.editFirstFrames);
    freshLights_ = std::min<std::size_t>(std::size_t(settings.freshLights), FRESH_LIGHTS);
}

void LightSlots::update(const GpuLights& lights, const std::vector<std::uint64_t>& ids, std::uint64_t frame) {
    changed_ = edited_ = false;
    const auto isFresh = [&](const Slot& slot) {
        return slot.wasEdited && frame < slot.editedFrame + editFrames_;
    };
    const auto markEdited = [&](Slot& slot) {
        if (first_) return;
        ++slot.epoch;
        if (!isFresh(slot)) slot.firstEditedFrame = frame;
        slot.editedFrame = frame;
        slot.wasEdited = edited_ = true;
    };
    const std::set<std::uint64_t> living(ids.begin(), ids.end());
    for (std::uint32_t i = 0; i < slots_.size(); ++i) {
        if (slots_[i].id == 0 || living.contains(slots_[i].id)) continue;
        slotOfId_.erase(slots_[i].id);
        slots_[i].id = 0;
        slots_[i].diedFrame = frame;
        plain_[i] = LightHot{};
        plain_[i].typeFlags = LIGHT_FLAG_DEAD;
        shapingOfSlot_.erase(i);
        markEdited(slots_[i]);
    }
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const auto found = slotOfId_.find(ids[i]);
        const bool isNew = found == slotOfId_.end();
        const std::uint32_t slot = isNew ? take(ids[i], frame) : found->second;
        LightCold cold = lights.cold[i];
        LightHot before = plain_[slot];
        if (slots_[slot].rangeDerived && lights.rangeDerived[i]) before.invRange = lights.hot[i].invRange;
        slots_[slot].rangeDerived = lights.rangeDerived[i] != 0;
        cold.epoch = cold_[slot].epoch;
        LightHot plain = lights.hot[i];
        const bool reshaped = takeShaping(slot, lights, plain.typeFlags);
        plain.typeFlags &= (1u << LIGHT_SHAPING_SHIFT) - 1u; // the place says nothing about the light
        changed_ = changed_ || reshaped;
        if (isNew || reshaped || !sameBytes(before, plain) || cold.rayEndBiasM != cold_[slot].rayEndBiasM ||
            cold.penumbraScale != cold_[slot].penumbraScale) {
            markEdited(slots_[slot]);
        }
        plain_[slot] = plain;
        cold.epoch = slots_[slot].epoch;
        changed_ = changed_ || !sameBytes(cold, cold_[slot]);
        cold_[slot] = cold;
    }
    shapings_.clear();
    for (std::uint32_t i = 0; i < slots_.size(); ++i) {
        LightHot hot = plain_[i];
        if (const auto shaping = shapingOfSlot_.find(i); shaping != shapingOfSlot_.end()) {
            shapings_.push_back(shaping->second);
            hot.typeFlags |= std::uint32_t(shapings_.size()) << LIGHT_SHAPING_SHIFT;
        }
        if (isFresh(slots_[i])) {
            const bool just = frame < slots_[i].firstEditedFrame + editFirstFrames_;
            hot.typeFlags |= LIGHT_FLAG_EDITED | (just ? LIGHT_FLAG_JUST_EDITED : 0u);
        }
        hot.typeFlags |= (slots_[i].epoch & LIGHT_EPOCH_MASK) << LIGHT_EPOCH_SHIFT;
        changed_ = changed_ || !sameBytes(hot, hot_[i]);
        hot_[i] = hot;
    }
    first_ = false;
}

std::vector<std::uint32_t> LightSlots::fresh() const {
    std::vector<std::uint32_t> slots;
    for (std::uint32_t i = 0; i < slots_.size(); ++i) {
        const std::uint32_t flags = hot_[i].typeFlags;
        const bool local = !isGlobal(flags);
        const bool on = (flags & (LIGHT_FLAG_DEAD | LIGHT_FLAG_MUTED)) == 0u;
        if (local && on && (flags & LIGHT_FLAG_EDITED)) slots.push_back(i);
    }
    const auto strength = [&](std::uint32_t slot) { return luminanceOf(glm::dvec3(hot_[slot].intensity)); };
    std::stable_sort(slots.begin(), slots.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return strength(a) > strength(b); });
    slots.resize(std::min(slots.size(), freshLights_));
    std::sort(slots.begin(), slots.end());
    return slots;
}

std::vector<std::uint32_t> LightSlots::directional() const {
    std::vector<std::uint32_t> slots;
    for (std::uint32_t i = 0; i < slots_.size(); ++i) {
        const std::uint32_t flags = hot_[i].typeFlags;
        if (!(flags & LIGHT_FLAG_DEAD) && isGlobal(flags)) slots.push_back(i);
    }
    return slots;
}

std::uint32_t LightSlots::slotOf(std::uint64_t id) const {
    const auto found = slotOfId_.find(id);
    return found == slotOfId_.end() ? 0xffffffffu : found->second;
}

} // namespace kilolux
