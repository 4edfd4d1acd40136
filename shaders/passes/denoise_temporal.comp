#version 460
// Temporal filter of diffuse and specular light (the MegaLights talk, SIGGRAPH 2025, "Temporal Filter"): history is
// fetched where the surface was, checked against the 5 x 5 neighbourhood, and averaged with the new sample. Writes
// light with the number of frames it holds, and mean and standard deviation of luminance.
//
// One ray per pixel is too noisy to clip the history of a pixel to a box around its neighbours: sparse light would
// be lost, and what differs from its surroundings would be smeared. The neighbourhood is therefore compared with
// its own history: the mean of (sample - history) over the same pixels is noise about 0 as long as light stands
// still, whatever the picture shows there. Only what exceeds that noise moves the history, and never farther than
// clipping to the variance box of the samples (Salvi, "An excursion in temporal supersampling", GDC 2016) would.
//
// A history begins with the mean around it, and its first frames, sampled before lists knew what is visible, count less
// than others: what they found by luck would stand out for as long as it is 1 / n of the sum. For the same reason
// samples of short histories share what stands out with eight neighbours, light for light, and are limited at a
// multiple of that, which darkens them a little; long histories keep every sample as it is.
#include "shared/features.h"
#include "lib/dispatch.glsl"
#include "lib/gbuffer.glsl"
#include "lib/history.glsl"
#include "lib/reprojection.glsl"

layout(constant_id = CHOICE_SPARSE_NEIGHBOURS) const bool kSparseNeighbours = false;

layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2D gSurface;
uniform sampler2D litDiffuse;
uniform sampler2D litSpecular;
uniform usampler2D previousSurface;
uniform sampler2D previousDiffuse;
uniform sampler2D previousSpecular;
uniform sampler2D previousMoments;
layout(rgba16f) writeonly uniform image2D historyDiffuseOut;
layout(rgba16f) writeonly uniform image2D historySpecularOut;
layout(rgba16f) writeonly uniform image2D historyMomentsOut;
layout(rgba16f) writeonly uniform image2D denoiseTraceOut; // for the views; a dummy otherwise

const float kLeastTap = 0.01;       // bilinear weights below are not fetched
const float kFirstFrames = 0.25;    // what the first frame counts; each of the next ones as much as all before, up to 1
const float kDarkest = 1.0e-3;      // of display white: no change is seen below, and dim lights are found rarely
const float kTaps = 25.0;
const float kYoungFrames = 16.0; // histories of fewer share what is above so many times the neighbourhood and more,
const float kOutlier = 4.0, kOutlierPerFrame = 2.0;
const float kMostOutlier = 6.0;  // up to so many times that: the rest is lost
const ivec2 kSharing[4] = ivec2[](ivec2(2, 1), ivec2(-1, 2), ivec2(1, 2), ivec2(2, -1)); // and their opposites
const int kSharers = 8;
const float kOtherSurface = 1.0e-3; // weight of neighbours of a new history that show another surface
const float kMovesPx = 0.1;    // a picture that moves
const float kRoughLobe = 0.6;  // roughness from which on highlights are as wide as shading

struct History {
    vec4 diffuse; // light, frames
    vec4 specular;
    vec4 moments;
    float weight; // 0: none
};

// Whether a texel of the previous frame shows the surface.
bool showsSurface(ivec2 at, Reprojection r, vec3 geoNormalWs, float cosView) {
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(frame.previousSize)))) return false;
    uvec4 there = texelFetch(previousSurface, at, 0);
    if (!sameDepth(surfaceDepthM(there), r.depthM, cosView)) return false;
    return dot(surfaceGeoNormalWs(there), geoNormalWs) >= frame.denoising.normalTolerance;
}

