// The images that a frame writes, allocated once at the largest size; a frame renders into the sub-rectangle
// FrameConstants::size of them.
#pragma once

#include "renderer/gpu/resource.h"

#include <functional>
#include <string_view>
#include <vector>

namespace kilolux {

// Which images a plan needs.
struct TargetNeeds {
    bool raster = false;           // the raster producer
    bool debugView = false;        // a view other than the picture
    bool history = false;          // something is looked up in the previous frame
    std::uint32_t rays = 0;        // samples per pixel of the stochastic method; 0: another method
    std::uint32_t halfChoices = 0; // samples per half-resolution pixel; 0: full resolution
    bool reservoirs = false;       // of a method that resamples; its samples are in them
    bool denoised = false;
    bool denoiseTrace = false; // a view shows what the denoiser did
    bool antiAliased = false;
    bool mean = false;     // the running mean of the frames
    bool rawColor = false; // the mean is of other pictures than the one that is filtered
    bool counted = false;  // it counts samples per pixel
    bool settled = false;  // both are blended
};

// An image under the name that it has now: current and previous ones change places.
struct NamedTarget {
    std::string_view name;
    const gpu::Image* image;
};

struct Targets {
    Targets(gpu::Device& device, std::uint32_t widthPx, std::uint32_t heightPx, const TargetNeeds& needs);

    gpu::Image visibility;      // RG32UI: instance, primitive; 0xffffffff twice without a surface
    gpu::Image rasterDepth;     // D32, reversed; only with the raster producer
    gpu::Image gDepth;          // R32F: linear depth, metres
    gpu::Image gSurface;        // RGBA32UI, see shaders/lib/gbuffer.glsl
    gpu::Image gMaterial;       // R8
    gpu::Image gEmissive;       // RGBA16F, exposed
    gpu::Image pyramid;         // RG32F, mips: nearest and farthest linear depth of 2 x 2, 4 x 4, ... pixels
    gpu::Image litDiffuse;      // RGBA32F, exposed, demodulated by the diffuse albedo
    gpu::Image litSpecular;     // RGBA32F, exposed; of the stochastic method without the environment BRDF
    gpu::Image motion;          // RGBA16F: see shaders/lib/reprojection.glsl; only with history
    gpu::Image previousSurface; // gSurface of the frame before
    gpu::Image samples;         // RGBA32UI, a layer per ray: see shaders/shared/sampling.h
    gpu::Image samplesHalf;     // the same at half resolution, a layer per choice
    gpu::Image rayResults;      // R32UI, a layer per ray
    gpu::Image newReservoirs;   // RGBA32UI, before neighbours share theirs: see shaders/shared/resampling.h
    gpu::Image reservoirs;      // the same after that
    gpu::Image previousReservoirs;
    gpu::Image historyDiffuse;  // RGBA16F: exposed light like litDiffuse, and the frames that it holds
    gpu::Image historySpecular; // the same of litSpecular
    gpu::Image historyMoments;  // RGBA16F: mean and deviation of luminance, diffuse and specular
    gpu::Image previousDiffuse, previousSpecular, previousMoments;
    gpu::Image denoiseTrace;    // RGBA16F, for views: see shaders/passes/denoise_temporal.comp
    gpu::Image denoisedDiffuse; // RGBA16F: as historyDiffuse, filtered in space
    gpu::Image denoisedSpecular;
    gpu::Image lightCounts;  // R32UI: lights in range, lights seen << 16
    gpu::Image sceneColor;   // RGBA32F, exposed: this frame's picture, denoised where the plan says so
    gpu::Image rawColor;     // RGBA32F, exposed: the same of light as it was sampled
    gpu::Image meanColor;    // RGBA32F, exposed: mean of the frames as sampled, and how many
    gpu::Image meanMoments;  // RG32F: mean and variance of their luminance
    gpu::Image antiAliased;  // RGBA16F, exposed, and the frames that it holds
    gpu::Image pixelMoments; // RGBA16F: mean and deviation of a still pixel of what anti-aliasing gets, and
                             // the frames
    gpu::Image previousAntiAliased, previousPixelMoments;
    gpu::Image viewportColor; // RGBA16F, exposed, and the mean's share in it
    gpu::Image viewValues;    // RGBA32F: raw values of a debug view; only with one
    gpu::Image display;       // RGBA8, sRGB-encoded

    // Makes what a view needs beside the rest, where it is not there yet.
    void addForView(gpu::Device& device, const TargetNeeds& needs);

    // What this frame wrote becomes what the next one finds as previous.
    void turnHistory();
    // The same of what the filters keep, which may be frozen by itself.
    void turnFilteredHistory();

    std::vector<NamedTarget> all() const; // those that exist

  private:
    using Make = std::function<gpu::Image(const char* name, VkFormat format, VkImageUsageFlags more)>;
    void makeFiltered(const Make& make, const TargetNeeds& needs);
};

} // namespace kilolux
