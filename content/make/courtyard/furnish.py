"""Lamps and things: a basin with water in the court, pots, a bench, lanterns in the arcade; indoors a table that is laid, shelves,
a hanging lamp and candles."""
import math

from kit.lights import Light
from kit.material import Material
from kit.mesh import Model
from kit.noise import rng
from kit.shapes import bevel_box, cylinder, lathe, prism, rod, sphere, torus
from kit.transform import rotate_x, rotate_y, rotate_z, translate

from . import building as B
from . import materials as M

SUN = Light("low sun", "directional", 900.0, "lux", temperature_k=4300.0, angular_diameter_rad=0.0093)
SKY = Light("sky", "directional", 230.0, "lux", temperature_k=9500.0, angular_diameter_rad=2.2)
LANTERN = Light("arcade lantern", "sphere", 560.0, "lumen", temperature_k=2900.0, range_m=9.0, radius_m=0.05,
                ray_end_bias_m=0.05)
PENDANT = Light("hanging lamp", "disk", 2300.0, "lumen", temperature_k=3300.0, range_m=8.0, width_m=0.2,
                ray_end_bias_m=0.03)
CANDLE = Light("candle", "sphere", 110.0, "lumen", temperature_k=2400.0, range_m=6.0, radius_m=0.014,
               ray_end_bias_m=0.02)
SCONCE = Light("wall lamp", "sphere", 1200.0, "lumen", temperature_k=3000.0, range_m=7.0, radius_m=0.06,
               ray_end_bias_m=0.04)


def glow(light, share=1.0):
    return Material(light.name + " glow", (0.0, 0.0, 0.0), 0.6, emission_nit=light.face_nit(share))


def lantern():
    """Iron cage about a flame of glass; hangs from its ring at (0, 0.3, 0)."""
    model = Model("lantern")
    model.add(glow(LANTERN), sphere(LANTERN.radius_m, 14, 8))
    for k in range(6):
        a = 2 * math.pi * k / 6
        x, z = 0.1 * math.cos(a), 0.1 * math.sin(a)
        model.add(M.IRON, rod((x * 0.75, -0.13, z * 0.75), (x, 0.12, z), 0.005, 5))
    model.add(M.IRON, torus(0.1, 0.007, 24, 6), translate(0, 0.12, 0))
    model.add(M.IRON, cylinder(0.085, 0.015, 16), translate(0, -0.145, 0))
    model.add(M.IRON, lathe([(0.12, 0.115), (0.122, 0.125), (0.05, 0.2), (0.02, 0.23), (0, 0.235)], 18, 40))
    model.add(M.IRON, lathe([(0, 0.225), (0.045, 0.195), (0.115, 0.115)], 18, 40))  # seen from below
    return model.add(M.IRON, rod((0, 0.22, 0), (0, 0.62, 0), 0.006, 6))


def basin():
    """Eight-sided trough with water up to a hand below its rim, in its middle a bowl on a stem."""
    model = Model("basin")
    ring = [(math.cos(2 * math.pi * (k + 0.5) / 8), math.sin(2 * math.pi * (k + 0.5) / 8)) for k in range(8)]
    for k in range(8):
        (ax, az), (bx, bz) = ring[k], ring[(k + 1) % 8]
        side = 1.15 * math.hypot(bx - ax, bz - az)
        turn = math.atan2(-(bz - az), bx - ax)
        mx, mz = 1.15 * (ax + bx) / 2, 1.15 * (az + bz) / 2
        wall = bevel_box(side + 0.05, 0.5, 0.14, 0.012).with_uv_offset(0.5 * k, 0)
        cap = bevel_box(side + 0.14, 0.07, 0.24, 0.018).with_uv_offset(0.5 * k, 0.4)
        model.add(M.COLUMN, wall, translate(mx, 0.25, mz) @ rotate_y(turn))
        model.add(M.COLUMN, cap, translate(mx, 0.53, mz) @ rotate_y(turn))
    model.add(M.WATER, prism([(1.12 * x, 1.12 * z) for x, z in ring[::-1]], 0.39, 0.001))
    stem = [(0.2, 0.3), (0.16, 0.42), (0.09, 0.5), (0.07, 0.75), (0.1, 0.9), (0.2, 0.98), (0.42, 1.06), (0.46, 1.12),
            (0.44, 1.13), (0.4, 1.09), (0.1, 1.03), (0, 1.03)]
    return model.add(M.COLUMN, lathe(stem, 32, 40))