void addTap(inout History h, ivec2 at, float weight, Reprojection r, vec3 geoNormalWs, float cosView) {
    if (!showsSurface(at, r, geoNormalWs, cosView)) return;
    h.diffuse += weight * readHistory(texelFetch(previousDiffuse, at, 0));
    h.specular += weight * readHistory(texelFetch(previousSpecular, at, 0));
    h.moments += weight * readMomentHistory(texelFetch(previousMoments, at, 0));
    h.weight += weight;
}

const int kBilinearTaps = 4;
const int kAllTaps = kBilinearTaps + 9;

vec4 catmullRomWeights(float f) {
    return vec4(f * (-0.5 + f * (1.0 - 0.5 * f)), 1.0 + f * f * (-2.5 + 1.5 * f), f * (0.5 + f * (2.0 - 1.5 * f)),
                f * f * (-0.5 + 0.5 * f));
}

// Draws light by Catmull-Rom where the twelve nearest texels (4 x 4 without corners) show the surface: bilinear drawing,
// frame after frame of a picture that moves, washes shadows out. Held between the four nearest, so that nothing rings.
void sharpen(inout History h, ivec2 corner, vec2 f, Reprojection r, vec3 geoNormalWs, float cosView) {
    vec4 weightsX = catmullRomWeights(f.x), weightsY = catmullRomWeights(f.y);
    vec3 diffuse = vec3(0.0), leastD = vec3(kHalfMax), mostD = vec3(0.0);
    vec3 specular = vec3(0.0), leastS = vec3(kHalfMax), mostS = vec3(0.0);
    float sum = 0.0;
    for (int i = 0; i < 16; ++i) {
        ivec2 place = ivec2(i & 3, i >> 2);
        bvec2 inner = equal(place + 1 >> 1, ivec2(1));
        if (!any(inner)) continue;
        ivec2 at = corner + place - 1;
        if (!all(inner) && !showsSurface(at, r, geoNormalWs, cosView)) return;
        vec3 d = readHistory(texelFetch(previousDiffuse, at, 0)).rgb;
        vec3 s = readHistory(texelFetch(previousSpecular, at, 0)).rgb;
        float weight = weightsX[place.x] * weightsY[place.y];
        sum += weight;
        diffuse += weight * d;
        specular += weight * s;
        if (!all(inner)) continue;
        leastD = min(leastD, d);
        mostD = max(mostD, d);
        leastS = min(leastS, s);
        mostS = max(mostS, s);
    }
    h.diffuse.rgb = clamp(diffuse / sum, leastD, mostD);
    h.specular.rgb = clamp(specular / sum, leastS, mostS);
}

// Bilinear between the four nearest texels that show the same surface. Where none does, its texels among the 3 x 3
// nearest: jitter makes edges hop from frame to frame. One loop that ends as soon as it may, the nearest texel first:
// lanes that are masked out cost as much as others, and of a picture that rests the nearest texel is all there is.
History fetchHistory(Reprojection r, vec3 geoNormalWs, float cosView) {
    History h = History(vec4(0.0), vec4(0.0), vec4(0.0), 0.0);
    if (!r.onScreen) return h;
    vec2 at = r.uv * vec2(frame.previousSize) - 0.5;
    vec2 corner = floor(at);
    vec2 f = at - corner;
    ivec2 nearest = ivec2(floor(at + 0.5));
    int start = (f.x >= 0.5 ? 1 : 0) + (f.y >= 0.5 ? 2 : 0);
    float left = 1.0; // bilinear weight of the taps to come
    for (int i = 0; i < kAllTaps; ++i) {
        ivec2 tap = nearest + ivec2((i - kBilinearTaps) % 3 - 1, (i - kBilinearTaps) / 3 - 1);
        float weight = 1.0;
        if (i < kBilinearTaps) {
            ivec2 offset = ivec2((i ^ start) & 1, (i ^ start) >> 1);
            vec2 w = mix(1.0 - f, f, vec2(offset));
            weight = w.x * w.y;
            left -= weight;
            tap = ivec2(corner) + offset;
        }
        if (weight > kLeastTap) addTap(h, tap, weight, r, geoNormalWs, cosView);
        if (h.weight >= kLeastTap && left <= kLeastTap) break;
    }
    bool whole = h.weight > 1.0 - kLeastTap && left <= kLeastTap; // all four show it
    if (h.weight > 0.0) {
        float scale = 1.0 / h.weight;
        h.diffuse *= scale;
        h.specular *= scale;
        h.moments *= scale;
    }
    vec2 between = min(f, 1.0 - f);
    if (max(between.x, between.y) > kMovesPx && whole) sharpen(h, ivec2(corner), f, r, geoNormalWs, cosView);
    return h;
}

