"""What the stalls stand in: wet ground, house fronts with windows, poles and cables, gates, the night sky."""
import math

import numpy as np

from kit.material import Material
from kit.mesh import Model
from kit.noise import rng
from kit.shapes import bar, bevel_box, cylinder, lathe, quad, rod, sweep
from kit.transform import rotate_x, rotate_y, rotate_z, translate

from . import materials as M


def ground():
    model = Model("ground")
    model.add(M.ASPHALT, quad(64, 84, divisions=24), translate(0, 0, -26) @ rotate_x(-math.pi / 2))
    return model


def gutter(length, seed):
    """Line of stone slabs down a lane, from z = 0 to -length; the middle one of three carries the water."""
    model, r = Model("gutter"), rng(seed)
    z = 0.0
    while z > -length:
        run = r.uniform(0.5, 0.8)
        slab = bevel_box(0.42, 0.1, run - 0.008, 0.008).with_uv_offset(r.random() * 2, r.random() * 2)
        model.add(M.STONE, slab, translate(r.uniform(-0.006, 0.006), -0.042 + r.uniform(-0.004, 0.004),
                                           z - run / 2))
        z -= run
    return model


def window_model(name, pane):
    """1.0 x 1.3 m opening with its frame, sill and pane; faces +Z from z = 0."""
    model = Model(name)
    for x in (-0.5, 0.0, 0.5):
        model.add(M.TIMBER, quad(0.06, 1.3), translate(x, 0, 0.045))
    for y in (-0.62, 0.12, 0.62):
        model.add(M.TIMBER, quad(1.06, 0.06), translate(0, y, 0.04))
    model.add(M.STONE, bevel_box(1.3, 0.09, 0.22, 0.008), translate(0, -0.70, 0.08))
    model.add(pane, quad(1.0, 1.26, unit_uv=True), translate(0, 0, 0.012))
    return model


def curtained_pane(name, tint, nit, seed):
    """A lit room behind a drawn curtain: folds, brighter towards the lamp."""
    r = rng(seed)
    x, y = np.meshgrid(np.linspace(0, 1, 64), np.linspace(0, 1, 64))
    folds = 0.75 + 0.25 * np.sin(x * r.uniform(28, 44) + np.sin(y * 4) + r.uniform(0, 6))
    lamp = np.exp(-((x - r.uniform(0.3, 0.7)) ** 2 + (y - 0.35) ** 2) * 3.5)
    gap = np.where(np.abs(x - 0.5) < 0.05, 0.35, 1.0)
    picture = (folds * (0.25 + 0.75 * lamp) * gap)[..., None] * np.asarray(tint)
    return Material(name, (0.03, 0.03, 0.03), 0.3, emission_nit=(nit,) * 3, emission_map=picture)


class Houses:
    """Fronts 6 to 9 m wide with rows of windows; windows are shared models placed as nodes."""

    def __init__(self, scene, parent):
        self.scene, self.parent = scene, parent
        self.windows = [window_model("window dark", M.DARK_GLASS)] * 3 + [
            window_model("window amber", curtained_pane("amber curtain", (1.0, 0.55, 0.22), 20.0, 1)),
            window_model("window gold", curtained_pane("gold curtain", (1.0, 0.70, 0.36), 14.0, 2)),
            window_model("window green", curtained_pane("green curtain", (0.55, 0.85, 0.55), 7.0, 3))]
        unit = Model("air conditioner")
        unit.add(M.STEEL, bevel_box(0.8, 0.55, 0.3, 0.012), translate(0, 0, 0.2))
        unit.add(M.IRON, cylinder(0.21, 0.02, 12, 0.004), translate(-0.12, 0, 0.35) @ rotate_x(math.pi / 2))
        unit.add(M.IRON, bevel_box(0.7, 0.03, 0.3, 0.003), translate(0, -0.3, 0.16))
        self.unit = unit

    def add(self, name, place, width, height, seed):
        """House front in the plane z = 0 of `place`, centred on x, facing +Z."""
        r = rng(seed)
        wall = M.BRICK if r.random() < 0.6 else M.RENDER
        model = Model(name)
        model.add(wall, bevel_box(width, height, 4.0, 0.01).with_uv_offset(r.random(), r.random()),
                  translate(0, height / 2, -2.0))
        model.add(M.STONE, bevel_box(width + 0.1, 0.22, 0.35, 0.012), translate(0, height - 0.05, 0.02))
        model.add(M.STONE, bevel_box(width + 0.04, 0.14, 0.16, 0.01), translate(0, 3.25, 0.03))
        for x in (-width / 2 + 0.25,):
            model.add(M.IRON, rod((x, 0, 0.1), (x, height, 0.1), 0.05, 8))
        shutter = bevel_box(width * 0.55, 2.5, 0.1, 0.006)
        model.add(M.STEEL, shutter, translate(0.2, 1.25, 0.02))
        for k in range(16):
            model.add(M.STEEL, bevel_box(width * 0.55, 0.05, 0.03, 0.008),
                      translate(0.2, 0.1 + 0.155 * k, 0.08))
        node = self.scene.node(name, self.parent, place, model)
        columns = max(2, int(width / 2.0))
        for row in range(int((height - 3.4) / 2.3)):
            for column in range(columns):
                x, y = (column - (columns - 1) / 2) * width / columns * 0.92, 4.55 + 2.3 * row
                choice = self.windows[int(r.integers(0, len(self.windows)))]
                self.scene.node("window", node, translate(x, y, 0.0), choice)
                if r.random() < 0.18:
                    self.scene.node("air conditioner", node, translate(x + 0.1, y - 1.15, 0), self.unit)
        return node


