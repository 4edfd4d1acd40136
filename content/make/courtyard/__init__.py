"""A court in the last sun of the day: its light comes low over the wall, through a linden, into an arcade; behind that a room
that has no opening but one doorway, with lamps of its own."""
import math

import numpy as np

from kit.gltf import Scene
from kit.material import Material
from kit.mesh import Model
from kit.noise import smoothstep
from kit.plants import fig
from kit.shapes import oriented, surface
from kit.transform import look_at, rotate_y, scale, translate

from . import building as B
from . import foliage, furnish
from . import materials as M

TO_SUN = (0.47, 0.405, 0.80)  # through the second bay from the right onto the doorway


def build_shell(scene):
    group = scene.node("building")
    for model in (B.court(), B.upper_wall(), B.arcade_ceiling(), B.room(), B.doorway(), B.tiles()):
        scene.node(model.name, group, model=model)
    column, arch = B.column(), B.arch()
    for k in range(B.BAYS + 1):
        scene.node("column", group, translate(-B.HALF + B.BAY_M * k, B.STEP_Y, 0) @ rotate_y(0.7 * k), column)
    for k in range(B.BAYS):
        scene.node("arch", group, translate(-B.HALF + B.BAY_M * (k + 0.5), 0, 0), arch)
    B.flags(scene, scene.node("flags"))


def plant(scene):
    group = scene.node("plants")
    tree = foliage.linden()
    scene.node("linden", group, translate(4.3, 0, 5.0) @ rotate_y(0.4), tree)
    scene.node("linden outside", group, translate(14.6, 0, 11.4) @ rotate_y(2.5) @ scale(1.8), tree)
    scene.node("linden behind", group, translate(9.4, 0, -1.6) @ rotate_y(4.1) @ scale(1.25), tree)
    ring = foliage.herbs("tub", M.LAVENDER, 0.26, 60, 0.4, 71)
    for x, z, turn in ((-5.4, 1.0, 0.0), (-1.55, 0.85, 1.7), (1.75, 0.95, 3.1), (5.4, 1.2, 4.0)):
        scene.node("lavender", group, translate(x, 0, z) @ rotate_y(turn), ring)
    scene.node("fig", group, translate(-5.3, 0, 6.3) @ rotate_y(0.5),
               fig("fig", M.FIG_LEAF, M.BARK, M.TERRACOTTA, M.SOIL, 1.9, 66))
    scene.node("ivy left", group, translate(-B.HALF, 0, 4.3) @ rotate_y(math.pi / 2), foliage.ivy("ivy", 4.6, 3.6, 620, 81))
    scene.node("ivy arcade", group, translate(5.3, 0.0, 0.21), foliage.ivy("ivy at the pier", 1.5, 4.6, 300, 83))


def sky(scene):
    """What is seen of the evening sky: a ring, low where the sun shines over it."""
    radius, top = 60.0, 52.0
    size = 64
    y = np.linspace(1, 0, size)[:, None, None] * np.ones((1, 4, 1))
    colors = np.array([0.95, 0.62, 0.36]) * np.exp(-y * 5) + np.array([0.20, 0.36, 0.62]) * smoothstep(-0.2, 1.0, y)
    face = Material("evening sky", (0, 0, 0), 1.0, emission_nit=(120.0,) * 3,
                    emission_map=np.round(np.clip(colors, 0, 1) * 128) / 128)
    angle = np.radians(np.arange(0, 361, 5))
    away = np.abs((np.degrees(angle - math.atan2(TO_SUN[0], TO_SUN[2])) + 180) % 360 - 180)
    height = np.stack([np.full_like(angle, -0.5), 14 + (top - 14) * smoothstep(25, 60, away)], -1)
    x, z = np.sin(angle)[:, None] * np.ones(2), np.cos(angle)[:, None] * np.ones(2)
    points = np.stack([radius * x, height, radius * z], -1)
    uv = np.stack([0.5 * np.ones_like(x), 1 - np.clip(height / top, 0.01, 0.99)], -1)
    ring = oriented(surface(points, uv, normals=np.stack([-x, np.zeros_like(x), -z], -1)))
    scene.node("sky", model=Model("sky").add(face, ring))


def build():
    scene = Scene("courtyard", 6.0)
    build_shell(scene)
    plant(scene)
    things = scene.node("things")
    scene.node("basin", things, translate(-0.6, 0, 4.4), furnish.basin())
    scene.node("bench", things, translate(-5.45, 0, 4.2) @ rotate_y(math.pi / 2), furnish.bench())
    furnish.arcade(scene)
    furnish.indoors(scene)
    sky(scene)
    target = np.array([0.1, 1.0, -3.2])
    scene.node("low sun", matrix=look_at(target + 30 * np.array(TO_SUN), target), light=furnish.SUN)
    scene.node("sky light", matrix=look_at((1.0, 40.0, 14.0), (0, 0, 0), up=(0, 0, 1)), light=furnish.SKY)
    scene.camera("wide", look_at((-4.9, 1.65, 8.5), (1.75, 1.95, -0.6)), math.radians(50))
    scene.camera("room", look_at((-2.4, 1.55, -7.0), (0.55, 1.2, -2.6)), math.radians(52))
    scene.camera("close", look_at((3.7, 1.5, 3.3), (0.1, 1.4, -2.4)), math.radians(40))
    return scene
