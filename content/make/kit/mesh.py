"""Triangle meshes and models. A mesh has positions, unit normals and UVs in metres (the material divides by
the size that its textures cover); triangles wind counter-clockwise seen from outside. A model is a set of
meshes grouped by material: one glTF mesh with a primitive for each material."""
import numpy as np


class Mesh:
    def __init__(self, positions, normals, uvs, triangles):
        self.positions = np.asarray(positions, float).reshape(-1, 3)
        self.normals = np.asarray(normals, float).reshape(-1, 3)
        self.uvs = np.asarray(uvs, float).reshape(-1, 2)
        self.triangles = np.asarray(triangles, np.int64).reshape(-1, 3)

    def at(self, matrix):
        """A transformed copy; mirrors turn the winding over."""
        linear = matrix[:3, :3]
        normals = self.normals @ np.linalg.inv(linear)
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        triangles = self.triangles[:, ::-1] if np.linalg.det(linear) < 0 else self.triangles
        return Mesh(self.positions @ linear.T + matrix[:3, 3], normals / np.maximum(length, 1e-12), self.uvs,
                    triangles)

    def with_uv_offset(self, u, v):
        return Mesh(self.positions, self.normals, self.uvs + (u, v), self.triangles)

    def flipped(self):
        return Mesh(self.positions, -self.normals, self.uvs, self.triangles[:, ::-1])


def merge(meshes):
    offsets = np.cumsum([0] + [len(m.positions) for m in meshes[:-1]])
    return Mesh(np.concatenate([m.positions for m in meshes]), np.concatenate([m.normals for m in meshes]),
                np.concatenate([m.uvs for m in meshes]),
                np.concatenate([m.triangles + o for m, o in zip(meshes, offsets)]))


class Model:
    """Meshes by material, in the order of their first use."""

    def __init__(self, name):
        self.name = name
        self.parts = {}

    def add(self, material, mesh, matrix=None):
        self.parts.setdefault(material, []).append(mesh if matrix is None else mesh.at(matrix))
        return self

    def include(self, other, matrix):
        for material, meshes in other.parts.items():
            for mesh in meshes:
                self.add(material, mesh, matrix)
        return self

    def triangle_count(self):
        return sum(len(m.triangles) for meshes in self.parts.values() for m in meshes)


def tangents(mesh):
    """Per-vertex tangents (xyz, handedness) from the UV gradients, weighted by area."""
    p, uv, tri = mesh.positions, mesh.uvs, mesh.triangles
    e1, e2 = p[tri[:, 1]] - p[tri[:, 0]], p[tri[:, 2]] - p[tri[:, 0]]
    d1, d2 = uv[tri[:, 1]] - uv[tri[:, 0]], uv[tri[:, 2]] - uv[tri[:, 0]]
    det = d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0]
    sign = np.where(det < 0, -1.0, 1.0)
    area = np.linalg.norm(np.cross(e1, e2), axis=1)
    direction_u = (e1 * d2[:, 1:2] - e2 * d1[:, 1:2]) * sign[:, None]
    direction_v = (e2 * d1[:, 0:1] - e1 * d2[:, 0:1]) * sign[:, None]
    scale_u = area / np.maximum(np.linalg.norm(direction_u, axis=1), 1e-20)
    scale_v = area / np.maximum(np.linalg.norm(direction_v, axis=1), 1e-20)
    t, b = np.zeros_like(p), np.zeros_like(p)
    for corner in range(3):
        np.add.at(t, tri[:, corner], direction_u * scale_u[:, None])
        np.add.at(b, tri[:, corner], direction_v * scale_v[:, None])
    n = mesh.normals
    t -= n * np.sum(n * t, axis=1, keepdims=True)
    length = np.linalg.norm(t, axis=1)
    # Vertices without a usable UV gradient (poles) get any direction in the surface.
    helper = np.where(np.abs(n[:, 1:2]) < 0.9, np.array([[0.0, 1.0, 0.0]]), np.array([[1.0, 0.0, 0.0]]))
    t = np.where((length > 1e-9)[:, None], t, np.cross(helper, n))
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    # glTF's V runs down the image, as the UVs here do: bitangent = cross(n, t) * w points along +V.
    w = np.where(np.sum(np.cross(n, t) * b, axis=1) < 0, -1.0, 1.0)
    return np.concatenate([t, w[:, None]], axis=1)
