// The light grid against a reference on the CPU in double precision: every light that reaches a pixel's
// surface is on the list of the pixel's cell, for random lights, cameras and depths. Over-inclusion is
// printed.
#include "tests/gpu/support/gpu_fixture.h"
#include "tests/gpu/support/grid_rig.h"

#include "renderer/gpu_lights.h"
#include "renderer/lights_cpp/lights_f64.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <set>

namespace kilolux::test {
namespace {

constexpr double kExposureEv100 = 10.0;

// A light as the reference sees it. It reaches a point when it is on and the point lies within its range, and
// in its cone or on its side, and its barn doors leave some of it to be seen. Needs its tables bound.
struct ReferenceLight {
    explicit ReferenceLight(const shared::LightHot& hot) : light(f64::fromF32(hot)) {
        bounds = f64::lightBounds(light);
        on = f64::lightIsOn(light);
        type = light.typeFlags & shared::LIGHT_TYPE_MASK;
    }
    bool reaches(const glm::dvec3& point) const {
        if (!on || type == shared::LIGHT_DIRECTIONAL) return on;
        const glm::dvec3 to = point - bounds.centerWs;
        const double distance2 = glm::dot(to, to);
        const bool within = distance2 * light.invRange * light.invRange < 1.0 &&
                            glm::dot(to, bounds.axisWs) >= bounds.cosHalfAngle * std::sqrt(distance2);
        const bool shaped = light.typeFlags >> shared::LIGHT_SHAPING_SHIFT != 0;
        return within && (!shaped || f64::luminance(f64::lightEvaluate(light, point)) > 0.0);
    }

    f64::LightHot light;
    f64::LightBounds bounds;
    bool on = false;
    std::uint32_t type = 0;
};

enum class Depths {
    Scattered, // any depth in any pixel, so that the pyramid hides nothing
    Shapes,    // slanted walls before each other and the sky
    Borders    // a wall per column of cells, on the border of two slices to the last digits
};

struct Random {
    std::mt19937 engine;
    double within(double low, double high) {
        return low + (high - low) * std::uniform_real_distribution<double>(0.0, 1.0)(engine);
    }
    double octaves(double low, double high) { return std::exp(within(std::log(low), std::log(high))); }
    glm::dvec3 inCube(double halfM) {
        return {within(-halfM, halfM), within(-halfM, halfM), within(-halfM, halfM)};
    }
};

std::vector<float> makeDepths(const shared::FrameConstants& frame, Depths kind, Random& random) {
    const double firstM = frame.grid.firstDepthM,
                 lastM = firstM * std::exp2((shared::GRID_SLICES - 2) / frame.grid.slicesPerOctave);
    const int width = int(frame.size.x), height = int(frame.size.y);
    std::vector<float> depths(std::size_t(width) * std::size_t(height), shared::DEPTH_SKY);
    if (kind == Depths::Scattered) {
        for (float& depth : depths)
            depth = float(random.octaves(0.3 * firstM, 2.0 * lastM));
        return depths;
    }
    const bool shapes = kind == Depths::Shapes;
    const int side = int(shared::GRID_TILE_PX),
              walls = shapes ? 5 : ((width - 1) / side + 1) * ((height - 1) / side + 1);
    for (int wall = 0; wall < walls; ++wall) {
        const int column = wall % ((width - 1) / side + 1), row = wall / ((width - 1) / side + 1);
        const double x0 = shapes ? random.within(-0.2, 0.7) * width : column * side,
                     y0 = shapes ? random.within(-0.2, 0.7) * height : row * side;
        const double x1 = shapes ? x0 + random.within(0.1, 0.8) * width : x0 + side,
                     y1 = shapes ? y0 + random.within(0.1, 0.8) * height : y0 + side;
        const double border = firstM * std::exp2(int(random.within(0, shared::GRID_SLICES - 1)) /
                                                 double(frame.grid.slicesPerOctave));
        const double depthM = shapes ? random.octaves(0.5 * firstM, lastM)
                                     : border * (1.0 + int(random.within(-4.0, 5.0)) * 6.0e-8);
        const double slantX = shapes ? random.within(-0.45, 0.45) : 0.0,
                     slantY = shapes ? random.within(-0.45, 0.45) : 0.0;
        for (int y = std::max(0, int(y0)); y < std::min(double(height), y1); ++y) {
            for (int x = std::max(0, int(x0)); x < std::min(double(width), x1); ++x) {
                float& depth = depths[std::size_t(y * width + x)];
                depth = std::min(depth, float(depthM * (1.0 + slantX * (x - x0) / (x1 - x0) +
                                                        slantY * (y - y0) / (y1 - y0))));
            }
        }
    }
    return depths;
}

// What all frames came to.
struct Tally {
    std::array<std::size_t, 6> reached{}; // by type: list entries whose light reaches a pixel of the cell
    std::array<std::size_t, 6> listed{};  // by type: entries of cells with pixels
    std::size_t possible = 0;             // lights that are on times cells with pixels
    std::size_t skipped = 0;              // cells that the pyramid hides
    std::size_t frames = 0, lights = 0;
};

class GridListsTest : public GpuTest {
  protected:
    GridListsTest()
        : passes_(resources()),
          cellPass_(resources(), "grid_cells", {{"Frame"}, {"gDepth"}, {"PixelCells", gpu::Access::Write}},
                    "../tests/gpu/grid_cells.comp") {}

