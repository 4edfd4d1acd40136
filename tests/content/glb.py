"""A .glb file read back: its JSON, accessors as arrays, nodes with their world matrices."""
import json
import struct

import numpy as np

COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
TYPES = {5123: "<u2", 5125: "<u4", 5126: "<f4"}


class Glb:
    def __init__(self, path):
        self.data = open(path, "rb").read()
        length = struct.unpack_from("<I", self.data, 12)[0]
        self.json = json.loads(self.data[20:20 + length])
        self.binary = self.data[20 + length + 8:]

    def accessor(self, index):
        a = self.json["accessors"][index]
        offset = self.json["bufferViews"][a["bufferView"]].get("byteOffset", 0) + a.get("byteOffset", 0)
        width = COMPONENTS[a["type"]]
        return np.frombuffer(self.binary, TYPES[a["componentType"]], a["count"] * width, offset).reshape(-1,
            width)

    def world_nodes(self):
        """(node, world matrix) of all nodes of the scene."""
        def visit(index, parent):
            node = self.json["nodes"][index]
            x, y, z, w = node.get("rotation", (0, 0, 0, 1))
            r = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                          [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                          [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
            m = np.eye(4)
            m[:3, :3] = r * node.get("scale", (1, 1, 1))
            m[:3, 3] = node.get("translation", (0, 0, 0))
            m = parent @ m
            yield node, m
            for child in node.get("children", ()):
                yield from visit(child, m)
        for root in self.json["scenes"][0]["nodes"]:
            yield from visit(root, np.eye(4))
