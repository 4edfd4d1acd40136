"""What is hidden comes into view all the time: a partition slides through the picture, a gate of bars turns before it, and the
camera `dolly` goes past columns, a loop of 4 s. For what a renderer makes of pixels that it has not seen before."""
import math

from kit.gltf import Scene
from kit.lights import Light
from kit.mesh import Model
from kit.motion import path, turn
from kit.shapes import rod
from kit.transform import look_at, rotate_x, rotate_y, translate
from sets import furniture as F
from sets import materials as M
from sets import shell
from sets.fixtures import Fixtures

WIDTH, DEPTH, HEIGHT = 11.0, 9.0, 3.6
EIGHTHS = [4.0 * k / 8 for k in range(9)]


def lamp(name, kind, lumen, kelvin, **shape):
    return Light(name, kind, lumen, "lumen", temperature_k=kelvin, range_m=12.0, ray_end_bias_m=0.03, **shape)


PANEL = lamp("panel", "rect", 1700.0, 4600.0, width_m=1.6, height_m=0.5)
DISK = lamp("ceiling disk", "disk", 900.0, 3600.0, width_m=0.5)
TUBE = lamp("tube", "tube", 900.0, 5600.0, length_m=1.5, radius_m=0.018)
SPOT = Light("accent", "spot", 1100.0, "lumen", temperature_k=3000.0, range_m=10.0, radius_m=0.04, inner_rad=0.2,
             outer_rad=0.45, ray_end_bias_m=0.06)
RED = Light("red globe", "sphere", 500.0, "lumen", color=(1.0, 0.25, 0.15), range_m=8.0, radius_m=0.12,
            ray_end_bias_m=0.03)


def partition():
    model = Model("partition")
    F.box(model, F.painted("partition blue", (0.06, 0.12, 0.2), 0.5), 1.5, 2.2, 0.06, 0, 0.04, 0)
    for x in (-0.6, 0.6):
        F.box(model, M.BLACK_METAL, 0.08, 0.04, 0.5, x, 0, 0)
    return model


def gate():
    """Upright bars about a post, as a revolving gate has them."""
    model = Model("gate").add(M.STEEL, rod((0, 0, 0), (0, 2.2, 0), 0.04, 10))
    for wing in range(4):
        a = math.pi / 2 * wing
        for k in range(5):
            r = 0.2 + 0.16 * k
            model.add(M.BLACK_METAL, rod((r * math.cos(a), 0.1, r * math.sin(a)), (r * math.cos(a), 2.1, r * math.sin(a)),
                                         0.016, 6))
        for y in (0.1, 2.1):
            model.add(M.BLACK_METAL, rod((0, y, 0), (0.9 * math.cos(a), y, 0.9 * math.sin(a)), 0.016, 6))
    return model


def build():
    scene = Scene("passing", 4.6)
    group = scene.node("hall")
    shell.closed_room(scene, group, WIDTH, DEPTH, HEIGHT, M.boards(seed=421),
                      [M.paint("far wall", (0.42, 0.34, 0.24), 0.85)])
    oak = M.timber("oak", (0.42, 0.29, 0.16), 0.5, 423)
    column = F.column(M.PLASTER, HEIGHT, 0.16)
    for x in (2.4, 4.8, 7.2, 9.6):
        scene.node("column", group, translate(x, 0, 5.6), column)
    paints = (M.CARDBOARD, F.painted("rust box", (0.36, 0.12, 0.05), 0.6), F.painted("slate box", (0.1, 0.12, 0.15), 0.5))
    for model, x, z, a in ((F.rack(425, paints), 2.2, 0.45, 0.0), (F.rack(427, paints), 4.4, 0.45, 0.0),
                           (F.ornament(M.BRASS, 429), 7.0, 1.6, 0.4), (F.table(oak, 431), 5.2, 2.6, 0.1),
                           (F.pile(F.crate(oak), 0.6, 433), 9.4, 1.2, 0.2)):
        scene.node(model.name, group, translate(x, 0, z) @ rotate_y(a), model)
    fixtures = Fixtures(scene, scene.node("lights"))
    for x in (2.6, 5.5, 8.4):
        fixtures.ceiling(PANEL, x, 2.2, HEIGHT, 0.056)
        fixtures.ceiling(DISK, x + 0.6, 6.6, HEIGHT, 0.056)
    for z in (2.0, 6.0):
        fixtures.place(TUBE, translate(0.16, 2.5, z) @ rotate_y(math.pi / 2))
    fixtures.ceiling(SPOT, 6.2, 3.2, HEIGHT, 0.3, target=(7.0, 1.1, 1.6))
    fixtures.ceiling(RED, 9.4, 3.4, HEIGHT, 0.9)
    slides = [(1.6 + 7.6 * (0.5 - 0.5 * math.cos(2 * math.pi * k / 8)), 0, 4.2) for k in range(9)]
    sliding = scene.node("partition", None, translate(*slides[0]), partition())
    turning = scene.node("gate", None, translate(6.0, 0, 6.5), gate())
    eyes = [(3.4 + 4.2 * (0.5 - 0.5 * math.cos(2 * math.pi * k / 8)), 1.6, 8.3) for k in range(9)]
    looks = [look_at(eye, (eye[0] * 0.5 + 2.7, 1.2, 1.4)) for eye in eyes]
    dolly = scene.camera("dolly", looks[0], math.radians(54))
    scene.animations.append(("loop", [path(sliding, EIGHTHS, slides), path(dolly, EIGHTHS, eyes), turn(dolly, EIGHTHS, looks),
                                      turn(turning, EIGHTHS, [rotate_y(2 * math.pi * k / 8) for k in range(9)])]))
    scene.camera("wide", look_at((9.8, 1.7, 8.4), (4.6, 1.2, 1.6)), math.radians(54))
    return scene
