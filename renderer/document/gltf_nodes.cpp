// Nodes, scenes and cameras (glTF 2.0, sections 3.5 and 3.10). The node graph must be a forest.
#include "renderer/document/gltf_fields.h"
#include "renderer/document/gltf_model.h"

#include <cmath>

namespace kilolux::gltf {

namespace {

glm::dmat4 matrixOf(const tinygltf::Node& node) {
    glm::dmat4 matrix(1.0);
    for (int i = 0; i < 16; ++i)
        matrix[i / 4][i % 4] = node.matrix[i];
    return matrix;
}

Trs trsOf(const tinygltf::Node& node, const std::string& place) {
    Trs trs;
    if (node.translation.size() == 3)
        trs.translation = {node.translation[0], node.translation[1], node.translation[2]};
    if (node.rotation.size() == 4) {
        const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(rotation);
        if (!(length > 1e-12) || !std::isfinite(length))
            fail(place + "/rotation", "expected a unit quaternion");
        trs.rotation = rotation / length;
    }
    if (node.scale.size() == 3) trs.scale = {node.scale[0], node.scale[1], node.scale[2]};
    return trs;
}

std::uint8_t meshChannelsOf(ImportContext& context, std::size_t node) {
    const Json* extras = findObject(context.json["nodes"][node], "extras");
    const Json* ours = extras ? findObject(*extras, "kilolux") : nullptr;
    double bits = Node{}.meshChannels;
    if (ours)
        Fields(context, *ours, fmt::format("/nodes/{}/extras/kilolux", node))
            .number("meshChannels", 0, 255, bits);
    return static_cast<std::uint8_t>(bits);
}

void readNodes(ImportContext& context, const tinygltf::Model& model) {
    std::vector<Node>& nodes = context.scene.nodes;
    nodes.resize(model.nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::string place = fmt::format("/nodes/{}", i);
        const tinygltf::Node& source = model.nodes[i];
        nodes[i].id = i + 1;
        nodes[i].name = source.name;
        nodes[i].mesh = source.mesh;
        nodes[i].meshChannels = meshChannelsOf(context, i);
        nodes[i].visible = false;
        if (source.matrix.size() != 16) nodes[i].restTrs = trsOf(source, place);
        nodes[i].localFromNode = nodes[i].restTrs ? matrixFrom(*nodes[i].restTrs) : matrixOf(source);
        if (!fitsSinglePrecision(nodes[i].localFromNode)) fail(place, "expected a finite transform");
        for (const int child : source.children) {
            if (nodes[child].parent >= 0) {
                fail(place + "/children", "expected one parent for each node, node {} has two: {} and {}",
                     child, nodes[child].parent, i);
            }
            nodes[child].parent = static_cast<int>(i);
        }
    }
}

// Marks what hangs below the default scene; with no scenes at all, everything. Whatever cannot be reached
// from a root is part of a cycle.
void markVisible(ImportContext& context, const tinygltf::Model& model) {
    std::vector<Node>& nodes = context.scene.nodes;
    std::vector<int> stack;
    const auto visit = [&](auto&& onNode) {
        std::size_t count = 0;
        while (!stack.empty()) {
            const int node = stack.back();
            stack.pop_back();
            if (nodes[node].visible) continue; // a scene may list a node and one below it
            onNode(nodes[node]);
            ++count;
            stack.insert(stack.end(), model.nodes[node].children.begin(), model.nodes[node].children.end());
        }
        return count;
    };
    std::vector<int> roots;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].parent < 0) roots.push_back(static_cast<int>(i));
    }
    stack = roots;
    std::vector<bool> reached(nodes.size(), false);
    if (visit([&](const Node& node) { reached[&node - nodes.data()] = true; }) < nodes.size()) {
        const auto first = std::find(reached.begin(), reached.end(), false) - reached.begin();
        fail(fmt::format("/nodes/{}", first),
             "expected a tree, the node is its own ancestor or below one that is");
    }
    const int scene = model.defaultScene >= 0 ? model.defaultScene : 0;
    stack = scene < static_cast<int>(model.scenes.size()) ? model.scenes[scene].nodes : roots;
    visit([](Node& node) { node.visible = true; });
}

Camera readCamera(const tinygltf::Camera& source) {
    Camera camera;
    camera.orthographic = source.type == "orthographic";
    if (camera.orthographic) {
        camera.xmagM = std::max(std::abs(source.orthographic.xmag), 1e-9);
        camera.ymagM = std::max(std::abs(source.orthographic.ymag), 1e-9);
        camera.znearM = source.orthographic.znear;
        camera.zfarM = source.orthographic.zfar;
    } else {
        camera.yfovRad = source.perspective.yfov;
        camera.znearM = source.perspective.znear;
        if (source.perspective.zfar > camera.znearM) camera.zfarM = source.perspective.zfar;
        if (source.perspective.aspectRatio > 0.0) camera.aspect = source.perspective.aspectRatio;
    }
    return camera;
}

void readCameras(ImportContext& context, const tinygltf::Model& model) {
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        const Node& node = context.scene.nodes[i];
        const int index = model.nodes[i].camera;
        if (index < 0 || !node.visible) continue;
        Camera camera = readCamera(model.cameras[index]);
        // Artists name the camera object, which exporters write as the node.
        camera.name = !node.name.empty() ? node.name : model.cameras[index].name;
        if (camera.name.empty()) camera.name = fmt::format("camera {}", context.scene.cameras.size());
        camera.id = context.scene.cameras.size() + 1;
        camera.node = static_cast<int>(i);
        camera.worldFromCamera = rigidFrame(node.worldFromNode);
        context.scene.cameras.push_back(std::move(camera));
    }
}

} // namespace

void importNodes(ImportContext& context, const tinygltf::Model& model) {
    readNodes(context, model);
    markVisible(context, model);
    updateWorldTransforms(context.scene);
    for (std::size_t i = 0; i < context.scene.nodes.size(); ++i) {
        if (!fitsSinglePrecision(context.scene.nodes[i].worldFromNode)) {
            fail(fmt::format("/nodes/{}", i), "expected a finite transform in the world");
        }
    }
    readCameras(context, model);
    if (context.json.contains("skins")) context.warn("/skins", "skins are shown in their rest pose");
}

} // namespace kilolux::gltf
