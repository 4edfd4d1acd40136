// What a dome's shaders look up, made on the CPU: the distribution by which directions are drawn, irradiance
// and blurred pictures, against sums over the picture; and pictures that are damaged.
#include "renderer/document/light_units.h"
#include "renderer/dome_maps.h"
#include "renderer/lights_cpp/lights_f32.h"
#include "renderer/lights_cpp/lights_f64.h"
#include "renderer/lights_cpp/ltc_table.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace kilolux {
namespace {

using glm::dvec3;

constexpr double kPi = 3.14159265358979323846;

using Radiance = std::function<dvec3(const dvec3&)>;

dvec3 directionOf(double turn, double polar) {
    return {std::sin(polar) * std::sin(2.0 * kPi * (turn - 0.5)), std::cos(polar),
            -std::sin(polar) * std::cos(2.0 * kPi * (turn - 0.5))};
}

std::shared_ptr<const Image> pictureOf(int width, const Radiance& radiance) {
    auto image = std::make_shared<Image>();
    image->width = width;
    image->height = width / 2;
    for (int y = 0; y < image->height; ++y) {
        for (int x = 0; x < width; ++x) {
            const dvec3 rgb = radiance(directionOf((x + 0.5) / width, kPi * (y + 0.5) / image->height));
            for (int c = 0; c < 3; ++c)
                image->rgbaF32.push_back(float(rgb[c]));
            image->rgbaF32.push_back(1.0f);
        }
    }
    return image;
}

// A blue sky over dark ground, with a small sun of most of the light.
dvec3 sky(const dvec3& dir) {
    const bool sun = glm::dot(dir, glm::normalize(dvec3(0.5, 0.6, -0.4))) > std::cos(0.03);
    const dvec3 air = dir.y > 0.0 ? dvec3(0.4, 0.6, 1.0) * (0.3 + dir.y) : dvec3(0.1, 0.08, 0.05);
    return sun ? dvec3(3000.0, 2700.0, 2200.0) : air;
}

Dome domeWith(const std::shared_ptr<const Image>& image) {
    Dome dome;
    dome.image = image;
    dome.intensityNit = 100.0;
    dome.color = {1.0, 0.9, 0.8};
    dome.rotationRad = 0.7;
    return dome;
}

// A dome as a light, its maps bound for as long as it lives.
struct LitDome {
    explicit LitDome(const std::shared_ptr<const Image>& image) : dome(domeWith(image)) {}

    Dome dome;
    LightTables tables{.dome = domeMapsOf(dome.image)};
    BindLightTables bound{tables};
    f64::LightHot light = f64::fromF32(domeRecord(dome, *tables.dome));
};

struct DomeLight : testing::Test {
    static void SetUpTestSuite() {
        useLtcTable(loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin").value());
    }
};

TEST_F(DomeLight, DrawsDirectionsByItsOwnDensity) {
    const LitDome lit(pictureOf(128, sky));
    const f64::LightHot& light = lit.light;
    dvec3 mean(0.0);
    double area = 0.0;
    constexpr int kSide = 1024;
    double largest = 0.0, least = 1e300;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const glm::dvec2 uv((x + 0.5) / kSide, (y + 0.5) / kSide);
            const f64::LightSample s = f64::lightSample(light, dvec3(1.0), uv);
            ASSERT_TRUE(s.valid);
            ASSERT_NEAR(glm::length(s.dirWs), 1.0, 1e-12);
            const f64::LightHit hit = f64::lightIntersect(light, dvec3(1.0), s.dirWs);
            ASSERT_NEAR(hit.pdfSolidAngle, s.pdfSolidAngle, 1e-6 * s.pdfSolidAngle);
            ASSERT_LT(glm::length(hit.uv - uv), 1e-5);
            const dvec3 value =
                light.intensity * f64::lightTint(light, s) * s.geometry / double(kSide * kSide);
            mean += value;
            area += s.geometry / (kSide * kSide);
            const double nit = luminanceOf(value);
            largest = std::max(largest, nit);
            least = std::min(least, nit);
        }
    }
    // All of the sphere, and its light as the picture's sum has it. The grid has three points for a cell of
    // dark ground, whose light is known to no better than that.
    EXPECT_NEAR(area / (4.0 * kPi), 1.0, 1e-3);
    dvec3 truth(0.0);
    const Image& image = *lit.dome.image;
    for (int y = 0; y < image.height; ++y) {
        const double row =
            2.0 * kPi * (std::cos(kPi * y / image.height) - std::cos(kPi * (y + 1) / image.height));
        for (int x = 0; x < image.width; ++x) {
            const std::size_t at = 4 * (std::size_t(y) * 128 + std::size_t(x));
            truth +=
                dvec3(image.rgbaF32[at], image.rgbaF32[at + 1], image.rgbaF32[at + 2]) * (row / image.width);
        }
    }
    truth *= lit.dome.color * lit.dome.intensityNit;
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean[c] / truth[c], 1.0, 1.5e-3);
    // In proportion to luminance, up to interpolation within a cell: where a dark cell's corner meets the
    // sun's, a quarter of its light shines with a 64th of its density.
    EXPECT_LT(largest / (luminanceOf(mean) / (kSide * kSide)), 16.0);
    EXPECT_GT(least, 0.0);
}