// Sums over the neighbourhood in YCoCg.
struct Sums {
    vec3 light;
    vec3 lightSquare;
    vec3 change; // sample minus history
    vec3 changeSquare;
};

void addNeighbour(inout Sums s, vec3 rgb, vec3 historyRgb, float weight) {
    vec3 light = yCoCgFromRgb(min(rgb, vec3(kHalfMax)));
    vec3 change = light - yCoCgFromRgb(historyRgb);
    s.light += weight * light;
    s.lightSquare += weight * light * light;
    s.change += weight * change;
    s.changeSquare += weight * change * change;
}

struct Neighbours {
    Sums diffuse;
    Sums specular;
    float count;
};

// The neighbours of a pixel with history that have one themselves.
Neighbours gatherNeighbours(ivec2 pixel, ivec2 before, bool hasHistory) {
    Sums none = Sums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    Neighbours n = Neighbours(none, none, 0.0);
    ivec2 size = ivec2(frame.size), previousSize = ivec2(frame.previousSize);
    int tapStep = kSparseNeighbours ? 2 : 1, last = hasHistory ? 2 : -3;
    for (int y = -2; y <= last; y += tapStep) {
        for (int x = -2; x <= 2; x += tapStep) {
            if (kSparseNeighbours && (x == 0) != (y == 0)) continue;
            ivec2 at = pixel + ivec2(x, y), then = before + ivec2(x, y);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
            vec4 diffuse = texelFetch(litDiffuse, at, 0);
            vec3 specular = texelFetch(litSpecular, at, 0).rgb;
            if (diffuse.a <= 0.0 || !isFiniteLight(diffuse.rgb + specular)) continue;
            if (any(lessThan(then, ivec2(0))) || any(greaterThanEqual(then, previousSize))) continue;
            vec4 oldDiffuse = readHistory(texelFetch(previousDiffuse, then, 0));
            vec4 oldSpecular = readHistory(texelFetch(previousSpecular, then, 0));
            if (oldDiffuse.a <= 0.0) continue;
            addNeighbour(n.diffuse, diffuse.rgb, oldDiffuse.rgb, 1.0);
            addNeighbour(n.specular, specular, oldSpecular.rgb, 1.0);
            n.count += 1.0;
        }
    }
    return n;
}

// Whether two pixels of this frame show one surface.
bool sameSurfaceNow(uvec4 there, uvec4 surface, float cosView) {
    float depthM = surfaceDepthM(surface);
    return abs(surfaceDepthM(there) - depthM) * cosView <= frame.denoising.depthTolerance * depthM &&
           dot(surfaceGeoNormalWs(there), surfaceGeoNormalWs(surface)) >= frame.denoising.normalTolerance;
}

