// The import from top to bottom: bytes, JSON, checks, structures, scene.
#include "renderer/document/gltf_model.h"
#include "renderer/document/scene_files.h"

namespace kilolux {

namespace {

Scene importScene(gltf::ImportContext& context) {
    using namespace gltf;
    context.reach("Reading the file", 0.0);
    Bytes file = readFile(context.path, UINT64_MAX, "file", &context);
    context.fileBytes = file.size();
    context.reach("Reading the file", 0.15);
    parseDocument(context, file);
    if (!context.binaryChunk.data()) Bytes().swap(file); // the text is parsed; it may hold large data URIs
    checkExtensions(context);
    context.reach("Checking the file", 0.25);
    checkSchema(context);
    context.reach("Reading buffers", 0.3);
    loadBuffers(context);
    decodeCompressedViews(context);
    {
        context.reach("Reading buffers", 0.35);
        const tinygltf::Model model = parseModel(context);
        importMaterials(context, model);
        importNodes(context, model);
        importMeshes(context, model);
        importAnimations(context, model);
    }
    context.reach("Reading lights", 0.97);
    context.scene.files = std::make_shared<SceneFiles>(
        context.path.parent_path(), context.options.loadImages ? Pictures::Read : Pictures::LeaveOut);
    importSceneExtras(context);
    importLights(context);
    if (triangleCount(context.scene) == 0)
        context.warn("/nodes", "no visible node has a mesh with triangles");
    if (context.droppedWarnings > 0) {
        context.scene.warnings.push_back(fmt::format("and {} more warnings", context.droppedWarnings));
    }
    return std::move(context.scene);
}

} // namespace

Result<Scene> importGltf(const std::filesystem::path& path, const ImportOptions& options) {
    const std::string name = gltf::printable(path.string());
    gltf::ImportContext context;
    context.path = path;
    context.options = options;
    context.scene.sourcePath = path;
    try {
        return importScene(context);
    } catch (const gltf::ImportFailure& failure) {
        return Error{name + ": " + failure.text};
    } catch (const gltf::ImportCancelled&) {
        return Error{name + ": opening was cancelled"};
    } catch (const std::bad_alloc&) {
        return Error{name + ": file: expected a scene that fits into memory"};
    } catch (const std::exception& e) {
        // Thrown by a library over a value that the checks let through.
        return Error{
            fmt::format("{}: file: expected a valid glTF file: {}", name, gltf::printable(e.what()))};
    }
}

} // namespace kilolux