// Over solid angle, row by row of other sizes; exact, as the density is even within a cell.
TEST_F(DomeLight, DensityIntegratesToOne) {
    const LitDome lit(pictureOf(128, sky));
    double sum = 0.0;
    constexpr int kRows = 128, kColumns = 256;
    for (int y = 0; y < kRows; ++y) {
        const double areaSr =
            2.0 * kPi * (std::cos(kPi * y / kRows) - std::cos(kPi * (y + 1) / kRows)) / kColumns;
        for (int x = 0; x < kColumns; ++x) {
            const dvec3 dir = directionOf((x + 0.5) / kColumns, kPi * (y + 0.5) / kRows);
            sum += f64::lightIntersect(lit.light, dvec3(1.0), dir).pdfSolidAngle * areaSr;
        }
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
}

TEST_F(DomeLight, IrradianceIsTheSumOverThePicture) {
    const LitDome skyDome(pictureOf(128, sky));
    const f64::LightHot& light = skyDome.light;
    std::mt19937 random(3);
    std::normal_distribution<double> axis;
    double worst = 0.0;
    for (int i = 0; i < 40; ++i) {
        const dvec3 normal =
            i == 0 ? dvec3(0, 1, 0) : glm::normalize(dvec3(axis(random), axis(random), axis(random)));
        dvec3 truth(0.0);
        constexpr int kSide = 512;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const f64::LightSample s =
                    f64::lightSample(light, dvec3(0.0), {(x + 0.5) / kSide, (y + 0.5) / kSide});
                const double cosine = std::max(glm::dot(s.dirWs, normal), 0.0);
                truth += light.intensity * f64::lightTint(light, s) * (cosine * s.geometry / (kSide * kSide));
            }
        }
        const f64::ShadingPoint point = f64::makeShadingPoint(dvec3(0.0), normal, normal, 0.7);
        const f64::LightIrradiance lit = f64::lightIrradiance(light, point, f64::makeLtcLobe(point));
        worst = std::max(worst, std::abs(luminanceOf(lit.emission * lit.diffuse) / luminanceOf(truth) - 1.0));
        EXPECT_GT(f64::lightWeight(light, point, 0.5, 0.04), 0.0);
    }
    std::printf("irradiance off by at most %.2f %%\n", 100.0 * worst);
    EXPECT_LT(worst, 0.01);
}

// One colour: the furnace, exactly.
TEST_F(DomeLight, WhiteOneIsAFurnace) {
    const LitDome white(nullptr);
    const f64::LightHot& light = white.light;
    const Dome& dome = white.dome;
    const dvec3 nit = dome.color * dome.intensityNit;
    for (const double roughness : {0.05, 0.3, 1.0}) {
        for (const double cosine : {1.0, 0.6, 0.1}) {
            const dvec3 view(std::sqrt(1.0 - cosine * cosine), cosine, 0.0);
            const f64::ShadingPoint point =
                f64::makeShadingPoint(dvec3(0.0), dvec3(0, 1, 0), view, roughness);
            const f64::LtcLobe lobe = f64::makeLtcLobe(point);
            const f64::LightIrradiance lit = f64::lightIrradiance(light, point, lobe);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(lit.emission[c] * lit.diffuse, kPi * nit[c], 1e-4 * nit[c]);
                EXPECT_NEAR(lit.specularEmission[c], nit[c], 1e-5 * nit[c]);
            }
            EXPECT_EQ(lit.specular.x, lobe.albedo.x);
        }
    }
}

// Every level holds the picture's light, but for the ends of the blur, which are cut off.
TEST_F(DomeLight, LevelsKeepTheLight) {
    const std::shared_ptr<const DomeMaps> maps = domeMapsOf(pictureOf(256, sky));
    ASSERT_GE(maps->levels.size(), 4u);
    for (const DomeMaps::Picture& level : maps->levels) {
        double sum = 0.0, area = 0.0;
        for (int y = 0; y < level.height; ++y) {
            const double row = std::cos(kPi * y / level.height) - std::cos(kPi * (y + 1) / level.height);
            for (int x = 0; x < level.width; ++x) {
                sum += luminanceOf(
                           dvec3(level.texels[std::size_t(y) * std::size_t(level.width) + std::size_t(x)])) *
                       row;
                area += row;
            }
        }
        EXPECT_NEAR(sum / area / maps->meanLuminance, 1.0, 0.005) << level.width;
    }
}

TEST_F(DomeLight, DamagedTexelsAreBlack) {
    const std::shared_ptr<const Image> sound = pictureOf(64, sky);
    auto black = std::make_shared<Image>(*sound), damaged = std::make_shared<Image>(*sound);
    const float values[] = {std::nanf(""), std::numeric_limits<float>::infinity(), -5.0f,
                            -std::numeric_limits<float>::infinity()};
    for (std::size_t i = 0; i < 40; ++i) {
        black->rgbaF32[i * 80 + i % 3] = 0.0f;
        damaged->rgbaF32[i * 80 + i % 3] = values[i % 4];
    }
    const auto a = domeMapsOf(black), b = domeMapsOf(damaged);
    EXPECT_EQ(a->distribution, b->distribution);
    EXPECT_EQ(a->levels[0].texels, b->levels[0].texels);
    EXPECT_EQ(a->irradiance.texels, b->irradiance.texels);
    Dome dome = domeWith(pictureOf(64, [](const dvec3&) { return dvec3(-1.0, std::nan(""), 0.0); }));
    EXPECT_FALSE(domeShines(dome)) << "nothing in it shines";
    dome = domeWith(nullptr);
    dome.intensityNit = std::nan("");
    EXPECT_FALSE(domeShines(dome));
}

} // namespace
} // namespace kilolux