// Those of a pixel without history, and above all of its surface: every one where the pixel has no sample or nothing has
// a history, else the few of a diagonal. A loop of its own, which ends at once where no lane needs it.
void gatherFirst(inout Neighbours n, ivec2 pixel, bool hasHistory, bool isSampled, uvec4 surface, float cosView) {
    int tapStep = frame.historyValid == 0u || !isSampled || !kSparseNeighbours ? 1 : 6;
    for (int i = hasHistory ? 25 : 0; i < 25; i += tapStep) {
        ivec2 at = pixel + ivec2(i % 5 - 2, i / 5 - 2);
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(frame.size)))) continue;
        vec4 diffuse = texelFetch(litDiffuse, at, 0);
        vec3 specular = texelFetch(litSpecular, at, 0).rgb;
        if (diffuse.a <= 0.0 || !isFiniteLight(diffuse.rgb + specular)) continue;
        float weight = sameSurfaceNow(texelFetch(gSurface, at, 0), surface, cosView) ? 1.0 : kOtherSurface;
        addNeighbour(n.diffuse, diffuse.rgb, vec3(0.0), weight);
        addNeighbour(n.specular, specular, vec3(0.0), weight);
        n.count += weight;
    }
}

// Of two steps the shorter, if they agree on the side, else none.
vec3 agreedStep(vec3 a, vec3 b) {
    vec3 shorter = sign(a) * min(abs(a), abs(b));
    return mix(vec3(0.0), shorter, greaterThan(a * b, vec3(0.0)));
}

// What samples are held against: the frames of a history, and the light around it.
struct Usual {
    float frames;
    float y;
};

Usual makeUsual(vec4 history, float meanY) {
    return Usual(history.a, max(meanY, luminance(history.rgb)));
}

// The same for both of two pixels.
Usual usualOf(Usual a, Usual b) {
    return Usual(max(a.frames, b.frames), max(a.y, b.y));
}

// Luminance above which a sample is an outlier; grows beyond all bounds towards kYoungFrames.
float outlierY(Usual usual) {
    float y = (kOutlier + kOutlierPerFrame * usual.frames) * usual.y + kDarkest;
    return y / max(1.0 - usual.frames / kYoungFrames, 1.0e-6);
}

vec3 limitedSample(vec3 light, float mostY) {
    float y = luminance(light);
    return y > mostY ? light * (mostY / y) : light;
}

// What of a sample is above the usual.
vec3 excess(vec3 light, Usual usual) {
    float mostY = outlierY(usual);
    return limitedSample(light, kMostOutlier * mostY) - limitedSample(light, mostY);
}

// Samples of a pixel with history, the first frames of which share their outliers with neighbours on the surface. What
// is above the usual of both pixels goes both ways in equal shares, so that no light is lost or leaks from brighter
// places.
void shareOutliers(inout vec3 diffuse, inout vec3 specular, ivec2 pixel, ivec2 before, Usual usualD, Usual usualS,
                   uvec4 surface, float cosView) {
    float ownMostD = outlierY(usualD), ownMostS = outlierY(usualS);
    diffuse = limitedSample(min(diffuse, vec3(kHalfMax)), kMostOutlier * ownMostD);
    specular = limitedSample(min(specular, vec3(kHalfMax)), kMostOutlier * ownMostS);
    float share = 1.0 / float(kSharers + 1);
    vec3 ownD = diffuse, ownS = specular;
    bool isOutlier = luminance(ownD) > ownMostD || luminance(ownS) > ownMostS;
    for (int i = 0; i < kSharers; ++i) {
        ivec2 offset = i < kSharers / 2 ? kSharing[i] : -kSharing[i - kSharers / 2];
        ivec2 at = pixel + offset, then = before + offset;
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(frame.size)))) continue;
        if (any(lessThan(then, ivec2(0))) || any(greaterThanEqual(then, ivec2(frame.previousSize)))) continue;
        vec4 litD = texelFetch(litDiffuse, at, 0);
        vec4 specularThere = texelFetch(litSpecular, at, 0);
        vec3 litS = specularThere.rgb;
        // What is common to both is no less than the own: most pairs end here.
        if (!isOutlier && luminance(litD.rgb) <= ownMostD && luminance(litS) <= ownMostS) continue;
        if (litD.a <= 0.0 || !isFiniteLight(litD.rgb + litS)) continue;
        // A history that edits hold short takes no part, and so must be given nothing.
        if (specularThere.a > 0.0 && specularThere.a < kYoungFrames) continue;
        if (!sameSurfaceNow(texelFetch(gSurface, at, 0), surface, cosView)) continue;
        vec4 oldD = readHistory(texelFetch(previousDiffuse, then, 0));
        if (oldD.a <= 0.0) continue;
        vec4 oldS = readHistory(texelFetch(previousSpecular, then, 0));
        vec4 moments = readMomentHistory(texelFetch(previousMoments, then, 0));
        Usual bothD = usualOf(usualD, makeUsual(oldD, moments.x)), bothS = usualOf(usualS, makeUsual(oldS, moments.z));
        diffuse += share * (excess(min(litD.rgb, vec3(kHalfMax)), bothD) - excess(ownD, bothD));
        specular += share * (excess(min(litS, vec3(kHalfMax)), bothS) - excess(ownS, bothS));
    }
}