def bench():
    model = Model("garden bench")
    for k in range(3):
        model.add(M.OAK, bevel_box(1.7, 0.035, 0.12, 0.006).with_uv_offset(0, 0.3 * k), translate(0, 0.44, -0.14 + 0.14 * k))
    for k in range(2):
        model.add(M.OAK, bevel_box(1.7, 0.1, 0.03, 0.006).with_uv_offset(0.4, 0.3 * k),
                  translate(0, 0.64 + 0.17 * k, -0.25 - 0.03 * k) @ rotate_x(-0.16))
    for x in (-0.7, 0.7):
        for z, top in ((-0.2, 0.9), (0.18, 0.43)):
            model.add(M.IRON, bevel_box(0.04, top, 0.04, 0.005), translate(x, top / 2, z))
        model.add(M.IRON, bevel_box(0.04, 0.03, 0.44, 0.005), translate(x, 0.41, -0.01))
    return model


def table():
    """Laid for two: bowls, a jug, a loaf on linen, two candlesticks."""
    model = Model("laid table")
    model.add(M.OAK, bevel_box(1.7, 0.05, 0.85, 0.008), translate(0, 0.725, 0))
    for sx in (-1, 1):
        for sz in (-1, 1):
            model.add(M.OAK, bevel_box(0.08, 0.7, 0.08, 0.006), translate(sx * 0.74, 0.35, sz * 0.34))
    model.add(M.LINEN, bevel_box(0.5, 0.006, 0.84, 0.002), translate(0.05, 0.753, 0))
    bowl = lathe([(0, 0), (0.05, 0), (0.1, 0.035), (0.13, 0.085), (0.122, 0.085), (0.095, 0.04), (0, 0.012)], 24, 50)
    jug = lathe([(0, 0), (0.06, 0), (0.095, 0.07), (0.09, 0.14), (0.05, 0.2), (0.06, 0.25), (0.052, 0.25), (0.04, 0.2),
                 (0, 0.19)], 24, 50)
    model.add(M.GLAZE, bowl, translate(-0.45, 0.751, 0.18)).add(M.GLAZE, bowl, translate(0.55, 0.751, -0.12))
    model.add(M.GLAZE, jug, translate(-0.2, 0.751, -0.2))
    loaf = sphere(0.13, 18, 10).at(rotate_y(0.4) @ translate(0, 0, 0))
    loaf.positions = loaf.positions * (1.25, 0.6, 0.85)
    model.add(Material("crust", (0.36, 0.19, 0.075), 0.8), loaf, translate(0.1, 0.83, 0.08))
    for x, z in ((-0.05, 0.3), (0.32, 0.22)):
        model.add(M.IRON, lathe([(0, 0), (0.06, 0), (0.055, 0.01), (0.012, 0.02), (0.01, 0.13), (0.02, 0.14), (0, 0.14)],
                                14, 40), translate(x, 0.751, z))
        model.add(Material("wax", (0.72, 0.66, 0.5), 0.5), cylinder(0.011, 0.12, 10), translate(x, 0.885, z))
    return model


CANDLES = ((-0.05, 1.025, 0.3), (0.32, 1.025, 0.22))  # flames, on the table


def chair():
    model = Model("chair")
    model.add(M.OAK, bevel_box(0.42, 0.035, 0.42, 0.006), translate(0, 0.45, 0))
    for x in (-0.18, 0.18):
        for z, top in ((-0.18, 0.92), (0.18, 0.44)):
            model.add(M.OAK, bevel_box(0.036, top, 0.036, 0.005), translate(x, top / 2, z))
    for y in (0.62, 0.74, 0.86):
        model.add(M.OAK, bevel_box(0.36, 0.05, 0.02, 0.005), translate(0, y, -0.18))
    return model


