"""A showroom with four huge rectangle lights and nothing else that shines: each is half covered, by a sliding
screen, a low wall, a cupboard or a drawn blind. What an area mask learns here is which half of a light to
sample."""
import math

from kit.gltf import Scene
from kit.lights import Light
from kit.mesh import Model
from kit.shapes import rod
from kit.transform import look_at, rotate_x, rotate_y, translate
from sets import furniture as F
from sets import materials as M
from sets import shell
from sets.fixtures import Fixtures

WIDTH, DEPTH, HEIGHT = 8.4, 9.0, 3.7
CLOTH = F.painted("screen cloth", (0.34, 0.31, 0.27), 0.9)
SLATE = F.painted("slate paint", (0.12, 0.14, 0.16), 0.5)
WALNUT = M.timber("walnut", (0.24, 0.13, 0.07), 0.4, 51)


def light_wall(name, nit, kelvin, width, height):
    return Light(name, "rect", nit, "nit", temperature_k=kelvin, width_m=width, height_m=height, range_m=18.0,
                 ray_end_bias_m=0.02)


LEFT = light_wall("left light wall", 120.0, 6000.0, 3.4, 2.2)
BACK = light_wall("back light wall", 110.0, 3800.0, 3.2, 2.2)
RIGHT = light_wall("right light wall", 130.0, 4500.0, 3.0, 2.2)
SKYLIGHT = light_wall("skylight", 90.0, 6500.0, 4.0, 2.4)


def sliding_screen(width, height):
    """Opaque sheet in a dark frame on a rail, about its own centre, facing +Z."""
    model = Model("sliding screen")
    F.box(model, CLOTH, width, height, 0.02, 0, -height / 2, 0)
    for s in (-1, 1):
        F.box(model, M.BLACK_METAL, 0.04, height + 0.08, 0.035, s * width / 2, -height / 2 - 0.04, 0)
        F.box(model, M.BLACK_METAL, width, 0.04, 0.034, 0, s * (height / 2 + 0.02) - 0.02, 0)
    return model


def place_lights(scene, fixtures):
    """Each light on its wall or ceiling, and what covers one half of it."""
    face = 0.1  # of the outer walls
    left = translate(face, 1.55, 2.3) @ rotate_y(math.pi / 2)  # local +Z into the room
    fixtures.place(LEFT, left @ translate(0, 0, 0.09) @ rotate_y(math.pi), LEFT.name)
    scene.node("left screen", None, left @ translate(LEFT.width_m / 4 + 0.06, 0, 0.20),
               sliding_screen(LEFT.width_m / 2 + 0.12, LEFT.height_m + 0.24))
    back = translate(2.6, 1.55, face)
    fixtures.place(BACK, back @ translate(0, 0, 0.09) @ rotate_y(math.pi), BACK.name)
    low = Model("low wall")
    F.box(low, SLATE, BACK.width_m + 0.7, 1.55, 0.16, 0, -0.02, 0, 0, 0.008)
    F.box(low, WALNUT, BACK.width_m + 0.78, 0.04, 0.24, 0, 1.53, 0)
    scene.node("low wall", None, translate(2.6, 0, face + 0.55), low)
    right = translate(WIDTH - face, 1.55, 3.0) @ rotate_y(-math.pi / 2)
    fixtures.place(RIGHT, right @ translate(0, 0, 0.09) @ rotate_y(math.pi), RIGHT.name)
    cupboard = Model("cupboard")
    F.box(cupboard, WALNUT, RIGHT.width_m / 2 + 0.1, 2.86, 0.34, 0, 0, 0, 0, 0.008)
    for k in (-1, 1):
        F.box(cupboard, WALNUT, RIGHT.width_m / 4 + 0.03, 2.74, 0.02, k * (RIGHT.width_m / 8 + 0.022), 0.06,
              0.178)
    scene.node("cupboard", None, translate(WIDTH - face, 0, 3.0) @ rotate_y(-math.pi / 2) @
               translate(-RIGHT.width_m / 4 - 0.05, 0, 0.36), cupboard)
    down = rotate_x(math.pi / 2)
    ceiling = translate(4.4, HEIGHT, 4.4) @ down
    fixtures.place(SKYLIGHT, ceiling @ translate(0, 0, 0.09) @ rotate_y(math.pi), SKYLIGHT.name)
    scene.node("drawn blind", None, ceiling @ translate(-SKYLIGHT.width_m / 4 - 0.06, 0, 0.19),
               sliding_screen(SKYLIGHT.width_m / 2 + 0.12, SKYLIGHT.height_m + 0.2))
    rails = Model("blind rails")
    for z in (-1.34, 1.34):
        rails.add(M.BLACK_METAL, rod((-2.2, HEIGHT - 0.19, z), (2.2, HEIGHT - 0.19, z), 0.012, 6))
        for x in (-2.1, 2.1):
            rails.add(M.BLACK_METAL, rod((x, HEIGHT - 0.19, z), (x, HEIGHT + 0.02, z), 0.008, 5))
    scene.node("blind rails", None, translate(4.4, 0, 4.4), rails)


def furnish(scene):
    group = scene.node("furniture")
    oak = M.timber("oak", (0.42, 0.29, 0.16), 0.5, 43)
    crate, column = F.crate(oak), F.column(M.PORCELAIN, HEIGHT, 0.17)
    drum = F.drum(F.painted("blue enamel", (0.03, 0.10, 0.24), 0.2))
    for model, x, z, turn in ((F.table(oak, 1), 3.4, 3.7, 0.12), (F.bench(oak), 5.6, 6.1, 0.5),
                              (F.ornament(M.BRASS, 1), 5.6, 3.3, 0.3),
                              (F.ornament(M.PORCELAIN, 2), 2.0, 5.6, 1.1),
                              (F.pile(crate, 0.6, 3), 6.6, 0.9, -0.08), (drum, 4.9, 0.72, 0.0),
                              (drum, 5.45, 0.62, 1.0),
                              (crate, 3.3, 6.3, 0.5), (column, 4.75, 1.7, 0.0), (column, 7.1, 5.6, 0.0)):
        scene.node(model.name, group, translate(x, 0, z) @ rotate_y(turn), model)


def build():
    scene = Scene("half hidden", 4.5)
    shell.closed_room(scene, None, WIDTH, DEPTH, HEIGHT, M.boards(seed=23))
    place_lights(scene, Fixtures(scene, scene.node("lights")))
    furnish(scene)
    scene.camera("wide", look_at((4.0, 1.7, 8.62), (4.3, 1.42, 1.5)), math.radians(56))
    return scene
