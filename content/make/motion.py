"""A hall in which things move, looping in 4 s: a lamp along an oval rail, a lamp on a cart, a swinging spot,
a lamp and a shutter that jump once a second, a vane that turns and drifts and throws shadows; cameras `dolly`
(moving) and `still`. The keys use LINEAR, STEP and CUBICSPLINE; what the rest pose shows is the time 0."""
import math

import numpy as np

from kit.gltf import Scene
from kit.lights import Light
from kit.mesh import Model
from kit.motion import path, turn
from kit.shapes import cylinder, lathe, rod, sweep, torus
from kit.transform import look_at, rotate_x, rotate_y, rotate_z, translate
from sets import furniture as F
from sets import materials as M
from sets import shell
from sets.fixtures import Fixtures

WIDTH, DEPTH, HEIGHT = 12.0, 9.0, 4.0
LOOP_S = 4.0
SECONDS = [0.0, 1.0, 2.0, 3.0, 4.0]
HALVES = [LOOP_S * k / 8 for k in range(9)]
RAIL_DROP_M = 1.15


def lamp(name, kind, lumen, kelvin, color=(1.0, 1.0, 1.0), **shape):
    return Light(name, kind, lumen, "lumen", color=color, temperature_k=kelvin, range_m=13.0, **shape)


LANTERN = lamp("rail lantern", "sphere", 1100.0, 3200.0, (1.0, 0.78, 0.5), radius_m=0.16, ray_end_bias_m=0.03)
CART_LAMP = lamp("cart lamp", "sphere", 900.0, 5600.0, (0.7, 0.85, 1.0), radius_m=0.11, ray_end_bias_m=0.03)
SWING = lamp("swinging spot", "spot", 1300.0, 4000.0, radius_m=0.05, inner_rad=0.22, outer_rad=0.5,
             ray_end_bias_m=0.06)
JUMPER = lamp("jumping disk", "disk", 700.0, 4300.0, (1.0, 0.45, 0.3), width_m=0.36, ray_end_bias_m=0.02)
SHUTTERED = lamp("shuttered panel", "rect", 1500.0, 5000.0, width_m=2.4, height_m=1.2, ray_end_bias_m=0.02)
PANEL = lamp("ceiling panel", "rect", 650.0, 4500.0, width_m=1.4, height_m=0.36, ray_end_bias_m=0.02)
TUBE = lamp("tube", "tube", 650.0, 4200.0, length_m=1.4, radius_m=0.018, ray_end_bias_m=0.03)
DISK = lamp("ceiling disk", "disk", 500.0, 4000.0, width_m=0.4, ray_end_bias_m=0.02)
SPOT = lamp("accent spot", "spot", 800.0, 3800.0, radius_m=0.04, inner_rad=0.2, outer_rad=0.42,
            ray_end_bias_m=0.06)


def oval(angle_rad):
    """The lantern's way below its rail."""
    return 6.0 + 2.6 * math.cos(angle_rad), HEIGHT - RAIL_DROP_M, 4.4 + 1.7 * math.sin(angle_rad)


def cart_model():
    """Flat cart with a mast; the lamp hangs from it as a child."""
    model = Model("cart")
    F.box(model, F.painted("cart red", (0.34, 0.03, 0.02), 0.25), 1.1, 0.08, 0.65, 0, 0.2, 0, 0, 0.01)
    for x in (-0.4, 0.4):
        for z in (-0.3, 0.3):
            turned = rotate_x(math.copysign(math.pi / 2, z))
            model.add(M.RUBBER, cylinder(0.12, 0.06, 14, 0.01), translate(x, 0.12, z - 0.1 * z) @ turned)
    model.add(M.STEEL, sweep([(-0.45, 0.28, 0), (-0.45, 1.5, 0), (-0.38, 1.66, 0), (-0.25, 1.7, 0),
                              (0, 1.7, 0)], 0.02, 8))
    model.add(M.STEEL, rod((0, 1.7, 0), (0, 1.45, 0), 0.008, 6))
    return model


