"""Scene graph and .glb writer (glTF 2.0 with KHR_lights_punctual, EXT_lights_area and
KHR_materials_emissive_strength). Models become meshes once and are shared by all nodes that show them; light
definitions, images and identical materials are shared as well."""
import json
import math
import struct
from dataclasses import dataclass

import numpy as np

from . import png
from .mesh import merge, tangents
from .transform import to_trs

GENERATOR = "Kilolux content/make"


class Node:
    def __init__(self, name, parent, matrix):
        self.name, self.parent, self.matrix = name, parent, matrix
        self.model = self.light = self.camera = None
        self.channels = None  # of its mesh, bits; None: those that every light reaches
        self.children = []

    def world(self):
        return self.matrix if self.parent is None else self.parent.world() @ self.matrix


@dataclass(eq=False)
class Channel:
    """Keys of one property of one node. Values: translations, unit quaternions (x, y, z, w) or scales, one a
    key; for CUBICSPLINE (tangent in, value, tangent out) a key, tangents per second."""
    node: Node
    path: str  # translation, rotation, scale
    times_s: list
    values: list
    interpolation: str = "LINEAR"  # LINEAR, STEP, CUBICSPLINE


class Scene:
    def __init__(self, name, exposure_ev100):
        self.name, self.exposure_ev100 = name, exposure_ev100
        self.nodes = []
        self.animations = []  # (name, [Channel])

    def node(self, name, parent=None, matrix=None, model=None, light=None, channels=None):
        n = Node(name, parent, np.eye(4) if matrix is None else matrix)
        n.model, n.light, n.channels = model, light, channels
        self.nodes.append(n)
        if parent is not None:
            parent.children.append(n)
        return n

    def camera(self, name, matrix, yfov_rad, aspect=16 / 9, znear_m=0.05):
        n = self.node(name, None, matrix)
        n.camera = {"name": name, "type": "perspective",
                    "perspective": {"yfov": round(yfov_rad, 6), "aspectRatio": round(aspect, 6),
                                    "znear": znear_m}}
        return n

    def lights(self):
        """(light, world matrix) of every light node, in file order."""
        return [(n.light, n.world()) for n in self.nodes if n.light is not None]

    def triangle_count(self):
        return sum(n.model.triangle_count() for n in self.nodes if n.model is not None)

    def save(self, path):
        data = _Writer(self).glb()
        with open(path, "wb") as f:
            f.write(data)
        return len(data)


def _clean(values, digits):
    """Rounded JSON numbers; negative zero and integers lose their tails."""
    out = [round(float(v), digits) + 0.0 for v in values]
    return [int(v) if v == int(v) else v for v in out]


