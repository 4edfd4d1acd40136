#include "tests/image/dome_scenes.h"

#include "tests/unit/accel/scene_kit.h"

namespace kilolux::test {

using glm::dvec3;

std::shared_ptr<const Image> panorama(int width, const std::function<dvec3(const dvec3&)>& radiance) {
    auto image = std::make_shared<Image>();
    image->name = "sky";
    image->width = width;
    image->height = width / 2;
    for (int y = 0; y < image->height; ++y) {
        const double polar = oracle::kPi * (y + 0.5) / image->height;
        for (int x = 0; x < width; ++x) {
            const double longitude = 2.0 * oracle::kPi * ((x + 0.5) / width - 0.5);
            const dvec3 rgb = radiance({std::sin(polar) * std::sin(longitude), std::cos(polar),
                                        -std::sin(polar) * std::cos(longitude)});
            for (int c = 0; c < 3; ++c)
                image->rgbaF32.push_back(float(rgb[c]));
            image->rgbaF32.push_back(1.0f);
        }
    }
    return image;
}

dvec3 gradientSky(const dvec3& dir) {
    return dvec3(0.5, 0.6, 0.9) * (1.2 + dir.y) + dvec3(0.6, 0.4, 0.1) * (1.0 + dir.x);
}

dvec3 sunnySky(const dvec3& dir) {
    const double sun = glm::dot(dir, glm::normalize(dvec3(0.6, 0.7, 0.5)));
    return gradientSky(dir) +
           (sun > std::cos(glm::radians(2.0)) ? dvec3(3000.0, 2800.0, 2400.0) : dvec3(0.0));
}

Scene ballScene() {
    SceneBuilder b;
    addPrimitive(b, makeSphere(48, 64, 1.0), Shading::Flat, glm::dmat4(1.0),
                 b.material({0.8, 0.6, 0.4}, 0.0, 0.6));
    b.scene.cameras.push_back(cameraLooking({0, 0.8, 3.4}, {0, 0, 0}));
    return std::move(b.scene);
}

} // namespace kilolux::test
