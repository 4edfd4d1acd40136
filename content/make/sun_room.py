"""A closed house in low sun. Indoors (`wide`) a few lamps, and not a ray of the sun, whose unshadowed light
would be far above theirs; outdoors (`outside`) the sun lights the yard and its pergola."""
import math

import numpy as np

from kit.gltf import Scene
from kit.lights import Light
from kit.material import Material
from kit.mesh import Model
from kit.noise import smoothstep
from kit.shapes import block, quad
from kit.transform import look_at, rotate_x, rotate_y, translate
from sets import furniture as F
from sets import materials as M
from sets import shell
from sets.fixtures import Fixtures

WIDTH, DEPTH, HEIGHT, WALL = 7.4, 5.6, 2.9, 0.3
GROUND_Y = -0.14
OUTER = M.paint("lime wash", (0.56, 0.50, 0.41), 0.92)
CLAY = M.paint("clay wall", (0.40, 0.24, 0.15), 0.9)
LARCH = M.timber("larch", (0.34, 0.20, 0.11), 0.55, 61)
BOLLARD = Light("bollard globe", "sphere", 1100.0, "lumen", temperature_k=3600.0, range_m=10.0, radius_m=0.10,
                ray_end_bias_m=0.03)
SUN = Light("sun", "directional", 1000.0, "lux", temperature_k=4300.0, angular_diameter_rad=0.0093)
TABLE_LAMP = Light("table globe", "sphere", 3200.0, "lumen", temperature_k=4300.0, range_m=9.0, radius_m=0.13,
                   ray_end_bias_m=0.03)
WALL_TUBE = Light("wall tube", "tube", 2300.0, "lumen", temperature_k=4600.0, range_m=9.0, radius_m=0.016,
                  length_m=1.2, ray_end_bias_m=0.03)
SPOT = Light("reading spot", "spot", 1500.0, "lumen", temperature_k=4300.0, range_m=8.0, radius_m=0.035,
             inner_rad=0.25, outer_rad=0.6, ray_end_bias_m=0.06)
PANEL = Light("ceiling panel", "rect", 3600.0, "lumen", temperature_k=5200.0, range_m=9.0, width_m=1.2,
              height_m=0.3,
              ray_end_bias_m=0.02)
PORCH = Light("porch globe", "sphere", 2000.0, "lumen", temperature_k=3600.0, range_m=12.0, radius_m=0.12,
              ray_end_bias_m=0.03)


def shuttered_window():
    """Closed shutters in a frame on a wall behind them, facing +Z."""
    model = Model("shuttered window")
    F.box(model, LARCH, 1.36, 1.5, 0.06, 0, -0.75, 0.02)
    for s in (-1, 1):
        for k in range(7):
            F.box(model, CLAY, 0.58, 0.16, 0.024, s * 0.315, -0.68 + 0.19 * k, 0.056, 0, 0.006)
    F.box(model, LARCH, 1.52, 0.05, 0.2, 0, -0.81, 0.06)
    return model


def house(scene):
    group = scene.node("house")
    scene.node("slabs", group, model=shell.slabs(WIDTH, DEPTH, HEIGHT, M.boards((0.30, 0.18, 0.10), 0.28, 27),
                                                 M.paint("roof slab", (0.58, 0.57, 0.55), 0.9), 0.75))
    walls = Model("walls")
    for k, wall in enumerate(shell.outer_walls(WIDTH, DEPTH, WALL)):
        wall.material = OUTER if k else CLAY
        shell.add_wall(walls, wall, HEIGHT)
    scene.node("walls", group, model=walls)
    door, window = F.door(F.painted("door green", (0.07, 0.15, 0.11), 0.35)), shuttered_window()
    front = DEPTH + WALL / 2
    scene.node("door outside", group, translate(2.2, 0, front), door)
    scene.node("door inside", group, translate(2.2, 0, DEPTH - WALL / 2) @ rotate_y(math.pi), door)
    for x in (4.4, 6.3):
        scene.node("window outside", group, translate(x, 1.5, front), window)
        scene.node("window inside", group, translate(x, 1.5, DEPTH - WALL / 2) @ rotate_y(math.pi), window)
    scene.node("window left", group, translate(WALL / 2, 1.5, 2.6) @ rotate_y(math.pi / 2), window)