def vane_model():
    """Three upright sheets of different heights about a post on a foot."""
    model = Model("vane")
    model.add(M.BLACK_METAL, cylinder(0.3, 0.06, 20, 0.01))
    model.add(M.STEEL, rod((0, 0.05, 0), (0, 2.3, 0), 0.025, 10))
    for k, (height, paint) in enumerate(((1.9, F.painted("vane white", (0.7, 0.69, 0.66), 0.5)),
                                         (1.5, M.BRASS),
                                         (1.1, F.painted("vane blue", (0.04, 0.12, 0.28), 0.25)))):
        sheet = Model("sheet")
        F.box(sheet, paint, 0.72, height, 0.02, 0.42, 2.2 - height, 0)
        model.include(sheet, rotate_y(2 * math.pi * k / 3))
    return model


def smooth_channels(scene, fixtures, shell_group):
    """Lantern (CUBICSPLINE), cart and its lamp (LINEAR), swinging spot (CUBICSPLINE rotation)."""
    lantern = fixtures.place(LANTERN, translate(*oval(0)), LANTERN.name)
    hanger = Model("hanger").add(M.BLACK_METAL, rod((0, 0.2, 0), (0, RAIL_DROP_M - 0.12, 0), 0.008, 6))
    scene.node("hanger", lantern, model=hanger)
    angles = [2 * math.pi * k / 48 for k in range(48)]
    rail = [(x, HEIGHT - 0.12, z) for x, _, z in map(oval, angles)]
    scene.node("rail", shell_group, model=Model("rail").add(M.BLACK_METAL,
                                                            sweep(rail, 0.022, 6, closed=True)))
    ways = [oval(2 * math.pi * k / 8) for k in range(9)]

    corners = [(3.6, 6.5), (8.0, 7.0), (8.8, 6.5), (4.4, 6.0), (3.6, 6.5)]
    cart = scene.node("cart", None, translate(corners[0][0], 0, corners[0][1]), cart_model())
    scene.node("cart crate", cart, translate(0.2, 0.28, 0) @ rotate_y(0.2),
               F.crate(M.timber("oak", (0.42, 0.29, 0.16), 0.5, 43), "small crate", 0.42))
    carried = fixtures.place(CART_LAMP, translate(0.0, 1.32, 0), CART_LAMP.name)
    carried.parent.children.remove(carried)
    carried.parent = cart
    cart.children.append(carried)

    pivot = (9.6, 3.35, 2.6)
    swings = [0.0, 0.45, 0.0, -0.45, 0.0]
    down = look_at(pivot, (9.6, 0, 2.61), up=(0, 0, 1))
    spot = fixtures.place(SWING, down, SWING.name)
    fixtures.stem(pivot[0], pivot[1] + 0.1, pivot[2], HEIGHT - pivot[1] - 0.08)
    return [path(lantern, HALVES, ways, "CUBICSPLINE"),
            path(cart, SECONDS, [(x, 0, z) for x, z in corners]),
            turn(cart, SECONDS, [rotate_y(a) for a in (0.0, 0.15, -0.5, -0.1, 0.0)]),
            turn(spot, SECONDS, [rotate_z(a) @ down for a in swings], "CUBICSPLINE")]


def step_channels(scene, fixtures, shell_group):
    """The disk that jumps on a signal board and the shutter before a wall light (STEP)."""
    board = [(3.2, 2.9), (4.4, 2.9), (4.4, 2.2), (3.2, 2.2), (3.2, 2.9)]
    backs = Model("signal board")
    F.box(backs, M.BLACK_METAL, 1.9, 1.4, 0.05, 3.8, 1.85, 0.125)
    for x, y in board[:4]:
        backs.add(M.STEEL, torus(0.23, 0.012, 24, 6), translate(x, y, 0.152) @ rotate_x(math.pi / 2))
    scene.node("signal board", shell_group, model=backs)
    jumper = fixtures.place(JUMPER, translate(*board[0], 0.21) @ rotate_y(math.pi), JUMPER.name)

    fixtures.place(SHUTTERED, translate(8.0, 1.75, 0.2) @ rotate_y(math.pi), SHUTTERED.name)
    shutter = Model("shutter")
    F.box(shutter, F.painted("shutter slate", (0.08, 0.09, 0.10), 0.45), 0.66, 1.4, 0.03, 0, -0.7, 0)
    stops = [(7.1, 1.75, 0.36), (7.7, 1.75, 0.36), (8.3, 1.75, 0.36), (8.9, 1.75, 0.36), (7.1, 1.75, 0.36)]
    door = scene.node("shutter", None, translate(*stops[0]), shutter)
    rails = Model("shutter rails")
    for y in (0.98, 2.52):
        rails.add(M.BLACK_METAL, rod((6.6, y, 0.36), (9.4, y, 0.36), 0.014, 6))
        for x in (6.62, 9.38):
            rails.add(M.BLACK_METAL, rod((x, y, 0.05), (x, y, 0.37), 0.012, 6))
    scene.node("shutter rails", shell_group, model=rails)
    return [path(jumper, SECONDS, [(x, y, 0.21) for x, y in board], "STEP"),
            path(door, SECONDS, stops, "STEP")]


