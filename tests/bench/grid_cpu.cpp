#include "tests/bench/grid_cpu.h"

#include "renderer/lights_cpp/lights_f32.h"

#include <algorithm>
#include <cmath>

namespace kilolux::test {

using namespace shared;

CpuGridBuilder::CpuGridBuilder(const FrameConstants& frame, const std::vector<float>& depthsM,
                               const std::vector<LightHot>& lights)
    : frame_(frame), hot_(lights) {
    const glm::uvec3 size = frame.grid.fineSize;
    columnDepths_.assign(std::size_t(size.x) * size.y, glm::vec2(DEPTH_SKY, 0.0f));
    for (std::size_t pixel = 0; pixel < depthsM.size(); ++pixel) {
        const std::size_t x = pixel % frame.size.x / GRID_TILE_PX, y = pixel / frame.size.x / GRID_TILE_PX;
        glm::vec2& range = columnDepths_[y * size.x + x];
        range = {std::min(range.x, depthsM[pixel]), std::max(range.y, depthsM[pixel])};
    }
    grid_.cells.resize(std::size_t(size.x) * size.y * size.z);
}

CpuGridBuilder::Cell CpuGridBuilder::cellOf(const glm::uvec3& firstFine, const glm::uvec3& endFine) const {
    const GridConstants& grid = frame_.grid;
    glm::vec2 surfaces(DEPTH_SKY, 0.0f);
    for (std::uint32_t y = firstFine.y; y < endFine.y; ++y) {
        for (std::uint32_t x = firstFine.x; x < endFine.x; ++x) {
            const glm::vec2& column = columnDepths_[y * grid.fineSize.x + x];
            surfaces = {std::min(surfaces.x, column.x), std::max(surfaces.y, column.y)};
        }
    }
    const auto sliceDepth = [&](std::uint32_t slice) {
        if (slice == 0) return 0.0f;
        const float depthM = grid.firstDepthM * std::exp2(float(slice - 1) / grid.slicesPerOctave);
        return slice >= GRID_SLICES ? std::max(depthM, grid.lastDepthM) : depthM;
    };
    const float nearM = std::max(sliceDepth(firstFine.z) * (1.0f - 1e-5f), surfaces.x),
                farM = std::min(sliceDepth(endFine.z) * (1.0f + 1e-5f), surfaces.y);
    Cell cell;
    if (surfaces.x >= DEPTH_SKY || farM < nearM) return cell;
    cell.seen = true;
    const glm::vec2 first(glm::uvec2(firstFine) * GRID_TILE_PX),
        end(glm::min(glm::uvec2(endFine) * GRID_TILE_PX, frame_.size));
    const auto originOf = [&](glm::vec2 px) {
        return frame_.originBase + px.x * frame_.originStepX + px.y * frame_.originStepY;
    };
    const auto dirOf = [&](glm::vec2 px) {
        return frame_.dirBase + px.x * frame_.dirStepX + px.y * frame_.dirStepY;
    };
    const glm::vec2 middle = 0.5f * (first + end);
    cell.forward = glm::normalize(dirOf(middle));
    const glm::vec3 right = frame_.dirStepX + frame_.originStepX;
    cell.right = glm::normalize(right - cell.forward * glm::dot(cell.forward, right));
    cell.down = glm::cross(cell.forward, cell.right);
    glm::vec3 lower(INFINITY), upper(-INFINITY);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec2 px(corner & 1 ? end.x + 0.5f : first.x - 0.5f,
                           corner & 2 ? end.y + 0.5f : first.y - 0.5f);
        const glm::vec3 offset = originOf(px) - originOf(middle) + dirOf(px) * (corner & 4 ? farM : nearM);
        const glm::vec3 p(glm::dot(offset, cell.right), glm::dot(offset, cell.down),
                          glm::dot(offset, cell.forward));
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    const glm::vec3 center = 0.5f * (lower + upper);
    cell.center = originOf(middle) + cell.right * center.x + cell.down * center.y + cell.forward * center.z;
    cell.halfM = 0.5f * (upper - lower) + 1e-5f * std::max(upper.z, 1e-3f) + 1e-6f * glm::length(cell.center);
    return cell;
}

bool CpuGridBuilder::reaches(const Light& light, const Cell& cell) {
    if (light.type == LIGHT_DIRECTIONAL) return true;
    const glm::vec3 to = cell.center - light.center;
    const glm::vec3 outside = glm::max(
        glm::abs(glm::vec3(glm::dot(to, cell.right), glm::dot(to, cell.down), glm::dot(to, cell.forward))) -
            cell.halfM,
        glm::vec3(0.0f));
    if (glm::dot(outside, outside) > light.radius2M2) return false;
    if (light.cosine < -1e-5f) return true;
    const float distanceM = glm::length(to);
    const auto beyond = [&](const glm::vec3& outward) {
        const glm::vec3 along = glm::abs(glm::vec3(
            glm::dot(outward, cell.right), glm::dot(outward, cell.down), glm::dot(outward, cell.forward)));
        return glm::dot(outward, to) > glm::dot(along, cell.halfM) + 1e-5f * distanceM;
    };
    if (beyond(-light.axis)) return false;
    if (light.cosine <= 0.0f) return true;
    const glm::vec3 across = to - light.axis * glm::dot(to, light.axis);
    const float acrossM = glm::length(across);
    const glm::vec3 sideways = acrossM > 0.01f * distanceM ? across / acrossM : glm::vec3(0.0f);
    return !beyond(sideways * light.cosine - light.axis * light.sine);
}

template<typename Slots>
GridCell CpuGridBuilder::fill(const Cell& cell, const Slots& slots, std::size_t count) {
    GridCell result{std::uint32_t(grid_.indices.size()), 0, 0};
    if (!cell.seen) return result;
    grid_.tests += count;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t slot = slots(i);
        if (!lights_[slot].on || !reaches(lights_[slot], cell)) continue;
        grid_.indices.push_back(slot);
        result.typeMask |= 1u << lights_[slot].type;
    }
    result.count = std::uint32_t(grid_.indices.size()) - result.first;
    return result;
}

