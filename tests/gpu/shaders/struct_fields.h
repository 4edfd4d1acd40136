// The fields of every struct that C++ and shaders share, in order: read by structs.comp and by
// structs_test.cpp, so that both walk a struct by the same names. A field that is missing here shows as a
// wrong count of words.
#ifndef KILOLUX_TEST_STRUCT_FIELDS_H
#define KILOLUX_TEST_STRUCT_FIELDS_H

// clang-format does not settle on one form of these.
// clang-format off
#define FIELDS_LightHot(F) \
    F(positionWs) F(invRange) F(dirWs) F(tangentOct) F(intensity) F(typeFlags) F(sizeM) F(shaping)
#define FIELDS_LightCold(F) F(rayEndBiasM) F(penumbraScale) F(epoch) F(node) F(fluxLm)
#define FIELDS_LightShaping(F) \
    F(doorReachM) F(doorDepthM) F(profile) F(profileIsShape) F(profileCosine) F(profileSide) F(profileSr) \
    F(functionKind) F(functionImage) F(functionPhase) F(functionMap) F(functionOriginWs) \
    F(channels) F(shadowChannels) F(picture) F(pictureMean)
#define FIELDS_FrameConstants(F) \
    F(clipFromWorld) F(originBase) F(originStepX) F(originStepY) F(dirBase) F(dirStepX) F(dirStepY) \
    F(size) F(outputSize) F(tiles) F(tileChunks) F(frame) F(seed) F(lightCount) F(exposure) F(pixelAngleRad) F(zNearM) \
    F(rasterized) F(backgroundNit) F(backgroundTurn) F(fillNit) F(grid) F(steadyClipFromWorld) F(previousClipFromWorld) F(depthRow) F(previousDepthRow) \
    F(previousSize) F(previousTiles) F(exposureRatio) F(historyValid) F(sampling) F(denoising)
#define FIELDS_RayListHead(F) F(groupsX) F(groupsY) F(groupsZ) F(count)
#define FIELDS_SamplingConstants(F) \
    F(rays) F(choices) F(pixelsPerRay) F(guiding) F(areaMasks) F(maskHiddenShare) F(maskSizeTiles) F(maskSamples) \
    F(hiddenShare) F(missHiddenShare) F(hiddenSeenShare) F(hiddenRelaxedBelow) F(directionalShare) \
    F(directionalFreeBelow) F(domeShare) F(cellCandidates) F(missCandidates) F(dimThreshold) F(dimMode) F(listLength) \
    F(listMemory) F(editHistory) F(upsampleDepth) F(upsampleNormal) F(upsampleLeast) F(upsampleReachPx) F(noiseFrame) F(directionalCount) F(freshCount) F(fresh0) F(fresh1)
#define FIELDS_DenoisingConstants(F) \
    F(diffuseFrames) F(specularFrames) F(leastFrames) F(clipWidth) F(clipExtent) F(momentFrames) \
    F(depthTolerance) F(normalTolerance) F(spatialRadiusPx) F(spatialThreshold) F(spatialTaps) F(spatialTapsNew) \
    F(spatialNewFrames) F(spatialDeviations) F(spatialPlanePx) F(spatialNormal) F(antiAliasFrames) F(antiAliasClip) \
    F(antiAliasSureClip) F(antiAliasExtent) F(antiAliasLeastFrames) F(antiAliasMovingFrames) F(antiAliasMomentFrames) \
    F(settleError) F(settleBegin) F(settleFirstFrames) F(settleFullFrames) F(settleFaultBegin) F(settleFaultSure)
#define FIELDS_ResamplingConstants(F) \
    F(candidates) F(reuse) F(mostHistory) F(neighbours) F(radiusPx) F(weights)
#define FIELDS_ShadowMap(F) \
    F(centerWs) F(nearM) F(forwardWs) F(tanHalf) F(axisXWs) F(faceMask) F(axisYWs) F(firstTile) F(sourceXWs) \
    F(tilePx) F(sourceYWs) F(sourceRadiusM) F(source) F(directional) F(shadowChannels) F(endBiasM)
#define FIELDS_LightPower(F) F(keep) F(other) F(probability)
#define FIELDS_LightTreeNode(F) \
    F(leastWs) F(slot) F(mostWs) F(second) F(axisWs) F(intensity) F(cosSpread) F(cosEmission) F(reachM) F(distant)
#define FIELDS_ViewConstants(F) F(low) F(high) F(denoised)
#define FIELDS_ProbeRequest(F) F(renderedPx) F(shownPx) F(stochastic) F(lights)
#define FIELDS_ProbeSurface(F) \
    F(pixel) F(exists) F(hasTurn) F(positionWs) F(depthM) F(normalWs) F(geoNormalWs) F(viewDirWs) F(baseColor) \
    F(roughness) F(metallic) F(instance) F(primitive) F(pictureNit) F(viewValue) F(irradianceLux) F(candidates) \
    F(cellLights) F(stride) F(listLights) F(listTile) F(missed) F(sums) F(budgeted)
#define FIELDS_ProbeLight(F) \
    F(flags) F(list) F(entry) F(cells) F(weight) F(offered) F(probability) F(chosen) F(chosenVisible) F(rays) \
    F(raysVisible) F(irradianceLux) F(reflectedNit)
#define FIELDS_InstanceRows(F) F(row0) F(row1) F(row2)
#define FIELDS_GridConstants(F) \
    F(fineSize) F(coarseSize) F(firstDepthM) F(slicesPerOctave) F(lastDepthM) F(capacity) F(enabled) \
    F(threadLights)
#define FIELDS_GridCell(F) F(first) F(count) F(typeMask)
#define FIELDS_GpuInstance(F) \
    F(row0) F(row1) F(row2) F(firstVertex) F(firstIndex) F(firstUv1) F(material) F(flags) \
    F(triangleCount)
#define FIELDS_GpuTextureRef(F) F(place) F(flags) F(uvRow0) F(uvRow1)
#define FIELDS_GpuMaterial(F) \
    F(baseColor) F(emissive) F(metallic) F(roughness) F(normalScale) F(opacity) F(flags) \
    F(baseColorTexture) F(metallicRoughnessTexture) F(normalTexture) F(emissiveTexture)
#define FIELDS_BvhNode(F) F(box0) F(ref0) F(box1) F(ref1)
#define FIELDS_BvhPair(F) F(a) F(b) F(c) F(d)
#define FIELDS_BvhEntry(F) \
    F(linear0) F(linear1) F(linear2) F(pivotWs) F(pivotLs) F(gridMin) F(gridStep) F(rootRef) \
    F(firstTriangle) F(unused)
#define FIELDS_TraceInstance(F) F(firstTriangle) F(alphaRecordAndChannels)
#define FIELDS_AlphaRecord(F) \
    F(firstTexel) F(width) F(height) F(flags) F(uvRow0) F(factor) F(uvRow1) F(cutoff) F(firstTriangle) \
    F(unused)
#define FIELDS_AlphaTriangle(F) F(uv0) F(uv1) F(uv2) F(alpha8x3) F(unused)
// clang-format on

#endif
