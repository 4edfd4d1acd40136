// Opens .gltf and .glb files as a Scene (glTF 2.0, Khronos Group, specification 2.0.1). Nothing that a file
// holds can crash or hang the import, or make it take more than 256 MiB plus 20 times the bytes of the files
// it reads.
#pragma once

#include "renderer/document/result.h"
#include "renderer/document/scene.h"

#include <filesystem>

namespace kilolux {

class TaskWatch; // task_watch.h

struct ImportOptions {
    bool loadImages = true;     // false leaves every TextureRef empty
    TaskWatch* watch = nullptr; // null: nobody waits; cancelled, the import ends with an error
};

// Reads the file and what it refers to within its own folder. An error is one line, `file: JSON pointer: what
// was expected`; what could be replaced by a sensible default instead is told in Scene::warnings. World
// transforms are up to date. Nodes outside the default scene are kept, with `visible` false and no light.
Result<Scene> importGltf(const std::filesystem::path& path, const ImportOptions& options = {});

} // namespace kilolux