def yard(scene):
    """Ground, pergola with beams that stripe it with shadow, a garden wall, things that stand about, the sky
    behind the house."""
    group = scene.node("yard")
    ground = Model("ground")
    block(ground, M.polished_concrete(0.26, 0.5, 71), -16, 24, GROUND_Y - 0.3, GROUND_Y, -14, 20)
    block(ground, OUTER, 14.6, 14.85, GROUND_Y - 0.1, 1.5, -1.3, 20)
    block(ground, CLAY, 14.53, 14.92, 1.5, 1.57, -1.0, 20)
    for x0, x1 in ((-16, -1.4), (9.0, 24)):
        block(ground, OUTER, x0, x1, GROUND_Y - 0.1, 1.5, -1.35, -1.1)
        block(ground, CLAY, x0 - 0.05, x1 + 0.05, 1.5, 1.57, -1.42, -1.03)
    scene.node("ground", group, model=ground)
    pergola = Model("pergola")
    for x in (3.2, 5.3, 7.4):
        F.box(pergola, LARCH, 0.12, 2.56, 0.12, x, GROUND_Y - 0.01, 9.0, 0, 0.008)
    F.box(pergola, LARCH, 4.7, 0.16, 0.09, 5.3, 2.41, 9.0, 0, 0.008)
    for k in range(11):
        F.box(pergola, LARCH, 0.05, 0.14, 3.4, 3.2 + 0.42 * k, 2.572, 7.6, 0, 0.006)
    scene.node("pergola", group, model=pergola)
    oak = M.timber("oak", (0.42, 0.29, 0.16), 0.5, 43)
    drum = F.drum(F.painted("ochre enamel", (0.46, 0.25, 0.04), 0.26))
    for model, x, z, turn in ((F.table(oak, 4), 5.3, 7.6, 0.1), (F.bench(oak), 5.2, 8.45, 0.05),
                              (F.pile(F.crate(oak), 0.6, 5), 0.2, 7.0, 0.3), (drum, 8.5, 6.6, 0.0),
                              (drum, 9.1, 6.9, 0.6),
                              (F.ornament(M.PORCELAIN, 3), 1.0, 9.2, 0.4)):
        scene.node(model.name, group, translate(x, GROUND_Y, z) @ rotate_y(turn), model)
    size = 64
    y = np.linspace(1, 0, size)[:, None, None] * np.ones((1, 4, 1))
    low, high = np.array([0.55, 0.42, 0.30]), np.array([0.16, 0.30, 0.55])
    colors = low * np.exp(-y * 5) + high * smoothstep(-0.3, 1.0, y)
    sky = Material("sky", (0, 0, 0), 1.0, emission_nit=(260.0,) * 3, emission_map=np.clip(colors, 0, 1))
    card = Model("sky").add(sky, quad(70, 24, unit_uv=True))
    scene.node("sky behind the house", group, translate(4, 11.6, -13.5), card)
    scene.node("sky on the right", group, translate(36, 11.6, 14) @ rotate_y(-math.pi / 2), card)


def indoors(scene, fixtures):
    group = scene.node("furniture")
    oak = M.timber("oak inside", (0.40, 0.27, 0.15), 0.45, 47)
    table = F.table(oak, 6)
    paints = (M.CARDBOARD, F.painted("slate box", (0.10, 0.12, 0.15), 0.5),
              F.painted("rust box", (0.36, 0.12, 0.05), 0.6))
    for model, x, z, turn in ((table, 3.3, 2.3, 0.1), (F.rack(7, paints), 5.6, 0.42, 0.0),
                              (F.bench(oak), 3.2, 3.35, 0.05),
                              (F.ornament(M.BRASS, 4), 1.0, 1.3, 0.5), (F.crate(oak), 6.3, 3.2, 0.4),
                              (F.drum(F.painted("red enamel", (0.34, 0.03, 0.02), 0.22)), 6.6, 1.5, 0.0),
                              (F.cabinet(F.painted("cabinet grey", (0.20, 0.22, 0.23), 0.38)), 2.3, 0.56,
                               0.0)):
        scene.node(model.name, group, translate(x, 0, z) @ rotate_y(turn), model)
    fixtures.ceiling(TABLE_LAMP, 3.3, 2.3, HEIGHT, 1.15)
    fixtures.ceiling(PANEL, 5.6, 2.2, HEIGHT, 0.056, 0.0)
    fixtures.ceiling(SPOT, 1.7, 2.1, HEIGHT, 0.2, target=(1.0, 1.0, 1.3))
    fixtures.ceiling(SPOT, 5.0, 1.6, HEIGHT, 0.2, target=(5.7, 1.0, 0.3))
    fixtures.place(WALL_TUBE, translate(WALL / 2 + 0.06, 2.45, 2.6) @ rotate_y(math.pi / 2))


def build():
    scene = Scene("sun room", 7.0)
    house(scene)
    yard(scene)
    fixtures = Fixtures(scene, scene.node("lights"))
    indoors(scene, fixtures)
    bracket, post = Model("bracket"), Model("bollard")
    F.box(bracket, M.BLACK_METAL, 0.03, 0.03, 0.26, 0, 0, 0)
    F.box(post, M.BLACK_METAL, 0.12, 0.5, 0.12, 0, 0, 0)
    for x in (1.2, 3.2):
        fixtures.place(PORCH, translate(x, 2.25, DEPTH + WALL / 2 + 0.22))
        scene.node("bracket", None, translate(x, 2.41, DEPTH + WALL / 2 + 0.12), bracket)
    for x, z in ((-1.3, 4.4), (-0.6, 8.3), (2.6, 9.6), (7.9, 8.9)):
        scene.node("bollard", None, translate(x, GROUND_Y - 0.01, z), post)
        fixtures.place(BOLLARD, translate(x, GROUND_Y + 0.60, z) @ rotate_x(math.pi))
    scene.node("sun", matrix=look_at((11.0, 9.0, 17.0), (2.0, 0.0, 4.0)), light=SUN)
    scene.camera("wide", look_at((6.75, 1.62, 5.0), (2.4, 1.15, 1.0)), math.radians(56))
    scene.camera("outside", look_at((-1.6, 1.75, 12.2), (4.3, 1.05, 5.6)), math.radians(44))
    return scene