void CpuGridBuilder::build(Passes passes) {
    grid_.indices.clear();
    grid_.tests = 0;
    lights_.clear();
    for (const LightHot& hot : hot_) {
        const f32::LightBounds bounds = f32::lightBounds(hot);
        const float cosine = bounds.cosHalfAngle - 1e-6f;
        lights_.push_back({bounds.centerWs, bounds.axisWs, bounds.radiusM * bounds.radiusM * 1.00001f, cosine,
                           std::sqrt(std::max(1.0f - cosine * cosine, 0.0f)), hot.typeFlags & LIGHT_TYPE_MASK,
                           bounds.radiusM > 0.0f});
    }
    const glm::uvec3 fine = frame_.grid.fineSize, coarse = frame_.grid.coarseSize;
    for (std::uint32_t i = 0; i < coarse.x * coarse.y * coarse.z; ++i) {
        const glm::uvec3 at(i % coarse.x, i / coarse.x % coarse.y, i / (coarse.x * coarse.y));
        const glm::uvec3 first = at * GRID_COARSE, end = glm::min(first + GRID_COARSE, fine);
        GridCell list{0, std::uint32_t(lights_.size()), 0};
        if (passes == Passes::Two)
            list = fill(
                cellOf(first, end), [](std::size_t n) { return std::uint32_t(n); }, lights_.size());
        for (std::uint32_t z = first.z; z < end.z; ++z) {
            for (std::uint32_t y = first.y; y < end.y; ++y) {
                for (std::uint32_t x = first.x; x < end.x; ++x) {
                    const Cell cell = cellOf({x, y, z}, {x + 1, y + 1, z + 1});
                    const auto slots = [&](std::size_t n) {
                        return passes == Passes::Two ? grid_.indices[list.first + n] : std::uint32_t(n);
                    };
                    grid_.cells[(z * fine.y + y) * fine.x + x] = fill(cell, slots, list.count);
                }
            }
        }
    }
}

} // namespace kilolux::test
