// Which cells of a light's unit square a pixel's rays should go to, by what its tile saw of the light (the MegaLights
// talk, SIGGRAPH 2025, "Area Light Guiding"). Lists are those of lib/light_choice.glsl.
#ifndef KILOLUX_LIB_LIGHT_MASK_GLSL
#define KILOLUX_LIB_LIGHT_MASK_GLSL
#include "light_choice.glsl"
#include "../math/area_mask.glsl"

// Place of a slot on the list that begins at a texel, whose entries are sorted; LIST_CAPACITY if it is not there.
uint placeOfSlot(uint first, uint slot) {
    uint low = 0u, count = min(texelFetch(visibleLists, int(first)).x, LIST_CAPACITY), high = count;
    while (low < high) {
        uint middle = (low + high) / 2u;
        bool before = (texelFetch(visibleLists, int(first + 1u + middle)).x & ENTRY_SLOT_MASK) < slot;
        low = before ? middle + 1u : low;
        high = before ? high : middle;
    }
    bool found = low < count && (texelFetch(visibleLists, int(first + 1u + low)).x & ENTRY_SLOT_MASK) == slot;
    return found ? low : LIST_CAPACITY;
}

// A mask for areaMaskWarp, 0 where nothing is known that is to be trusted. It is that of the pixel's own tile, whatever
// tile's list the light was chosen from: a lit pixel that takes a neighbour's, in half shadow, has much of its light by
// the few rays to what that one does not see (squared error in `cornell` 1.08 of that without masks; by its own tile's
// 0.96). A light that is small beside the tile is seen whole or not at all by most pixels, so that a mask can only err:
// it has none. A large one has 4 x 4 cells, a tube 4 columns along it. A cell without a sample counts as hidden only
// where there were enough samples, from two windows of frames.
uint areaMaskOf(uint list, uint slot, LightHot light, Receiver receiver) {
    SamplingConstants how = frame.sampling;
    if (how.areaMasks == 0u) return 0u;
    LightExtent extent = lightExtent(light, receiver.point.positionWs);
    float tileM = float(LIST_TILE_PX) * receiver.depthM * max(frame.pixelAngleRad, 1.0e-5);
    float tiles = 2.0 * max(extent.halfLengthM, extent.halfWidthM) / tileM;
    if (tiles < how.maskSizeTiles || lightIsCut(light, receiver.point)) return 0u;
    uint place = placeOfSlot(list, slot);
    if (place == LIST_CAPACITY) return 0u;
    VisibleEntry entry = unpackEntry(texelFetch(visibleLists, int(list + 1u + place)).x);
    if (entry.epoch != (light.typeFlags >> LIGHT_EPOCH_SHIFT & LIGHT_EPOCH_MASK)) return 0u;
    uvec2 seen = texelFetch(visibleLists, int(list + LIST_CELLS_AT + place)).xy;
    uvec2 recent = seen & SEEN_MASK, older = seen >> SEEN_OLDER_SHIFT;
    float samples = float(recent.y + older.y);
    if (older.x == 0u || samples < 4.0 * how.maskSamples) return 0u;
    uint mask = recent.x | older.x;
    if (kTubeLights && lightType(light) == LIGHT_TUBE) return areaMaskColumns(mask);
    bool fine = tiles >= 2.0 * how.maskSizeTiles && samples >= 16.0 * how.maskSamples;
    return fine ? mask : areaMaskQuarters(mask);
}

#endif