def place_still_lights(fixtures):
    for x in (3.0, 9.0):
        fixtures.ceiling(PANEL, x, 7.2, HEIGHT, 0.056)
        fixtures.ceiling(DISK, x, 1.6, HEIGHT, 0.056)
    for z in (2.6, 6.2):
        fixtures.place(TUBE, translate(0.22, 2.7, z) @ rotate_y(math.pi / 2))
    fixtures.ceiling(SPOT, 4.6, 3.4, HEIGHT, 0.3, target=(5.6, 1.1, 2.2))


def vane_channels(scene):
    place = [(6.6, 0, 3.2), (7.5, 0, 4.2), (6.4, 0, 4.9), (5.4, 0, 4.0), (6.6, 0, 3.2)]
    vane = scene.node("vane", None, translate(*place[0]), vane_model())
    return [path(vane, SECONDS, place, "CUBICSPLINE"),
            turn(vane, HALVES, [rotate_y(2 * math.pi * k / 8) for k in range(9)])]


def dolly_channels(scene):
    """The camera goes to the right and back on an arc, looking at the middle of the hall."""
    eyes, looks = [], []
    for k in range(9):
        s = 0.5 - 0.5 * math.cos(2 * math.pi * k / 8)
        eye = (2.2 + 6.6 * s, 1.65 + 0.35 * s, 8.25 - 0.9 * math.sin(math.pi * s))
        eyes.append(eye)
        looks.append(look_at(eye, (6.2, 1.35, 2.6)))
    dolly = scene.camera("dolly", looks[0], math.radians(50))
    return [path(dolly, HALVES, eyes, "CUBICSPLINE"), turn(dolly, HALVES, looks)]


def furnish(scene):
    group = scene.node("furniture")
    oak = M.timber("oak wide", (0.42, 0.29, 0.16), 0.5, 45)
    column = F.column(M.PORCELAIN, HEIGHT, 0.2)
    drums = [F.drum(F.painted(name, color, 0.22)) for name, color in (("blue enamel", (0.03, 0.10, 0.24)),
                                                                       ("ochre enamel", (0.46, 0.25, 0.04)))]
    paints = (M.CARDBOARD, F.painted("rust box", (0.36, 0.12, 0.05), 0.6),
              F.painted("slate box", (0.1, 0.12, 0.15), 0.5))
    for model, x, z, angle in ((F.ornament(M.BRASS, 1), 5.6, 2.2, 0.3), (column, 2.2, 3.4, 0.0),
                               (column, 10.2, 4.2, 0.0),
                               (F.pile(F.crate(oak), 0.6, 8), 1.2, 1.1, 0.1), (drums[0], 11.2, 0.9, 0.0),
                               (drums[1], 10.5, 0.7, 0.4), (F.rack(9, paints), 0.5, 4.5, math.pi / 2),
                               (F.table(oak, 9), 11.2, 2.9, math.pi / 2)):
        scene.node(model.name, group, translate(x, 0, z) @ rotate_y(angle), model)


def build():
    scene = Scene("motion", 4.3)
    group = scene.node("hall")
    shell.closed_room(scene, group, WIDTH, DEPTH, HEIGHT, M.polished_concrete(0.34, 0.2, 75),
                      [M.paint("back wall", (0.20, 0.27, 0.31), 0.85)])
    furnish(scene)
    fixtures = Fixtures(scene, scene.node("lights"))
    channels = smooth_channels(scene, fixtures, group) + step_channels(scene, fixtures, group)
    place_still_lights(fixtures)
    channels += vane_channels(scene) + dolly_channels(scene)
    scene.animations.append(("loop", channels))
    scene.camera("still", look_at((9.9, 1.8, 8.3), (4.9, 1.25, 2.4)), math.radians(52))
    return scene
