"""A room in which lights go on: keys of STEP bring them from far off at 1, 2 and 3 s and take them away at 4 s, so that they
are new to every list and history. Before, only dim lamps shine."""
import math

from kit.gltf import Scene
from kit.lights import Light
from kit.motion import path
from kit.transform import look_at, rotate_x, rotate_y, translate
from sets import furniture as F
from sets import materials as M
from sets import shell
from sets.fixtures import Fixtures

WIDTH, DEPTH, HEIGHT = 8.0, 6.4, 3.1
AWAY_M = 400.0  # below the ground, far out of range


def lamp(name, kind, lumen, color, range_m=12.0, **shape):
    return Light(name, kind, lumen, "lumen", color=color, range_m=range_m, ray_end_bias_m=0.03, **shape)


NIGHT = lamp("night light", "sphere", 26.0, (1.0, 0.62, 0.36), 5.0, radius_m=0.05)
PANEL = lamp("panel", "rect", 4200.0, (1.0, 0.86, 0.7), width_m=1.6, height_m=0.8)
TUBE = lamp("blue tube", "tube", 900.0, (0.3, 0.5, 1.0), length_m=1.6, radius_m=0.018)
SPOT = lamp("accent", "spot", 1300.0, (1.0, 0.9, 0.8), radius_m=0.04, inner_rad=0.2, outer_rad=0.42)


def build():
    scene = Scene("switched on", 4.4)
    group = scene.node("room")
    shell.closed_room(scene, group, WIDTH, DEPTH, HEIGHT, M.boards(seed=441))
    oak = M.timber("oak", (0.42, 0.29, 0.16), 0.5, 443)
    paints = (M.CARDBOARD, F.painted("rust box", (0.36, 0.12, 0.05), 0.6), F.painted("slate box", (0.1, 0.12, 0.15), 0.5))
    for model, x, z, a in ((F.rack(445, paints), 2.0, 0.45, 0.0), (F.cabinet(F.painted("green", (0.1, 0.2, 0.14), 0.4)), 6.6, 0.6, 0),
                           (F.ornament(M.BRASS, 447), 4.6, 1.3, 0.4), (F.table(oak, 449), 3.4, 3.0, 0.1),
                           (F.bench(oak), 3.4, 4.2, 0.0), (F.pile(F.crate(oak), 0.6, 451), 6.6, 3.4, 0.3)):
        scene.node(model.name, group, translate(x, 0, z) @ rotate_y(a), model)
    fixtures = Fixtures(scene, scene.node("lights"))
    for x, z in ((1.0, 1.6), (3.4, 3.0), (7.2, 2.0), (5.6, 5.2)):
        fixtures.ceiling(NIGHT, x, z, HEIGHT, 1.2)
    channels = []
    for k, (light, matrix) in enumerate(((PANEL, translate(4.0, HEIGHT - 0.06, 2.8) @ rotate_x(-math.pi / 2)),
                                         (TUBE, translate(0.18, 2.2, 3.0) @ rotate_y(math.pi / 2)),
                                         (SPOT, look_at((5.6, HEIGHT - 0.3, 2.6), (4.6, 1.0, 1.3), up=(0, 0, 1))))):
        place = tuple(float(v) for v in matrix[:3, 3])
        away = (place[0], place[1] - AWAY_M, place[2])
        rest = matrix.copy()
        rest[1, 3] -= AWAY_M
        node = fixtures.place(light, rest, light.name)
        channels.append(path(node, [0.0, 1.0 + k, 4.0], [away, place, away], "STEP"))
    scene.animations.append(("loop", channels))
    scene.camera("wide", look_at((7.4, 1.65, 5.9), (3.2, 1.0, 1.4)), math.radians(54))
    scene.camera("close", look_at((2.0, 1.4, 5.0), (4.4, 0.95, 1.6)), math.radians(44))
    return scene