def poles(points, height):
    model = Model("poles")
    for x, z in points:
        model.add(M.IRON, sweep([(x, 0, z), (x, height, z)], [0.045, 0.032], 6))
        model.add(M.IRON, lathe([(0.05, 0), (0.04, 0.05), (0, 0.07)], 6), translate(x, height, z))
        model.add(M.STONE, cylinder(0.14, 0.12, 8, 0.015, False), translate(x, 0, z))
    return model


def hang(start, end, sag, count):
    """Points of a cable between two ends that sags by a parabola."""
    t = np.linspace(0, 1, count)
    p = np.outer(1 - t, start) + np.outer(t, end)
    p[:, 1] -= sag * 4 * t * (1 - t)
    return p


def cables(lines):
    model = Model("cables")
    for start, end, sag in lines:
        model.add(M.CABLE, sweep(hang(start, end, sag, 13), 0.007, 4, caps=False))
    return model


def gate(name):
    """Timber gate over the lane: two posts, two beams, a shallow roof, a round board in the middle."""
    model = Model(name)
    for x in (-1.78, 1.78):
        model.add(M.PAINTED[0], bevel_box(0.20, 5.2, 0.20, 0.012), translate(x, 2.6, 0))
        model.add(M.STONE, bevel_box(0.36, 0.5, 0.36, 0.02), translate(x, 0.25, 0))
    for y, reach in ((4.45, 2.1), (5.1, 2.5)):
        model.add(M.PAINTED[0], bar((-reach, y, 0), (reach, y, 0), 0.16, 0.2, 0.012))
    for side in (-1, 1):
        roof = bevel_box(5.6, 0.05, 0.62, 0.01)
        model.add(M.PAINTED[1], roof, translate(0, 5.42, side * 0.24) @ rotate_x(side * 0.5))
    model.add(M.IRON, cylinder(0.62, 0.08, 40, 0.01), translate(0, 4.78, 0.10) @ rotate_x(math.pi / 2))
    return model


def tea_house(light):
    """Lit shop front that closes the main lane: paper screens between posts, a step, an eave. Faces +Z."""
    model = Model("tea house")
    size = 128
    x, y = np.meshgrid((np.arange(size) + 0.5) / size, (np.arange(size) + 0.5) / size)
    bars = np.minimum(np.abs((x * 8) % 1 - 0.5), np.abs((y * 5) % 1 - 0.5))
    glow = 0.45 + 0.55 * np.exp(-((x - 0.5) ** 2 * 3 + (y - 0.55) ** 2 * 2))
    picture = np.where(bars > 0.04, glow, 0.05)[..., None] * np.asarray(light.rgb() / max(light.rgb()))
    mean = float(picture.mean(axis=(0, 1)).max())
    face = Material("paper screens", (0.05, 0.05, 0.05), 0.7,
                    emission_nit=(max(light.face_nit()) / mean,) * 3,
                    emission_map=picture)
    w, h = light.width_m, light.height_m
    model.add(face, quad(w, h, unit_uv=True), translate(0, 0.35 + h / 2, 0))
    for k in range(5):
        model.add(M.TIMBER, bevel_box(0.14, h + 0.3, 0.16, 0.01),
                  translate((k - 2) * w / 4, 0.35 + h / 2, 0.0))
    model.add(M.TIMBER, bevel_box(w + 0.6, 0.22, 0.3, 0.015), translate(0, 0.45 + h, 0.05))
    model.add(M.STONE, bevel_box(w + 1.2, 0.34, 0.9, 0.02), translate(0, 0.17, 0.2))
    model.add(M.PAINTED[1], bevel_box(w + 1.4, 0.06, 1.3, 0.015),
              translate(0, 0.80 + h, 0.5) @ rotate_x(0.35))
    return model


# (x, y, turn about Z, length, colour) of the gate's tubes, in the plane z = 0.2.
def gate_tubes():
    tubes = []
    for side in (-1, 1):
        for k in range(3):
            tubes.append((side * 1.78, 1.05 + 1.15 * k, math.pi / 2, 0.95, "pink" if k % 2 == 0 else "cyan"))
        for k in range(2):
            tubes.append((side * (0.95 + 0.02 * k), 4.45 + 0.65 * k, 0.0, 0.95, "cyan" if k == 0 else "pink"))
        tubes.append((side * 1.95, 4.78, side * 0.9, 0.5, "gold"))
    for k in range(10):
        a = 2 * math.pi * (k + 0.5) / 10
        tubes.append((0.40 * math.cos(a), 4.78 + 0.40 * math.sin(a), a, 0.26, "gold"))
    return tubes


def night_sky(nit=2.0):
    """Card far behind the houses: blue that is deeper above, a town's glow below."""
    size = 128
    y = np.linspace(1, 0, size)[:, None, None]
    picture = np.exp(-y * 2.2) * np.array([0.16, 0.30, 0.75])
    picture = picture + np.exp(-y * 9) * np.array([0.30, 0.155, 0.12])
    picture = np.broadcast_to(picture, (size, 8, 3))
    face = Material("night sky", (0, 0, 0), 1.0, emission_nit=(nit,) * 3, emission_map=np.clip(picture, 0, 1))
    model = Model("night sky")
    for k in range(-4, 5):
        a = k * 0.19
        panel = quad(20.5, 42, unit_uv=True)
        model.add(face, panel, rotate_y(-a) @ translate(0, 19, -106))
    return model


def turned(x, y, z, turn):
    return translate(x, y, z) @ rotate_z(turn)