def shelves():
    """Books and jars on boards."""
    model, r = Model("shelves"), rng(61)
    for s in (-1, 1):
        model.add(M.OAK, bevel_box(0.04, 2.0, 0.32, 0.006), translate(s * 0.82, 1.0, 0))
    for level in (0.1, 0.55, 1.0, 1.45, 1.95):
        model.add(M.OAK, bevel_box(1.62, 0.035, 0.32, 0.005).with_uv_offset(0, level), translate(0, level, 0))
        x = -0.76
        while x < 0.66 and level < 1.8:
            if r.uniform(0, 1) < 0.25:
                jar = lathe([(0, 0), (0.06, 0), (0.075, 0.08), (0.05, 0.17), (0.055, 0.19), (0, 0.19)], 16, 50)
                model.add(M.GLAZE, jar, translate(x + 0.08, level + 0.018, 0.02))
                x += 0.2
            else:
                w, h = r.uniform(0.025, 0.055), r.uniform(0.2, 0.32)
                book = bevel_box(w - 0.003, h, r.uniform(0.16, 0.22), 0.004)
                model.add(M.BOOKS[int(r.integers(0, len(M.BOOKS)))], book,
                          translate(x + w / 2, level + 0.018 + h / 2, 0.02) @ rotate_z(r.uniform(-0.02, 0.02)))
                x += w
    return model


def pendant():
    """An iron shade; the luminous face looks along -Z as its light does."""
    model = Model("hanging lamp")
    model.add(glow(PENDANT), lathe([(0, 0.002), (0.1, 0.002)], 20), rotate_x(math.pi / 2))
    shade = [(0.103, -0.03), (0.19, -0.035), (0.18, -0.025), (0.1, 0.06), (0.03, 0.1), (0.02, 0.13), (0, 0.13)]
    model.add(M.IRON, lathe(shade, 28, 40), rotate_x(math.pi / 2))
    model.add(M.LINEN, lathe([(0.02, 0.09), (0.095, 0.05), (0.185, -0.034)], 28, 40), rotate_x(math.pi / 2))
    return model


def indoors(scene):
    group = scene.node("room things")
    floor = B.STEP_Y
    laid = scene.node("table", group, translate(1.35, floor, -5.7) @ rotate_y(0.12), table())
    for k, place in enumerate(CANDLES):
        flame = Model("flame").add(glow(CANDLE), sphere(CANDLE.radius_m, 8, 6))
        scene.node(f"candle {k + 1}", laid, translate(*place), flame, CANDLE)
    seat = chair()
    for x, z, turn in ((0.9, -5.05, 3.3), (1.9, -6.35, 0.25), (-2.5, -4.3, 1.2)):
        scene.node("chair", group, translate(x, floor, z) @ rotate_y(turn), seat)
    scene.node("shelves", group, translate(-1.3, floor, B.ROOM_Z + 0.18), shelves())
    lamp_y = 1.95
    scene.node("hanging lamp", group, translate(1.35, lamp_y, -5.7) @ rotate_x(-math.pi / 2), pendant(), PENDANT)
    cord = Model("cord").add(M.IRON, rod((0, 0.1, 0), (0, B.ROOM_Y - lamp_y, 0), 0.005, 6))
    scene.node("cord", group, translate(1.35, lamp_y, -5.7), cord)
    lamp = Model("wall lamp").add(glow(SCONCE), sphere(SCONCE.radius_m, 14, 8))
    lamp.add(M.IRON, torus(0.065, 0.006, 20, 6), translate(0, 0, 0))
    lamp.add(M.IRON, rod((0, -0.06, 0), (0, -0.1, 0.1), 0.008, 6))
    lamp.add(M.IRON, bevel_box(0.09, 0.16, 0.015, 0.004), translate(0, -0.1, 0.105))
    scene.node("wall lamp", group, translate(-B.ROOM_X + 0.12, 1.75, -5.6) @ rotate_y(-math.pi / 2), lamp, SCONCE)


def arcade(scene):
    group = scene.node("arcade lanterns")
    model = lantern()
    for k, bay in enumerate((-2, -1, 1, 2)):
        scene.node(f"lantern {k + 1}", group, translate(bay * B.BAY_M, B.CEILING_Y - 0.16 - 0.6, -1.55), model, LANTERN)
