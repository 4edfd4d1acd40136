// The committed table against a coarse one fitted anew, and the loader's errors.
#include "content/make/ltc_fit.h"
#include "renderer/lights_cpp/lights_f64.h"
#include "tests/unit/lights/random_lights.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace kilolux::test {
namespace {

// Nodes 0, 9, 18 ... 63 of the committed 64 x 64 table are the nodes of an 8 x 8 one.
TEST(LtcTable, CoarseRefitGivesTheCommittedNodes) {
    const auto committed = loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin");
    ASSERT_TRUE(committed) << committed.error();
    ASSERT_EQ(committed.value().width, 64);
    ASSERT_EQ(committed.value().height, 64);
    const LtcTable coarse = fitLtcTable(8, 8, 2);
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 8; ++column) {
            const glm::vec4 scales = coarse.scales[row * 8 + column];
            const glm::vec4 kept = committed.value().scales[row * 9 * 64 + column * 9];
            EXPECT_NEAR(scales.y, kept.y, 1e-5f);
            EXPECT_NEAR(scales.z, kept.z, 1e-5f);
            EXPECT_NEAR(scales.x, kept.x, 0.02f) << row << ", " << column;
            EXPECT_LT(scales.w, kept.w * 1.05f + 1e-5f)
                << "the refit found a worse fit at " << row << ", " << column;
            EXPECT_LT(kept.w, scales.w * 1.05f + 1e-5f)
                << "the committed fit is worse at " << row << ", " << column;
        }
}

// Albedo by a method of its own: the sky's radiance, integrated over light directions.
TEST(LtcTable, AlbedoIsTheIntegralOfTheBrdf) {
    bindCommittedTable();
    for (const double roughness : {0.3, 0.6, 1.0})
        for (const double noV : {0.1, 0.4, 0.8, 1.0}) {
            Surface surface;
            surface.roughness = roughness;
            surface.view = {std::sqrt(1.0 - noV * noV), 0.0, noV};
            dvec2 sum(0.0);
            const int count = 1000;
            for (int i = 0; i < count * count; ++i) {
                const dvec3 dir =
                    f64::cosineHemisphereFromSquare({(i % count + 0.5) / count, (i / count + 0.5) / count});
                const dvec2 ggx = referenceGgx(surface, dir);
                sum += dvec2(1.0 - ggx.y, ggx.y) * (ggx.x * kPi / dir.z / (count * count));
            }
            const f64::ShadingPoint point =
                f64::makeShadingPoint({0, 0, 0}, {0, 0, 1}, surface.view, roughness);
            const f64::LtcLobe lobe = f64::makeLtcLobe(point);
            EXPECT_NEAR(lobe.albedo.x, sum.x, 2e-3) << roughness << ", " << noV;
            EXPECT_NEAR(lobe.albedo.y, sum.y, 2e-3) << roughness << ", " << noV;
        }
}

TEST(LtcTable, DensityIntegratesToOne) {
    bindCommittedTable();
    for (const double roughness : {0.1, 0.5, 1.0})
        for (const double noV : {0.1, 0.7}) {
            const f64::ShadingPoint point = f64::makeShadingPoint(
                {0, 0, 0}, {0, 0, 1}, {std::sqrt(1.0 - noV * noV), 0.0, noV}, roughness);
            const f64::LtcLobe lobe = f64::makeLtcLobe(point);
            double sum = 0.0;
            double above = 0.0;
            const int count = 400;
            for (int i = 0; i < count * count; ++i) {
                // In LTC space, where the density is the cosine: each sample must weigh the same.
                const dvec3 cosine =
                    f64::cosineHemisphereFromSquare({(i % count + 0.5) / count, (i / count + 0.5) / count});
                const dvec3 image = lobe.worldFromLtc * cosine;
                const dvec3 dir = glm::normalize(image);
                const double jacobian =
                    std::abs(glm::determinant(lobe.worldFromLtc)) / std::pow(glm::length(image), 3.0);
                const double weight =
                    f64::ltcDensity(lobe, dir) * jacobian / (cosine.z / kPi) / (count * count);
                sum += weight;
                above += dir.z > 0.0 ? weight : 0.0;
            }
            EXPECT_NEAR(sum, 1.0, 1e-6);
            EXPECT_NEAR(above, f64::ltcShareAboveHorizon(lobe, {0, 0, 1}), 2e-3);
        }
}

TEST(LtcTable, BadFilesAreRefusedByName) {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / "kilolux_ltc_test.bin";
    EXPECT_NE(loadLtcTable(path / "missing").error().find("missing"), std::string::npos);
    const auto write = [&](const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; };
    write("not a table at all, but long enough for a header");
    EXPECT_NE(loadLtcTable(path).error().find("KXLTC01"), std::string::npos);
    write(std::string("KXLTC01\n\x40\0\0\0\x40\0\0\0", 16) + std::string(100, '\0'));
    EXPECT_NE(loadLtcTable(path).error().find("100 of"), std::string::npos);
    write(std::string("KXLTC01\n\xff\xff\xff\xff\x40\0\0\0", 16));
    EXPECT_NE(loadLtcTable(path).error().find("1024"), std::string::npos);
    LtcTable table{.width = 2,
                   .height = 2,
                   .parameters = std::vector<glm::vec4>(4),
                   .scales = std::vector<glm::vec4>(4, glm::vec4(2.0f))};
    ASSERT_TRUE(saveLtcTable(table, path));
    const auto loaded = loadLtcTable(path);
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded.value().scales[3], glm::vec4(2.0f));
    table.parameters[1].x = std::nanf("");
    ASSERT_TRUE(saveLtcTable(table, path));
    EXPECT_NE(loadLtcTable(path).error().find("node 1"), std::string::npos);
    std::filesystem::remove(path);
}

} // namespace
} // namespace kilolux::test