    std::vector<std::uint32_t> cellsOfPixels(const GridRig& rig) {
        const std::uint32_t pixels = rig.constants().size.x * rig.constants().size.y;
        const gpu::Buffer cells(device(), {"pixelCells", pixels * 4});
        gpu::Commands commands(device());
        cellPass_.record(
            commands, {},
            {{"Frame", rig.frameBuffer()}, {"gDepth", rig.targets().gDepth}, {"PixelCells", cells}},
            {(pixels + 63) / 64});
        commands.submitAndWait();
        return cells.downloadAs<std::uint32_t>();
    }

    // Holds the lists to the reference and counts.
    void check(const GridRig& rig, const GridLists& lists, const std::vector<float>& depths,
               const std::vector<ReferenceLight>& lights, Tally& tally);

    GridPasses passes_;
    gpu::ComputePass cellPass_;
};

glm::dvec3 surfaceOf(const shared::FrameConstants& frame, std::uint32_t pixel, float depthM) {
    const glm::dvec2 px = glm::dvec2(pixel % frame.size.x, pixel / frame.size.x) + 0.5;
    const auto along = [&](const glm::vec3& base, const glm::vec3& stepX, const glm::vec3& stepY) {
        return glm::dvec3(base) + px.x * glm::dvec3(stepX) + px.y * glm::dvec3(stepY);
    };
    return along(frame.originBase, frame.originStepX, frame.originStepY) +
           double(depthM) * along(frame.dirBase, frame.dirStepX, frame.dirStepY);
}

void GridListsTest::check(const GridRig& rig, const GridLists& lists, const std::vector<float>& depths,
                          const std::vector<ReferenceLight>& lights, Tally& tally) {
    const std::vector<std::uint32_t> cellOfPixel = cellsOfPixels(rig);
    const glm::uvec3 size = rig.constants().grid.fineSize;
    std::vector<std::vector<glm::dvec3>> points(size.x * size.y * size.z);
    for (std::uint32_t pixel = 0; pixel < depths.size(); ++pixel) {
        ASSERT_LT(cellOfPixel[pixel], points.size());
        if (depths[pixel] < shared::DEPTH_SKY)
            points[cellOfPixel[pixel]].push_back(surfaceOf(rig.constants(), pixel, depths[pixel]));
    }
    std::size_t missing = 0;
    for (std::size_t cell = 0; cell < points.size(); ++cell) {
        ASSERT_LE(lists.cells[cell].first + lists.cells[cell].count, lists.indices.size());
        const std::span<const std::uint32_t> list = lists.of(cell);
        std::uint32_t types = 0;
        for (std::size_t i = 0; i < list.size(); ++i) {
            ASSERT_LT(list[i], lights.size());
            ASSERT_TRUE(i == 0 || list[i - 1] < list[i]) << "sorted by slot, each once";
            ASSERT_TRUE(lights[list[i]].on) << "muted";
            types |= 1u << lights[list[i]].type;
        }
        ASSERT_EQ(lists.cells[cell].typeMask, types);
        if (points[cell].empty()) {
            tally.skipped += list.empty();
            continue;
        }
        for (const std::uint32_t slot : list)
            ++tally.listed[lights[slot].type];
        for (std::uint32_t slot = 0; slot < lights.size(); ++slot) {
            const ReferenceLight& light = lights[slot];
            tally.possible += light.on;
            const auto at = std::find_if(points[cell].begin(), points[cell].end(),
                                         [&](const glm::dvec3& p) { return light.reaches(p); });
            const bool reached = at != points[cell].end();
            const bool isListed = std::binary_search(list.begin(), list.end(), slot);
            tally.reached[light.type] += reached && isListed;
            missing += reached && !isListed;
            if (reached && !isListed && missing == 1) {
                ADD_FAILURE() << "light " << slot << " of type " << light.type << ", range "
                              << light.bounds.radiusM << ", reaches (" << at->x << ", " << at->y << ", "
                              << at->z << ") but is not on the list of cell " << cell << " with "
                              << list.size();
            }
            // What gives light reaches, whatever the bounds say.
            const glm::dvec3& some = points[cell][points[cell].size() / 2];
            if (!isListed && f64::luminance(f64::lightEvaluate(light.light, some)) > 0.0) {
                ADD_FAILURE() << "light " << slot << " shines on a point without being on its list";
            }
        }
    }
    EXPECT_EQ(missing, 0u);
    ++tally.frames;
}

// With what their functions look up.
struct ReferenceLights {
    GpuLights records;
    std::vector<ReferenceLight> lights;
    BindLightTables bound;

