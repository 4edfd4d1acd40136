// oracle_render SCENE -o OUT.{png,exr}: a picture by the oracle, to look at or to compare with. Lights can be
// added on the command line, because many test files have none. PNG: exposed by --ev, clipped, sRGB.
#include "renderer/document/gltf_import.h"
#include "renderer/document/light_units.h"
#include "renderer/output/picture_file.h"
#include "renderer/reference/oracle.h"
#include "renderer/reference/oracle_light.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/core.h>

using namespace kilolux;

namespace {

// A sphere light of `lumen` at a world position.
void addSphere(Scene& scene, const std::vector<double>& numbers) {
    LightDef def;
    def.unit = LightUnit::Lumen;
    def.radiusM = numbers[3];
    def.intensity = numbers[4];
    def.rayEndBiasM = 0.0;
    Node node;
    node.worldFromNode[3] = node.localFromNode[3] = glm::dvec4(numbers[0], numbers[1], numbers[2], 1.0);
    scene.nodes.push_back(node);
    scene.lightDefs.push_back(def);
    scene.lights.push_back({.node = int(scene.nodes.size()) - 1, .def = int(scene.lightDefs.size()) - 1});
}

// Looks from the first three numbers at the last three; 60 degrees high.
Camera lookAt(const std::vector<double>& numbers) {
    const glm::dvec3 eye(numbers[0], numbers[1], numbers[2]);
    const glm::dvec3 z = glm::normalize(eye - glm::dvec3(numbers[3], numbers[4], numbers[5]));
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), z));
    Camera camera;
    camera.yfovRad = 1.0471975511965976;
    camera.worldFromCamera =
        glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), glm::dvec4(eye, 1));
    return camera;
}

// Without a camera in the file: from a corner of the bounds to their middle.
Camera defaultCamera(const Scene& scene) {
    if (!scene.cameras.empty()) return scene.cameras.front();
    const Bounds b = worldBounds(scene);
    const glm::dvec3 middle = 0.5 * (b.min + b.max);
    const glm::dvec3 eye = middle + (b.max - b.min) * glm::dvec3(0.7, 0.6, 1.1);
    return lookAt({eye.x, eye.y, eye.z, middle.x, middle.y, middle.z});
}

glm::dvec3 valueOf(const oracle::OraclePixel& pixel, const std::string& view) {
    if (view == "normal") return pixel.shadingNormalWs * 0.5 + 0.5;
    if (view == "albedo") return pixel.baseColor;
    if (view == "diffuse") return pixel.diffuseNit;
    if (view == "specular") return pixel.specularNit;
    if (view == "error") return pixel.standardErrorNit;
    return pixel.radianceNit;
}

std::optional<Error> write(const std::string& file, const oracle::OracleImage& image, const std::string& view,
                           double exposure) {
    const Result<PictureFormat> format = pictureFormat(file);
    if (!format) return Error{format.error()};
    FloatImage linear{image.width, image.height, 3, {}};
    std::vector<std::uint8_t> srgb;
    const bool exposed = view != "normal" && view != "albedo";
    for (const oracle::OraclePixel& pixel : image.pixels) {
        const glm::dvec3 value = valueOf(pixel, view);
        for (int c = 0; c < 3; ++c) {
            linear.pixels.push_back(static_cast<float>(value[c]));
            const double v = glm::clamp(value[c] * (exposed ? exposure : 1.0), 0.0, 1.0);
            const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
            srgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * encoded)));
        }
    }
    if (format.value() == PictureFormat::Png) return writePng(file, image.width, image.height, srgb);
    return format.value() == PictureFormat::Exr ? writeExr(file, linear, ExrDepth::Float)
                                                : writeHdr(file, linear);
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{"A picture by the oracle (CPU, double precision)"};
    std::string sceneFile, out, cameraName, view = "radiance";
    std::vector<int> size = {256, 144};
    std::vector<std::vector<double>> spheres;
    std::vector<double> look;
    double ev100 = 1e9;
    bool split = false;
    oracle::OracleOptions options;
    options.samplesPerLight = 32;
    options.pixelSamples = 4;
    app.add_option("scene", sceneFile)->required();
    app.add_option("-o,--output", out)->required();
    app.add_option("--size", size, "width height")->expected(2);
    app.add_option("--camera", cameraName);
    app.add_option("--look", look, "eye x y z, target x y z")->expected(6);
    app.add_option("--sphere", spheres, "add a light: x y z radius lumen")->expected(5);
    app.add_option("--ev", ev100, "EV100 of the picture; default the scene's, or the mean to 18 %");
    app.add_option("--view", view, "radiance, diffuse, specular, error, albedo, normal");
    app.add_option("--samples", options.samplesPerLight);
    app.add_option("--pixel-samples", options.pixelSamples);
    app.add_option("--seed", options.seed);
    app.add_flag("--split", split);
    CLI11_PARSE(app, argc, argv);

    Result<Scene> opened = importGltf(sceneFile);
    if (!opened) {
        fmt::print(stderr, "{}\n", opened.error());
        return 2;
    }
    Scene& scene = opened.value();
    for (const std::vector<double>& numbers : spheres)
        addSphere(scene, numbers);
    Camera camera = look.empty() ? defaultCamera(scene) : lookAt(look);
    for (const Camera& candidate : scene.cameras)
        if (candidate.name == cameraName) camera = candidate;
    options.estimator = split ? oracle::Estimator::Split : oracle::Estimator::True;
    options.jitterPx.reset();
    options.filter = oracle::PixelFilter::BlackmanHarris;
    const oracle::Oracle judge(scene);
    const oracle::OracleImage image = judge.render(camera, size[0], size[1], options);

    glm::dvec3 sum(0.0), error2(0.0);
    for (const oracle::OraclePixel& pixel : image.pixels) {
        sum += pixel.radianceNit;
        error2 += pixel.standardErrorNit * pixel.standardErrorNit;
    }
    const double meanNit = luminanceOf(sum) / double(image.pixels.size());
    double exposure = 0.18 / std::max(meanNit, 1e-12);
    if (ev100 < 1e8 || scene.hasExposure)
        exposure = 1.0 / (1.2 * std::exp2(ev100 < 1e8 ? ev100 : scene.exposureEv100));
    fmt::print("{} lights, {} triangles, mean {:.6g} nit, standard error of the mean {:.2g} nit\n",
               scene.lights.size(), triangleCount(scene), meanNit,
               std::sqrt(luminanceOf(error2)) / double(image.pixels.size()));
    if (const std::optional<Error> error = write(out, image, view, exposure)) {
        fmt::print(stderr, "{}\n", error->message);
        return 3;
    }
    return 0;
}
