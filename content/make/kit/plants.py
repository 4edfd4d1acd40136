"""Potted plants from solid leaves: a fiddle-leaf fig and an arching palm-like one."""
import math

import numpy as np

from .mesh import Model
from .noise import rng
from .shapes import lathe, surface, sweep
from .transform import rotate_x, rotate_y, rotate_z, translate


def leaf_mesh(length, width, fold=0.25, droop=0.5, ripple=0.0, across=4, along=8, blunt=1.0, phase=0.0):
    """A leaf that grows from the origin along +Z, its top to +Y; UV 0..1."""
    t = np.linspace(0, 1, along + 1)[None, :]
    s = np.linspace(-1, 1, across + 1)[:, None]
    outline = np.sin(np.pi * np.clip(t, 0, 1) ** blunt) ** 0.75
    outline = np.maximum(outline, 0.04)
    half = width / 2 * outline
    angle = droop * t ** 1.3
    # The midrib bends down along an arc; the blade folds up from it and its rim waves.
    y = -length * np.cumsum(np.sin(angle), axis=1) / (along + 1)
    z = length * np.cumsum(np.cos(angle), axis=1) / (along + 1)
    z = z - z[:, :1]
    lift = np.abs(s) * half * fold + ripple * half * np.sin(9 * t + phase + s) * np.abs(s)
    points = np.stack(np.broadcast_arrays(s * half, y - y[:, :1] + lift, z), -1)
    uv = np.stack(np.broadcast_arrays(s * 0.5 * outline + 0.5, 1 - t), -1)
    return surface(points, uv, swap=True)


def pot(model, material, soil_material, radius, height):
    r = radius
    profile = [(0, 0), (r * 0.72, 0), (r * 0.76, 0.006), (r * 0.97, height * 0.97), (r, height * 0.985),
               (r, height),
               (r - 0.012, height), (r - 0.018, height - 0.008), (r * 0.9, height * 0.86)]
    model.add(material, lathe(profile, 40, 40))
    model.add(soil_material, lathe([(r * 0.905, height * 0.87), (0, height * 0.90)], 24))


def fig(name, leaf_material, bark, pot_material, soil_material, height=1.7, leaves=54, seed=5):
    model, r = Model(name), rng(seed)
    pot(model, pot_material, soil_material, 0.2, 0.36)
    for branch in range(3):
        turn = branch * 2.1 + r.uniform(-0.3, 0.3)
        lean = r.uniform(0.10, 0.26)
        top = height * (1.0 - 0.14 * branch)
        t = np.linspace(0, 1, 9)
        path = np.stack([np.cos(turn) * lean * t ** 1.5 + 0.02 * np.sin(6 * t + branch),
                         0.28 + (top - 0.28) * t,
                         np.sin(turn) * lean * t ** 1.5 + 0.02 * np.cos(5 * t + branch)], -1)
        path[0, :] = (0.03 * math.cos(turn), 0.28, 0.03 * math.sin(turn))
        model.add(bark, sweep(path, np.linspace(0.016, 0.006, 9), 7))
        for k in range(leaves // 3):
            f = 0.30 + 0.70 * (k + 0.5) / (leaves // 3)
            p = np.array([np.interp(f, t, path[:, a]) for a in range(3)])
            size = r.uniform(0.75, 1.1) * (1.12 - 0.35 * f)
            mesh = leaf_mesh(0.27 * size, 0.17 * size, 0.22, r.uniform(0.5, 1.2), 0.25, blunt=1.35,
                             phase=r.uniform(0, 6))
            pitch = -r.uniform(0.1, 0.6) - 0.5 * f ** 4
            m = (translate(*p) @ rotate_y(k * 2.39996 + turn) @ rotate_x(pitch) @
                 rotate_z(r.uniform(-0.3, 0.3)) @ translate(0, 0, 0.012))
            model.add(leaf_material, mesh, m)
    return model


def palm(name, leaf_material, pot_material, soil_material, height=1.5, stems=13, seed=9):
    """Long stalks that arch out, each with a broad paddle."""
    model, r = Model(name), rng(seed)
    pot(model, pot_material, soil_material, 0.22, 0.42)
    stalk = leaf_material
    for k in range(stems):
        turn = k * 2.39996 + r.uniform(-0.2, 0.2)
        inner = k / stems
        rise, reach = height * (0.98 - 0.45 * inner) - 0.4, 0.16 + 0.42 * inner
        t = np.linspace(0, 1, 8)
        out = reach * t ** 1.8
        path = np.stack([np.cos(turn) * (0.03 + out), 0.37 + rise * np.sin(t * 1.35) / math.sin(1.35),
                         -np.sin(turn) * (0.03 + out)], -1)
        tube = sweep(path, np.linspace(0.011, 0.005, 8), 6)
        tube.uvs[:] = (0.5, 0.5)
        model.add(stalk, tube)
        size = r.uniform(0.8, 1.1)
        blade = leaf_mesh(0.55 * size, 0.19 * size, 0.5, r.uniform(0.7, 1.3), 0.12, along=12,
                          phase=r.uniform(0, 6))
        pitch = -0.75 + 0.5 * inner
        m = (translate(*path[-1]) @ rotate_y(turn + math.pi / 2) @ rotate_x(pitch) @
             rotate_z(r.uniform(-0.25, 0.25)))
        model.add(leaf_material, blade, m)
    return model