    ReferenceLights(const Scene& scene, const GridRig& rig)
        : records(makeGpuLights(scene, rig.scene().anchor(), kExposureEv100)), bound(records.tables) {
        for (const shared::LightHot& hot : records.hot)
            lights.emplace_back(hot);
    }
};

// From within the lights, from beside them, and from where all are behind the camera or far before it.
GridView randomView(Random& random, double spreadM) {
    GridView view;
    const int place = int(random.within(0.0, 4.0));
    const glm::dvec3 from = random.inCube(place == 0 ? 20.0 * spreadM : 1.3 * spreadM);
    const glm::dvec3 to = place == 1 ? 2.0 * from : random.inCube(spreadM);
    const glm::dvec3 up = glm::normalize(random.inCube(1.0) + glm::dvec3(0.0, 1e-3, 0.0));
    view.camera.worldFromCamera = glm::inverse(glm::lookAt(from, to, up));
    view.camera.orthographic = random.within(0.0, 4.0) < 1.0;
    view.camera.xmagM = view.camera.ymagM = random.octaves(0.05, 3.0) * spreadM;
    view.camera.yfovRad = random.octaves(0.03, 2.6);
    view.camera.znearM = 1e-3 * spreadM;
    view.widthPx = int(random.octaves(5.0, 200.0));
    view.heightPx = int(random.octaves(5.0, 140.0));
    view.extentM = random.octaves(0.3, 30.0) * spreadM;
    return view;
}

void print(const char* what, const Tally& tally) {
    const double reached = std::accumulate(tally.reached.begin(), tally.reached.end(), 0.0),
                 listed = std::accumulate(tally.listed.begin(), tally.listed.end(), 0.0);
    std::printf(
        "%s: %zu frames, %zu lights; lists of cells with surfaces hold %.1f %% of the lights that are on, "
        "%.1f %% of their entries reach a surface there; %zu cells skipped\n",
        what, tally.frames, tally.lights, 100.0 * listed / double(tally.possible), 100.0 * reached / listed,
        tally.skipped);
    constexpr const char* kTypes[] = {"directional", "sphere", "spot", "tube", "rect", "disk"};
    std::printf("   entries per one that reaches:");
    for (int type = 0; type < 6; ++type)
        std::printf(" %s %.2f", kTypes[type], double(tally.listed[type]) / double(tally.reached[type]));
    std::printf("\n");
}

TEST_F(GridListsTest, NoLightThatReachesASurfaceIsMissing) {
    Random random{std::mt19937(11)};
    std::map<Depths, Tally> tallies;
    for (std::uint32_t seed = 1; seed <= 24; ++seed) {
        // Lengths from centimetres to kilometres; ranges from a thousandth of the crowd to ten times it.
        const LightCrowd crowd{.count = 200,
                               .spreadM = random.octaves(0.05, 2000.0),
                               .longestRange = seed % 3 == 0 ? 10.0 : 0.5,
                               .seed = seed};
        const Scene scene = crowdScene(crowd);
        for (int camera = 0; camera < 5; ++camera) {
            GridRig rig(passes_, scene, randomView(random, crowd.spreadM), kExposureEv100);
            const ReferenceLights reference(scene, rig);
            for (const Depths kind : {Depths::Scattered, Depths::Shapes, Depths::Borders}) {
                const std::vector<float> depths = makeDepths(rig.constants(), kind, random);
                rig.setDepths(depths);
                GridLists lists = rig.run(camera % 2 ? shared::GRID_MAX_THREAD_LIGHTS : 16);
                if (lists.use.indices > lists.use.capacity) lists = rig.run(16); // now there is room
                ASSERT_EQ(lists.use.coarseCells, 0u);
                check(rig, lists, depths, reference.lights, tallies[kind]);
                if (HasFailure())
                    FAIL() << "seed " << seed << ", camera " << camera << ", depths " << int(kind);
            }
        }
        for (auto& [kind, tally] : tallies)
            tally.lights += std::size_t(crowd.count);
    }
    print("scattered depths", tallies[Depths::Scattered]);
    print("walls and sky", tallies[Depths::Shapes]);
    print("borders of slices", tallies[Depths::Borders]);
    // Lists that hold everything would pass the rest. Where the pyramid hides nothing, over-inclusion is the
    // bounds' own.
    for (const std::uint32_t type : {shared::LIGHT_SPHERE, shared::LIGHT_SPOT, shared::LIGHT_TUBE,
                                     shared::LIGHT_RECT, shared::LIGHT_DISK}) {
        const Tally& tally = tallies[Depths::Scattered];
        const double most =
            type == shared::LIGHT_SPOT ? 4.5 : 1.4; // half of the cones are narrower than a pixel's share
        EXPECT_LT(double(tally.listed[type]), most * double(tally.reached[type])) << "type " << type;
    }
}

// By a thread per cell, by a group, and by either as the coarse list's length says: list by list the same.
TEST_F(GridListsTest, ThreadsAndGroupsFillTheSameLists) {
    Random random{std::mt19937(12)};
    for (const int count : {40, 500, 3000}) {
        const Scene scene = crowdScene({.count = count, .seed = 5});
        GridView view = randomView(random, 1.0);
        view.widthPx = 200;
        view.heightPx = 150;
        view.extentM = 3.0;
        GridRig rig(passes_, scene, view, kExposureEv100);
        rig.setDepths(makeDepths(rig.constants(), Depths::Scattered, random));
        rig.run(0); // makes room
        const GridLists byGroup = rig.run(0);
        for (const std::uint32_t threadLights : {30u, 100u, shared::GRID_MAX_THREAD_LIGHTS}) {
            const GridLists mixed = rig.run(threadLights);
            EXPECT_EQ(mixed.use.indices, byGroup.use.indices);
            EXPECT_EQ(mixed.use.tests, byGroup.use.tests);
            for (std::size_t cell = 0; cell < byGroup.cells.size(); ++cell) {
                ASSERT_TRUE(std::ranges::equal(mixed.of(cell), byGroup.of(cell)))
                    << count << ", cell " << cell;
                ASSERT_EQ(mixed.cells[cell].typeMask, byGroup.cells[cell].typeMask);
            }
        }
    }
}

// Without room, some cells have their own list and some their coarse cell's; all hold what reaches them.
TEST_F(GridListsTest, CoarseListsStandInForWantOfRoom) {
    Random random{std::mt19937(13)};
    const Scene scene = crowdScene({.count = 400, .longestRange = 30.0, .seed = 6});
    GridView view = randomView(random, 1.0);
    view.widthPx = 160;
    view.heightPx = 130;
    for (const std::uint32_t threadLights : {0u, shared::GRID_MAX_THREAD_LIGHTS}) {
        GridRig rig(passes_, scene, view, kExposureEv100);
        const std::vector<float> depths = makeDepths(rig.constants(), Depths::Scattered, random);
        rig.setDepths(depths);
        rig.limitFineIndices(0);
        const GridLists all = rig.run(threadLights);
        ASSERT_GT(all.use.indices, all.use.capacity);
        rig.limitFineIndices(0);
        Tally tally;
        const GridLists lists = rig.run(threadLights);
        EXPECT_GT(lists.use.coarseCells, 0u);
        EXPECT_LT(lists.use.coarseCells, lists.cells.size());
        check(rig, lists, depths, ReferenceLights(scene, rig).lights, tally);
        rig.run(threadLights);
        EXPECT_EQ(rig.run(threadLights).use.coarseCells, 0u);
    }
}

// In columns whose surfaces all lie between two depths, the cells before and behind hold no lights.
TEST_F(GridListsTest, CellsBeforeAndBehindTheSurfacesAreSkipped) {
    const Scene scene = crowdScene({.count = 300, .longestRange = 10.0, .seed = 7});
    GridView view;
    view.camera.worldFromCamera =
        glm::inverse(glm::lookAt(glm::dvec3(0, 0, 1.5), glm::dvec3(0), glm::dvec3(0, 1, 0)));
    view.widthPx = 256;
    view.heightPx = 128;
    view.extentM = 4.0;
    GridRig rig(passes_, scene, view, kExposureEv100);
    const shared::GridConstants& grid = rig.constants().grid;
    // The left half at 1 to 1.2 m, the right half sky.
    Random random{std::mt19937(14)};
    std::vector<float> depths(256 * 128, shared::DEPTH_SKY);
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x)
            depths[std::size_t(y * 256 + x)] = float(random.within(1.0, 1.2));
    }
    rig.setDepths(depths);
    const GridLists lists = rig.run(shared::GRID_MAX_THREAD_LIGHTS);
    std::set<std::uint32_t> filled;
    for (std::uint32_t cell = 0; cell < lists.cells.size(); ++cell) {
        const std::uint32_t column = cell % grid.fineSize.x,
                            slice = cell / (grid.fineSize.x * grid.fineSize.y);
        if (lists.cells[cell].count == 0) continue;
        EXPECT_LT(column, 4u) << "sky";
        filled.insert(slice);
    }
    const auto sliceOf = [&](double depthM) {
        return 1u + std::uint32_t(std::log2(depthM / grid.firstDepthM) * grid.slicesPerOctave);
    };
    EXPECT_EQ(*filled.begin(), sliceOf(1.0));
    EXPECT_EQ(*filled.rbegin(), sliceOf(1.2));
    // Nothing is tested against what no surface is in, not even against a coarse cell.
    const std::uint32_t side = shared::GRID_COARSE, columns = 4 * 4;
    const std::uint32_t slices = sliceOf(1.2) - sliceOf(1.0) + 1,
                        coarse = sliceOf(1.2) / side - sliceOf(1.0) / side + 1;
    EXPECT_LE(lists.use.tests, 300 * (coarse + columns * slices));
    rig.setDepths(std::vector<float>(256 * 128, shared::DEPTH_SKY));
    EXPECT_EQ(rig.run(shared::GRID_MAX_THREAD_LIGHTS).use.tests, 0u);
}

} // namespace
} // namespace kilolux::test