class _Writer:
    def __init__(self, scene):
        self.scene = scene
        self.binary = bytearray()
        self.json = {"asset": {"version": "2.0", "generator": GENERATOR}, "extensionsUsed": [], "scene": 0,
                     "scenes": [], "nodes": [], "cameras": [], "meshes": [], "materials": [], "textures": [],
                     "images": [], "samplers": [], "animations": [], "accessors": [], "bufferViews": [],
                     "buffers": []}
        self.cache = {}
        self.punctual, self.area = [], []

    def view(self, data, target=None):
        self.binary.extend(b"\0" * (-len(self.binary) % 4))
        v = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            v["target"] = target
        self.binary.extend(data)
        self.json["bufferViews"].append(v)
        return len(self.json["bufferViews"]) - 1

    def accessor(self, array, kind, bounds=False, geometry=True):
        """Of vertices or indices; other data has no buffer target."""
        target = (34963 if array.dtype.kind == "u" else 34962) if geometry else None
        component = {"uint16": 5123, "uint32": 5125, "float32": 5126}[array.dtype.name]
        a = {"bufferView": self.view(array.tobytes(), target), "componentType": component,
             "count": len(array), "type": kind}
        if bounds:
            a["min"], a["max"] = [[float(v) for v in f(axis=0)] for f in (array.min, array.max)]
        self.json["accessors"].append(a)
        return len(self.json["accessors"]) - 1

    def texture(self, pixels):
        data = png.encode(pixels)
        if data not in self.cache:
            self.json["images"].append({"bufferView": self.view(data), "mimeType": "image/png"})
            if not self.json["samplers"]:
                self.json["samplers"].append({"magFilter": 9729, "minFilter": 9987, "wrapS": 10497,
                                              "wrapT": 10497})
            self.json["textures"].append({"sampler": 0, "source": len(self.json["images"]) - 1})
            self.cache[data] = len(self.json["textures"]) - 1
        return {"index": self.cache[data]}

    def material(self, m):
        if m in self.cache:
            return self.cache[m]
        pbr = {"baseColorFactor": _clean([*m.color, m.alpha], 5),
               "metallicFactor": _clean([m.metallic], 4)[0], "roughnessFactor": _clean([m.roughness], 4)[0]}
        out = {"name": m.name, "pbrMetallicRoughness": pbr}
        if m.color_map is not None:
            coded = png.srgb_from_linear(m.color_map[..., :3])
            pixels = np.concatenate([coded, m.color_map[..., 3:]], -1)
            pbr["baseColorTexture"] = self.texture(png.to_bytes(pixels))
        if m.roughness_map is not None or m.metallic_map is not None:
            shape = (m.roughness_map if m.roughness_map is not None else m.metallic_map).shape
            g = m.roughness_map if m.roughness_map is not None else np.full(shape, m.roughness)
            b = m.metallic_map if m.metallic_map is not None else np.full(shape, m.metallic)
            # A constant metallic value stays in the factor, so that the channel compresses to nothing.
            pbr["roughnessFactor"] = 1
            pbr["metallicFactor"] = 1 if m.metallic_map is not None else pbr["metallicFactor"]
            b = b if m.metallic_map is not None else np.ones(shape)
            pixels = np.stack([np.ones(shape), np.round(g * 64) / 64, b], -1)
            pbr["metallicRoughnessTexture"] = self.texture(png.to_bytes(pixels))
        if m.normal_map is not None:
            out["normalTexture"] = self.texture(png.to_bytes(m.normal_map * 0.5 + 0.5))
        strength = max(m.emission_nit)
        if strength > 0:
            out["emissiveFactor"] = _clean([e / strength for e in m.emission_nit], 5)
            out["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": round(strength, 4)}}
            self.use("KHR_materials_emissive_strength")
            if m.emission_map is not None:
                out["emissiveTexture"] = self.texture(png.to_bytes(png.srgb_from_linear(m.emission_map)))
        if m.alpha_mode != "OPAQUE":
            out["alphaMode"] = m.alpha_mode
        if m.double_sided:
            out["doubleSided"] = True
        self.json["materials"].append(out)
        self.cache[m] = len(self.json["materials"]) - 1
        return self.cache[m]

    def use(self, extension):
        if extension not in self.json["extensionsUsed"]:
            self.json["extensionsUsed"].append(extension)

    def primitive(self, material, meshes):
        mesh = merge(meshes)
        p = np.round(mesh.positions * 65536)[mesh.triangles]
        area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
        mesh.triangles = mesh.triangles[area > 0]  # slivers that rounding has closed
        mesh.uvs = mesh.uvs / material.tile_m
        # Whole repeats carry no information; near the origin UVs keep their precision.
        mesh.uvs -= np.floor(mesh.uvs.min(axis=0) + 1e-6)
        attributes = {"POSITION": np.round(mesh.positions * 65536) / 65536,
                      "NORMAL": np.round(mesh.normals * 8192) / 8192}
        textured = any(x is not None for x in (material.color_map, material.roughness_map,
                                               material.metallic_map, material.normal_map,
                                               material.emission_map))
        if textured:
            attributes["TEXCOORD_0"] = np.round(mesh.uvs * 16384) / 16384
        if material.normal_map is not None:
            attributes["TANGENT"] = np.round(tangents(mesh) * 8192) / 8192
        out = {"attributes": {}, "material": self.material(material)}
        kinds = {"POSITION": "VEC3", "NORMAL": "VEC3", "TEXCOORD_0": "VEC2", "TANGENT": "VEC4"}
        for key, values in attributes.items():
            array = values.astype("<f4") + np.float32(0)
            out["attributes"][key] = self.accessor(array, kinds[key], key == "POSITION")
        kind = "<u2" if len(mesh.positions) < 65535 else "<u4"
        out["indices"] = self.accessor(mesh.triangles.astype(kind).reshape(-1), "SCALAR")
        return out

    def mesh(self, model):
        if model not in self.cache:
            primitives = [self.primitive(m, parts) for m, parts in model.parts.items()]
            self.json["meshes"].append({"name": model.name, "primitives": primitives})
            self.cache[model] = len(self.json["meshes"]) - 1
        return self.cache[model]

    def light(self, node, out):
        light = node.light
        for key, definition, store in (("KHR_lights_punctual", light.punctual(), self.punctual),
                                       ("EXT_lights_area", light.area(), self.area)):
            if definition is None:
                continue
            if definition not in store:
                store.append(definition)
            self.use(key)
            out.setdefault("extensions", {})[key] = {"light": store.index(definition)}
        extras = light.extras()
        if light.profile is not None:
            extras["iesProfile"] = f"#/bufferViews/{self.shared_view(light.profile.encode())}"
        for key, data in light.pictures:
            extras[key] = f"#/images/{self.light_image(data)}"
        out["extras"] = {"kilolux": extras}

    def shared_view(self, data):
        if data not in self.cache:
            self.cache[data] = self.view(data)
        return self.cache[data]

    def light_image(self, data):
        """An image that only a light refers to: it needs no texture."""
        key = ("light", data)
        if key not in self.cache:
            self.json["images"].append({"bufferView": self.view(data), "mimeType": "image/png"})
            self.cache[key] = len(self.json["images"]) - 1
        return self.cache[key]

    def node(self, node, index):
        out = {"name": node.name}
        if node.children:
            out["children"] = [index[c] for c in node.children]
        t, q, s = to_trs(node.matrix)
        if np.abs(t).max() > 1e-7:
            out["translation"] = _clean(t, 5)
        if abs(q[3]) < 1 - 1e-10:
            q = np.round(q, 7)
            out["rotation"] = _clean(q / math.sqrt(float(np.dot(q, q))), 7)
        if np.abs(s - 1).max() > 1e-6:
            out["scale"] = _clean(s, 5)
        if node.model is not None:
            out["mesh"] = self.mesh(node.model)
        if node.channels is not None:
            out["extras"] = {"kilolux": {"meshChannels": node.channels}}
        if node.camera is not None:
            self.json["cameras"].append(node.camera)
            out["camera"] = len(self.json["cameras"]) - 1
        if node.light is not None:
            self.light(node, out)
        return out

    def keys(self, data, kind, bounds=False):
        """Accessor of animation data, shared where the bytes are the same."""
        array = np.asarray(data, "<f4").reshape(len(data), -1) + np.float32(0)
        key = (kind, array.tobytes())
        if key not in self.cache:
            self.cache[key] = self.accessor(array, kind, bounds, geometry=False)
        return self.cache[key]

    def animation(self, name, channels, index):
        out = {"name": name, "channels": [], "samplers": []}
        for c in channels:
            values = np.round(np.asarray(c.values, float) * 2 ** 20) / 2 ** 20
            values = values.reshape(-1, values.shape[-1])  # a cubic key's three values follow each other
            if c.path == "rotation" and c.interpolation != "CUBICSPLINE":
                values /= np.linalg.norm(values, axis=1, keepdims=True)
            times = self.keys(np.asarray(c.times_s, float)[:, None], "SCALAR", bounds=True)
            kind = "VEC4" if c.path == "rotation" else "VEC3"
            out["samplers"].append({"input": times, "output": self.keys(values, kind),
                                    "interpolation": c.interpolation})
            out["channels"].append({"sampler": len(out["samplers"]) - 1,
                                    "target": {"node": index[c.node], "path": c.path}})
        return out

    def glb(self):
        nodes, j = self.scene.nodes, self.json
        index = {n: i for i, n in enumerate(nodes)}
        j["nodes"] = [self.node(n, index) for n in nodes]
        j["animations"] = [self.animation(name, channels, index) for name, channels in self.scene.animations]
        j["scenes"] = [{"name": self.scene.name,
                        "nodes": [i for i, n in enumerate(nodes) if n.parent is None],
                        "extras": {"kilolux": {"exposureEv100": self.scene.exposure_ev100}}}]
        extensions = {}
        if self.punctual:
            extensions["KHR_lights_punctual"] = {"lights": self.punctual}
        if self.area:
            extensions["EXT_lights_area"] = {"lights": self.area}
        if extensions:
            j["extensions"] = extensions
        self.binary.extend(b"\0" * (-len(self.binary) % 4))
        j["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps({k: v for k, v in j.items() if v != []}, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        body = (struct.pack("<II", len(text), 0x4E4F534A) + text +
                struct.pack("<II", len(self.binary), 0x004E4942) + bytes(self.binary))
        return struct.pack("<III", 0x46546C67, 2, 12 + len(body)) + body
