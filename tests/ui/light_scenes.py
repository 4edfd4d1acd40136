"""Small scenes for the window's tests: a floor, a camera, and lights of every type or very many."""
import base64
import json
import struct


def _floor():
    positions = struct.pack("<12f", -5, 0, -5, 5, 0, -5, 5, 0, 5, -5, 0, 5)
    indices = struct.pack("<6H", 0, 2, 1, 0, 3, 2)
    uri = "data:application/octet-stream;base64," + base64.b64encode(positions + indices).decode()
    return {
        "buffers": [{"uri": uri, "byteLength": 60}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-5, 0, -5], "max": [5, 0, 5]},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    }


# From the right and above, so that all three axes of the world can be told apart.
ASIDE = ([3, 2.6, 4], [-0.14631860, 0.31244393, 0.04877287, 0.93733178])
AFAR = ([0, 2.5, 12], [-0.05, 0, 0, 0.99875])


def _write(path, lights, nodes, eye=ASIDE, extras=None):
    document = {"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"], "scene": 0, **_floor()}
    document["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    document["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.05}}]
    head = [{"name": "Floor", "mesh": 0}, {"name": "Eye", "camera": 0, "translation": eye[0], "rotation": eye[1]}]
    document["nodes"] = head + nodes
    document["scenes"] = [{"nodes": list(range(len(head) + len(nodes)))}]
    if extras:
        document["scenes"][0]["extras"] = {"kilolux": extras}
    with open(path, "w") as file:
        json.dump(document, file, indent=2)
    return path


def _node(light, name, translation, rotation=None):
    node = {"name": name, "translation": translation,
            "extensions": {"KHR_lights_punctual": {"light": light}}}
    if rotation:
        node["rotation"] = rotation
    return node


DOWN = [-0.7071067811865476, 0, 0, 0.7071067811865476]


def every_type(path):
    """Lights 1 to 7; 3 and 4 share a definition."""
    def ours(properties):
        return {"kilolux": properties}
    lights = [
        {"type": "directional", "intensity": 3, "name": "sun"},
        {"type": "point", "intensity": 40, "color": [1, 0.8, 0.5]},
        {"type": "spot", "intensity": 80, "spot": {"innerConeAngle": 0.3, "outerConeAngle": 0.6}},
        {"type": "point", "intensity": 20},
        {"type": "point", "intensity": 20, "color": [0.4, 0.6, 1]},
        {"type": "point", "intensity": 20},
    ]
    nodes = [
        _node(0, "Sun", [-2.2, 2.4, 0], [-0.5, 0, 0, 0.8660254037844386]),
        _node(1, "Bulb", [0, 1.5, 0]),
        _node(2, "Spot left", [-1.5, 1.8, 0], DOWN),
        _node(2, "Spot right", [1.5, 1.8, 0], DOWN),
        _node(3, "Tube", [-1.2, 0.6, 1]),
        _node(4, "Window", [1.2, 0.7, 1]),
        _node(5, "Ring", [0, 0.5, 1.5]),
    ]
    nodes[4]["extras"] = ours({"type": "tube", "radiusM": 0.03, "lengthM": 0.8, "group": "Key"})
    nodes[5]["extras"] = ours({"type": "rect", "widthM": 0.6, "heightM": 0.4})
    nodes[6]["extras"] = ours({"type": "disk", "widthM": 0.3})
    return _write(path, lights, nodes, extras={"groups": [{"name": "Key"}], "exposureEv100": 3})


def shaped(path):
    """Lights 1 to 5 at one place, each with every handle that its type has."""
    place = [0, 0.9, 0]
    lights = [
        {"type": "point", "intensity": 40, "range": 1.0},
        {"type": "spot", "intensity": 80, "range": 1.5, "spot": {"innerConeAngle": 0.3, "outerConeAngle": 0.6}},
        {"type": "point", "intensity": 20},
        {"type": "point", "intensity": 20},
        {"type": "point", "intensity": 20},
    ]
    names = ["Bulb", "Spot", "Tube", "Window", "Ring"]
    nodes = [_node(i, name, place) for i, name in enumerate(names)]
    own = [{"radiusM": 0.1}, {"radiusM": 0.05}, {"type": "tube", "radiusM": 0.05, "lengthM": 0.8},
           {"type": "rect", "widthM": 0.8, "heightM": 0.6, "barnDoorAngleRad": 0.7, "barnDoorLengthM": 0.3},
           {"type": "disk", "widthM": 0.5}]
    for node, properties in zip(nodes, own):
        node["extras"] = {"kilolux": properties}
    return _write(path, lights, nodes, extras={"exposureEv100": 3})


def crowd(path, count):
    """Lights of three types in a block before the camera; many share a definition."""
    lights = [{"type": "point", "intensity": 1 + i % 7, "range": 0.4, "color": [1, 0.5 + i % 6 / 10, 0.4]}
              for i in range(40)]
    lights += [{"type": "spot", "intensity": 2, "range": 0.4, "spot": {"outerConeAngle": 0.5}} for _ in range(10)]
    nodes = []
    for i in range(count):
        x, y, z = i % 40, i // 40 % 10, i // 400
        nodes.append(_node(i % len(lights), f"Light {i}", [x * 0.2 - 3.9, 0.2 + y * 0.25, 1 - z * 0.2]))
    return _write(path, lights, nodes, AFAR)