struct Filtered {
    vec4 light; // and frames
    vec2 moments;
    float confidence;
};

// `moments`: mean and deviation of luminance up to now. `valid`: alpha of litDiffuse. `mostFrames`: the limit.
Filtered filterSignal(vec3 rgb, float valid, vec4 history, vec2 moments, Sums sums, float count, float mostFrames) {
    Filtered result;
    float scale = 1.0 / max(count, 1.0e-6);
    vec3 mean = sums.light * scale, change = sums.change * scale;
    vec3 spread = sqrt(max(sums.lightSquare * scale - mean * mean, vec3(0.0)));
    vec3 noise = sqrt(max(sums.changeSquare * scale - change * change, vec3(0.0)));
    float frames = history.a, heldFrames = min(frames, frame.denoising.momentFrames);
    vec3 before = yCoCgFromRgb(history.rgb);
    result.confidence = 1.0;
    // Without a sample there is nothing to check or to add: history stays as it is. And where no neighbour had a sample
    // that fits (valid < 1), what is around says nothing of this pixel: history is not rectified.
    if (valid >= 1.0 && frames > 0.0 && count > 1.0) {
        // Light that is found rarely may be absent from a whole neighbourhood: the deviation over time knows.
        vec3 remembered = moments.y * max(abs(before) / max(before.x, 1.0e-6), vec3(0.1, 0.0, 0.0));
        float width = frame.denoising.clipWidth * sqrt(kTaps / count) * sqrt(1.0 + 1.0 / frames);
        vec3 extent = max(width * max(noise, remembered), vec3(kDarkest));
        vec3 byChange = change - clamp(change, -extent, extent);
        vec3 box = width / frame.denoising.clipWidth * max(spread, remembered);
        vec3 byBox = clamp(before, mean - box, mean + box) - before;
        vec3 move = agreedStep(byChange, byBox);
        before += move;
        result.confidence = saturate(1.0 - length(move / max(extent, vec3(frame.denoising.clipExtent))));
    }
    float limit = mix(min(frame.denoising.leastFrames, mostFrames), mostFrames, result.confidence);
    if (valid > 0.0 && frames > 0.0 && isFiniteLight(rgb)) {
        float counts = clamp(frames, kFirstFrames, 1.0);
        frames = min(frames + counts, limit);
        vec3 old = storableLight(rgbFromYCoCg(before));
        float share = counts / max(frames, counts);
        result.light = vec4(mix(old, min(rgb, vec3(kHalfMax)), share), frames);
        // Moments are those of the whole neighbourhood: many times as sure as a pixel's own.
        float deviation = noise.x;
        float momentShare = max(counts / (heldFrames + counts), share);
        float variance = mix(moments.y * moments.y, deviation * deviation, momentShare);
        result.moments = vec2(mix(moments.x, mean.x, momentShare), sqrt(variance));
    } else if (frames > 0.0) {
        result.light = history;
        result.moments = moments;
    } else {
        bool any = count > 0.0;
        result.light = vec4(any ? rgbFromYCoCg(mean) : vec3(0.0), any ? kFirstFrames : 0.0);
        result.moments = vec2(mean.x, noise.x);
    }
    result.light.rgb = storableLight(result.light.rgb);
    result.moments = storableLight(vec3(result.moments, 0.0)).xy;
    return result;
}

