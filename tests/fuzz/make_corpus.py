#!/usr/bin/python3
"""Writes the hand-made seeds of the glTF fuzz corpus (corpus/gltf); inputs that fuzzing found lie beside them."""
import base64
import json
import os
import struct

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "corpus", "gltf")
# A PNG of 1 x 1 pixel, red.
PNG = base64.b64decode("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC")


def data_uri(data, mime="application/octet-stream"):
    return f"data:{mime};base64,{base64.b64encode(data).decode()}"


def square():
    positions = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0)
    normals = struct.pack("<12f", *([0, 0, 1] * 4))
    uv = struct.pack("<8f", 0, 1, 1, 1, 1, 0, 0, 0)
    indices = struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    sparse = struct.pack("<H", 2) + b"\0\0" + struct.pack("<3f", 2, 2, 0)
    data = positions + normals + uv + indices + sparse
    views, offset = [], 0
    for part in (positions, normals, uv, indices, sparse[:2] + b"\0\0", sparse[4:]):
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part)})
        offset += len(part)
    accessors = [
        {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4},
        {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": 4},
        {"bufferView": 2, "componentType": 5126, "type": "VEC2", "count": 4},
        {"bufferView": 3, "componentType": 5123, "type": "SCALAR", "count": 6},
        {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4,
         "sparse": {"count": 1, "indices": {"bufferView": 4, "componentType": 5123}, "values": {"bufferView": 5}}},
    ]
    return data, views, accessors


def full_scene():
    data, views, accessors = square()
    return data, {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_lights_punctual", "EXT_lights_area", "KHR_texture_transform"],
        "scene": 0,
        "scenes": [{"nodes": [0, 3, 4], "extras": {"kilolux": {"exposureEv100": 8}}}],
        "nodes": [
            {"mesh": 0, "children": [1, 2], "scale": [-1, 2, 1], "rotation": [0, 0.6, 0, 0.8]},
            {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 3, 0],
             "extras": {"kilolux": {"type": "tube", "lengthM": 1, "radiusM": 0.02, "unit": "lm", "intensity": 900,
                                    "temperatureK": 3000}}},
            {"extensions": {"EXT_lights_area": {"light": 0}}, "scale": [2, 2, 2]},
            {"camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]},
            {"mesh": 1, "extensions": {"KHR_lights_punctual": {"light": 1}}},
        ],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "meshes": [
            {"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3,
                             "material": 0}]},
            {"primitives": [{"attributes": {"POSITION": 4}, "mode": 5}]},
        ],
        "materials": [{
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {
                "KHR_texture_transform": {"scale": [2, 2], "rotation": 0.3}}}},
            "normalTexture": {"index": 0}, "emissiveFactor": [1, 1, 1], "alphaMode": "MASK"}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"wrapS": 33071}],
        "images": [{"uri": data_uri(PNG, "image/png")}],
        "extensions": {
            "KHR_lights_punctual": {"lights": [
                {"type": "point", "intensity": 50, "range": 4},
                {"type": "spot", "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.4}}]},
            "EXT_lights_area": {"lights": [{"type": "rect", "size": 1, "rect": {"aspect": 2}}]},
        },
        "bufferViews": views, "accessors": accessors,
    }


def animated_scene():
    """The full scene with every path, interpolation and kind of output that an animation may have."""
    data, document = full_scene()
    views, accessors = list(document["bufferViews"]), list(document["accessors"])
    samplers = []

    def add(component, kind, count, part, **more):
        nonlocal data
        data += b"\0" * (-len(data) % 4)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
        data += part
        accessors.append(dict({"bufferView": len(views) - 1, "componentType": component, "type": kind,
                               "count": count}, **more))
        return len(accessors) - 1

    times = add(5126, "SCALAR", 3, struct.pack("<3f", 0, 0.5, 2))
    cubic = [0, 0, 0, 1, 2, 3, 4, 0, 0] * 3
    samplers.append({"input": times, "output": add(5126, "VEC3", 9, struct.pack("<27f", *cubic)),
                     "interpolation": "CUBICSPLINE"})
    turns = [0, 0, 0, 32767, 0, 23170, 0, 23170, 0, -32767, 0, 0]
    samplers.append({"input": times, "output": add(5122, "VEC4", 3, struct.pack("<12h", *turns), normalized=True)})
    samplers.append({"input": times, "output": add(5126, "VEC3", 3, struct.pack("<9f", *[1, 2, 3] * 3)),
                     "interpolation": "STEP"})
    targets = [(0, "translation", 0), (1, "rotation", 1), (2, "scale", 2), (0, "weights", 2), (3, "scale", 2)]
    channels = [{"sampler": s, "target": {"node": node, "path": path}} for node, path, s in targets]
    return data, dict(document, bufferViews=views, accessors=accessors, animations=[
        {"name": "all", "channels": channels, "samplers": samplers},
        {"channels": [{"sampler": 0, "target": {"node": 4, "path": "scale"}}], "samplers": samplers}])


def binary(document, data):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def main():
    os.makedirs(FOLDER, exist_ok=True)
    data, scene = full_scene()
    files = {"full.glb": binary(dict(scene, buffers=[{"byteLength": len(data)}]), data)}
    embedded = dict(scene, buffers=[{"byteLength": len(data), "uri": data_uri(data)}])
    files["full.gltf"] = json.dumps(embedded).encode()
    data, scene = animated_scene()
    files["animated.glb"] = binary(dict(scene, buffers=[{"byteLength": len(data)}]), data)
    embedded = dict(scene, buffers=[{"byteLength": len(data), "uri": data_uri(data)}])
    files["animated.gltf"] = json.dumps(embedded).encode()
    files["empty.gltf"] = b'{"asset":{"version":"2.0"}}'
    files["cycle.gltf"] = b'{"asset":{"version":"2.0"},"nodes":[{"children":[1]},{"children":[0]}]}'
    files["huge_count.gltf"] = (b'{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":'
                                b'{"POSITION":0}}]}],"accessors":[{"componentType":5126,"type":"VEC3",'
                                b'"count":2147483647}]}')
    files["escape.gltf"] = b'{"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"%2e%2e/x.bin"}]}'
    files["deep.gltf"] = b"[" * 200
    for name, content in files.items():
        with open(os.path.join(FOLDER, name), "wb") as file:
            file.write(content)


if __name__ == "__main__":
    main()
