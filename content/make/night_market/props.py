"""Things between the stalls: tables under parasols, a handcart, potted plants."""
import math

import numpy as np

from kit.mesh import Mesh, Model
from kit.noise import rng
from kit.plants import leaf_mesh
from kit.shapes import bar, bevel_box, cylinder, lathe, oriented, rod, sweep, torus
from kit.transform import rotate_x, rotate_y, rotate_z, translate

from . import materials as M
from .goods import crate, fruit_crate

PARASOL_LAMP_Y = 2.02


def parasol(canvas, radius=1.45, ribs=8):
    """Eight flat panels, a short valance, a pole through the middle."""
    model = Model("parasol")
    positions, normals, uvs, triangles = [], [], [], []
    for k in range(ribs):
        a0, a1 = 2 * math.pi * k / ribs, 2 * math.pi * (k + 1) / ribs
        rings = [(0.0, 2.72), (0.5, 2.55), (1.0, 2.26), (1.005, 2.06)]
        points = [(radius * s * math.cos(a), y, -radius * s * math.sin(a))
                  for s, y in rings for a in (a0, a1)]
        base = len(positions)
        for i in range(3):
            quad = [points[2 * i], points[2 * i + 1], points[2 * i + 3], points[2 * i + 2]]
            n = np.cross(np.subtract(quad[3], quad[1]), np.subtract(quad[2], quad[0]))
            n = n / np.linalg.norm(n)
            outward = np.array([math.cos((a0 + a1) / 2), 1.0, -math.sin((a0 + a1) / 2)])
            n = n if np.dot(n, outward) > 0 else -n
            for q, (u, v) in zip(quad, ((0, i), (1, i), (1, i + 1), (0, i + 1))):
                positions.append(q)
                normals.append(n)
                uvs.append((u * 0.9 + 0.15 * k, v * 0.55))
            triangles += [(base, base + 1, base + 2), (base, base + 2, base + 3)]
            base += 4
    mesh = Mesh(positions, normals, uvs, triangles)
    model.add(canvas, oriented(mesh))
    model.add(M.TIMBER, sweep([(0, 0, 0), (0, 2.8, 0)], 0.024, 8))
    model.add(M.STONE, cylinder(0.28, 0.14, 20, 0.02))
    for k in range(ribs):
        a = 2 * math.pi * k / ribs
        model.add(M.TIMBER, rod((0, 2.66, 0),
                                (0.98 * radius * math.cos(a), 2.24, -0.98 * radius * math.sin(a)), 0.009, 4))
    return model


def table(name, kinds, seed):
    """Trestle table with four tilted crates."""
    model = Model(name)
    model.add(M.TIMBER, bevel_box(2.0, 0.04, 0.8, 0.006), translate(0, 0.72, 0))
    for x in (-0.8, 0.8):
        for s in (-1, 1):
            model.add(M.TIMBER, bar((x, 0, s * 0.34), (x, 0.71, -s * 0.2), 0.05, 0.03, 0.004))
    for k in range(3):
        fruit_crate(model, kinds[k % len(kinds)], translate((k - 1) * 0.62, 0.76, 0.12) @ rotate_x(0.25),
                    seed + k, 1)
    crate(model, translate(0.4, 0, 0.1) @ rotate_y(0.2), 0.55, 0.4, 0.3, seed, 2)
    return model


def handcart(seed=3):
    """Flat bed on two spoked wheels, its handles resting on the ground."""
    model, r = Model("handcart"), rng(seed)
    tilt = translate(0, 0.52, 0) @ rotate_z(-0.10)
    for k in range(6):
        model.add(M.TIMBER, bevel_box(1.7, 0.03, 0.14, 0.004).with_uv_offset(r.random(), r.random()),
                  tilt @ translate(0, 0.03, (k - 2.5) * 0.148))
    for z in (-0.44, 0.44):
        model.add(M.TIMBER, bar((-0.85, 0, z), (1.75, 0, z * 0.75), 0.05, 0.06, 0.006), tilt)
        model.add(M.PAINTED[0], bevel_box(1.6, 0.16, 0.025, 0.004), tilt @ translate(0, 0.13, z))
    for s in (-1, 1):
        hub = translate(-0.1, 0.42, s * 0.56) @ rotate_x(math.pi / 2)
        model.add(M.IRON, torus(0.40, 0.02, 28, 6), hub)
        model.add(M.TIMBER, cylinder(0.06, 0.1, 12, 0.006), hub @ translate(0, -0.05, 0))
        for k in range(8):
            a = 2 * math.pi * k / 8
            model.add(M.TIMBER, rod((0, 0, 0), (0.39 * math.cos(a), 0, 0.39 * math.sin(a)), 0.014, 5), hub)
    model.add(M.IRON, rod((-0.1, 0.42, -0.6), (-0.1, 0.42, 0.6), 0.018, 6))
    model.add(M.TIMBER, bar((-0.7, 0, -0.3), (-0.7, 0.46, -0.3), 0.05, 0.05), translate(0.0, 0, 0.3))
    fruit_crate(model, "aubergine", tilt @ translate(-0.45, 0.05, 0.0) @ rotate_y(math.pi / 2), 31, 1)
    fruit_crate(model, "lemon", tilt @ translate(0.05, 0.05, 0.02) @ rotate_y(math.pi / 2 + 0.1), 32, 1)
    model.add(M.TARPAULIN, bevel_box(0.5, 0.22, 0.6, 0.05), tilt @ translate(0.55, 0.15, 0))
    return model


def potted_shrub(seed=5):
    model, r = Model("shrub"), rng(seed)
    model.add(M.TERRACOTTA, lathe([(0, 0), (0.15, 0), (0.2, 0.30), (0.215, 0.30), (0.215, 0.34), (0.19, 0.34),
                                   (0.18, 0.30),
                                   (0, 0.30)], 18, 40))
    for k in range(44):
        lean, turn = r.uniform(0.1, 1.25), k * 2.39996
        start = translate(0, 0.3 + 0.5 * r.random(), 0)
        leaf = leaf_mesh(r.uniform(0.2, 0.34), r.uniform(0.07, 0.11), droop=r.uniform(0.4, 1.2), across=2,
                         along=4)
        model.add(M.LEAF, leaf, start @ rotate_y(turn) @ rotate_x(-lean) @ translate(0, 0, 0.03))
    return model