void main() {
    uvec2 pixel = streamedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    vec4 diffuse = vec4(0.0), specular = vec4(0.0), moments = vec4(0.0), trace = vec4(0.0);
    uvec4 surface = texelFetch(gSurface, at, 0);
    if (surfaceDepthM(surface) < DEPTH_SKY) {
        Reprojection r = reproject(pixel);
        vec3 geoNormalWs = surfaceGeoNormalWs(surface);
        float cosView = abs(dot(geoNormalWs, normalize(cameraRay(pixel).dir)));
        History h = fetchHistory(r, geoNormalWs, cosView);
        ivec2 before = ivec2(floor(r.uv * vec2(frame.previousSize)));
        vec4 litD = texelFetch(litDiffuse, at, 0), litS = texelFetch(litSpecular, at, 0);
        bool hasHistory = h.weight > 0.0 && h.diffuse.a > 0.0;
        Neighbours n = gatherNeighbours(at, before, hasHistory);
        gatherFirst(n, at, hasHistory, litD.a > 0.0, surface, cosView);
        float most = litS.a > 0.0 ? litS.a : HISTORY_FREE_FRAMES;
        // Highlights do not move with the surface that shows them, the less the smoother it is.
        vec2 movedPx = r.uv * vec2(frame.previousSize) - vec2(pixel) - 0.5;
        float roughness = surfaceRoughnessClass(surface);
        float keeps = dot(movedPx, movedPx) > kMovesPx * kMovesPx ? saturate(roughness / kRoughLobe) : 1.0;
        float mostSpecular = mix(frame.denoising.leastFrames, frame.denoising.specularFrames, keeps);
        float mostDiffuse = min(frame.denoising.diffuseFrames, most);
        mostSpecular = min(mostSpecular, most);
        Usual usualD = makeUsual(h.diffuse, h.moments.x), usualS = makeUsual(h.specular, h.moments.z);
        // A history that may never grow longer would stay dark.
        if (mostDiffuse < kYoungFrames) usualD.frames = kYoungFrames;
        if (mostSpecular < kYoungFrames) usualS.frames = kYoungFrames;
        bool young = hasHistory && litD.a > 0.0 && max(usualD.frames, usualS.frames) < kYoungFrames &&
                     isFiniteLight(litD.rgb + litS.rgb);
        if (young) shareOutliers(litD.rgb, litS.rgb, at, before, usualD, usualS, surface, cosView);
        Filtered d = filterSignal(litD.rgb, litD.a, h.diffuse, h.moments.xy, n.diffuse, n.count, mostDiffuse);
        Filtered s = filterSignal(litS.rgb, litD.a, h.specular, h.moments.zw, n.specular, n.count, mostSpecular);
        diffuse = d.light;
        specular = s.light;
        moments = vec4(d.moments, s.moments);
        trace = vec4(d.confidence, s.confidence, h.weight > 0.0 ? 1.0 : 0.0, litD.a);
        uint seed = pixelSeed(pixel, frame.frame, frame.seed ^ 0xd1ffu);
        diffuse.rgb = roundedToHalf(diffuse.rgb, seed);
        specular.rgb = roundedToHalf(specular.rgb, hashUint(seed));
    }
    imageStore(historyDiffuseOut, at, diffuse);
    imageStore(historySpecularOut, at, specular);
    imageStore(historyMomentsOut, at, moments);
    if (all(lessThan(at, imageSize(denoiseTraceOut)))) imageStore(denoiseTraceOut, at, trace);
}
