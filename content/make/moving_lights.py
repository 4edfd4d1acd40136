"""A hall with 240 bulbs that all move, each on a closed way of its own, a loop of 4 s: nothing about a light holds for the
next frame but which one it is. Cameras `wide` and `low` stand still."""
import math

from kit.gltf import Scene
from kit.lights import Light
from kit.mesh import Model
from kit.motion import path
from kit.noise import rng
from kit.shapes import sphere
from kit.transform import look_at, rotate_y, translate
from sets import furniture as F
from sets import materials as M
from sets import shell
from sets.fixtures import glow

WIDTH, DEPTH, HEIGHT = 16.0, 12.0, 4.6
COUNT = 240
EIGHTHS = [4.0 * k / 8 for k in range(9)]
TINTS = ((1.0, 0.72, 0.42), (1.0, 0.5, 0.3), (0.55, 0.75, 1.0), (0.7, 1.0, 0.75), (1.0, 0.55, 0.75))


def bulbs(scene):
    """Rounds about columns, waves along the hall and eights over the floor, by turns."""
    r, group, channels = rng(401), scene.node("bulbs"), []
    kinds = []
    for tint in TINTS:
        light = Light(f"bulb {len(kinds) + 1}", "sphere", 85.0, "lumen", color=tint, range_m=6.0, radius_m=0.05,
                      ray_end_bias_m=0.03)
        kinds.append((light, Model(light.name).add(glow(light), sphere(light.radius_m, 8, 6))))
    for k in range(COUNT):
        light, model = kinds[int(r.integers(0, len(kinds)))]
        x, z = r.uniform(1.2, WIDTH - 1.2), r.uniform(1.2, DEPTH - 1.2)
        y, start, way = r.uniform(0.5, 3.6), r.uniform(0, 2 * math.pi), 1 if r.random() < 0.5 else -1
        reach = r.uniform(0.3, 1.0)

        def at(turn, kind=k % 3):
            a = start + way * turn
            if kind == 0:
                return x + reach * math.cos(a), y, z + reach * math.sin(a)
            if kind == 1:
                return x + reach * math.sin(a), y + 0.3 * math.sin(2 * a), z
            return x + reach * math.sin(a), y, z + 0.6 * reach * math.sin(2 * a)

        points = [at(2 * math.pi * i / 8) for i in range(9)]
        node = scene.node(f"bulb {k + 1}", group, translate(*points[0]), model, light)
        channels.append(path(node, EIGHTHS, points, "CUBICSPLINE"))
    return channels


def build():
    scene = Scene("moving lights", 4.2)
    group = scene.node("hall")
    shell.closed_room(scene, group, WIDTH, DEPTH, HEIGHT, M.polished_concrete(0.3, 0.2, 403))
    round_column, square = F.column(M.PORCELAIN, HEIGHT, 0.24), F.column(M.PLASTER, HEIGHT, 0.22, False)
    oak = M.timber("oak", (0.42, 0.29, 0.16), 0.5, 405)
    for i in range(4):
        for k in range(3):
            scene.node("column", group, translate(2.5 + 3.6 * i, 0, 2.2 + 3.8 * k), round_column if (i + k) % 2 else square)
    for model, x, z, turn in ((F.ornament(M.BRASS, 407), 6.2, 5.2, 0.3), (F.pile(F.crate(oak), 0.6, 409), 9.6, 3.2, 0.4),
                              (F.table(oak, 411), 11.4, 7.4, 0.2), (F.ornament(M.PORCELAIN, 413), 4.4, 8.0, 1.0)):
        scene.node(model.name, group, translate(x, 0, z) @ rotate_y(turn), model)
    scene.animations.append(("loop", bulbs(scene)))
    scene.camera("wide", look_at((14.3, 2.1, 11.4), (5.8, 1.1, 3.0)), math.radians(54))
    scene.camera("low", look_at((1.2, 0.9, 10.8), (8.4, 1.3, 4.0)), math.radians(48))
    return scene
