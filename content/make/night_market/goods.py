"""What the stalls sell, each a model in the stall's frame: the counter's top is y = 0.92 between x = -1.25
and 1.25, z = 0.05 and 0.75; the customer stands at +Z. `detail` is 2 beside the close cameras, 1 along the
first half of the lanes, 0 beyond."""
import math

import numpy as np

from kit.mesh import Model
from kit.noise import rng
from kit.plants import leaf_mesh
from kit.shapes import bevel_box, cylinder, lathe, sphere, surface, sweep, torus
from kit.transform import rotate_x, rotate_y, rotate_z, scale, translate

from . import materials as M

TOP_Y = 0.92


def crate(model, matrix, width=0.52, depth=0.36, height=0.16, seed=0, slats=2, bevel=0.003):
    """Slatted box without a bottom; each slat a little off."""
    r = rng(seed)
    for s in (-1, 1):
        model.add(M.CRATE, bevel_box(0.02, height, depth, bevel).with_uv_offset(r.random(), r.random()),
                  matrix @ translate(s * (width / 2 - 0.01), height / 2, 0))
        for k in range(slats):
            slat = bevel_box(width, height * 0.82 / slats - 0.006, 0.012, bevel)
            slat = slat.with_uv_offset(r.random(), r.random())
            y = height * (0.08 + 0.86 * (k + 0.5) / slats)
            place = translate(0, y, s * depth / 2) @ rotate_z(r.uniform(-0.008, 0.008))
            model.add(M.CRATE, slat, matrix @ place)


FRUIT_SHAPE = {"orange": (0.040, 0.94), "apple": (0.041, 0.88), "lime": (0.034, 0.92), "lemon": (0.036, 1.25),
               "aubergine": (0.036, 2.3), "peach": (0.038, 0.95)}


def fruit_crate(model, kind, matrix, seed, detail):
    """A full crate: a bed that hides the bottom, and the top layer piece by piece."""
    r = rng(seed)
    crate(model, matrix, seed=seed, slats=2 if detail == 2 else 1, bevel=0.003 if detail else 0)
    material = M.FRUIT[kind]
    radius, stretch = FRUIT_SHAPE[kind]
    model.add(material, bevel_box(0.46, 0.03, 0.31, 0.01), matrix @ translate(0, 0.105, 0))
    body = sphere(radius, *((6, 3), (7, 4), (10, 6))[detail])
    long = stretch > 1.5
    step_x, step_z = (radius * 4.6, radius * 2.1) if long else (radius * 2.02, radius * 1.9)
    nx, nz = int(0.48 / step_x), int(0.33 / step_z)
    for i in range(nx):
        for k in range(nz):
            x = (i - (nx - 1) / 2 + (0.25 if k % 2 else -0.25) * (0 if long else 1)) * step_x
            z = (k - (nz - 1) / 2) * step_z
            y = 0.12 + radius * 0.55 + 0.035 * math.cos(x * 5) * math.cos(z * 6) + r.uniform(-0.006, 0.008)
            size = r.uniform(0.9, 1.08)
            if long:
                lie, turn = rotate_z(math.pi / 2 + r.uniform(-0.2, 0.2)), r.uniform(-0.15, 0.15)
            else:
                lie, turn = rotate_x(r.uniform(-0.5, 0.5)) @ rotate_z(r.uniform(-0.5, 0.5)), r.uniform(0,
                    6.28)
            place = translate(x, y, z) @ rotate_y(turn) @ lie @ scale(size, size * stretch, size)
            model.add(material, body, matrix @ place)


def fruit(name, kinds, seed, detail):
    """Crates on the counter and a second row on a stand before it, tilted to the customer."""
    model = Model(name)
    for k in range(4):
        x = (k - 1.5) * 0.62
        fruit_crate(model, kinds[k % len(kinds)], translate(x, TOP_Y + 0.07, 0.40) @ rotate_x(0.22), seed + k,
                    detail)
        if detail == 2 and k != 2:
            fruit_crate(model, kinds[(k + 2) % len(kinds)], translate(x, 0.48, 0.98) @ rotate_x(0.30),
                        seed + 10 + k, detail)
            model.add(M.CRATE, bevel_box(0.5, 0.40, 0.30, 0.006).with_uv_offset(0.3 * k, 0),
                      translate(x, 0.2, 0.99))
    for k in range(7):
        place = translate(-1.15 + 0.38 * k, TOP_Y + 0.16, 0.16) @ rotate_y(2.4 * k) @ rotate_x(-0.8)
        model.add(M.LEAF, leaf_mesh(0.22, 0.12, across=2, along=5), place)
    return model


BOTTLE = [(0, 0), (0.034, 0), (0.038, 0.006), (0.038, 0.15), (0.030, 0.185), (0.014, 0.22), (0.013, 0.275),
          (0.015, 0.28), (0.0, 0.283)]
FLASK = [(0, 0), (0.045, 0), (0.05, 0.01), (0.05, 0.09), (0.035, 0.125), (0.014, 0.145), (0.014, 0.19),
         (0, 0.193)]
JAR = [(0, 0), (0.052, 0), (0.058, 0.01), (0.058, 0.12), (0.048, 0.14), (0.048, 0.16), (0, 0.165)]


def bottles(name, seed, detail):
    """Rows of bottles and jars on the counter and on two shelves behind."""
    model, r = Model(name), rng(seed)
    segments = (5, 6, 14)[detail]
    shapes = [lathe(p, segments, 30) for p in (BOTTLE, FLASK, JAR)]
    bands = ((0.0388, 0.05, 0.12), (0.0508, 0.03, 0.075), (0.0588, 0.03, 0.10))  # radius, bottom, top
    labels = [lathe([(q, bottom), (q, top)], segments) for q, bottom, top in bands]
    for y, z, count in ((TOP_Y + 0.03, 0.33, 11), (TOP_Y + 0.0, 0.55, 9 if detail else 5),
                        (1.32, -0.70, 12 if detail else 8), (1.68, -0.70, 12 if detail else 8)):
        run = int(r.integers(0, 3))
        for k in range(count):
            if r.random() < 0.3:
                run = int(r.integers(0, 3))
            x = (k - (count - 1) / 2) * 2.3 / count + r.uniform(-0.015, 0.015)
            place = translate(x, y, z + r.uniform(-0.02, 0.02))
            m = place @ rotate_y(r.uniform(0, 6.28)) @ scale(r.uniform(0.92, 1.08))
            model.add(M.BOTTLES[int(r.integers(0, 5))], shapes[run], m)
            if detail and r.random() < 0.6:
                model.add(M.LABEL, labels[run], m)
    model.add(M.TIMBER, bevel_box(2.4, 0.03, 0.14, 0.004), translate(0, TOP_Y + 0.015, 0.33))
    for y in (1.30, 1.66):
        model.add(M.TIMBER, bevel_box(2.7, 0.024, 0.24, 0.004).with_uv_offset(y, 0.2), translate(0, y, -0.70))
    return model


def hanging_cloth(width, drop, seed, columns=9, rows=6):
    """A scarf over a rail at the origin: folds that deepen downwards."""
    r = rng(seed)
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, columns), np.linspace(0, 1, rows), indexing="ij")
    phase, waves = r.uniform(0, 6), r.uniform(1.5, 2.6)
    depth = 0.012 + 0.03 * v
    x = u * width * (1 - 0.16 * v) + 0.008 * np.sin(7 * v + phase)
    z = depth * np.sin(2 * math.pi * waves * u + phase + 0.8 * v) + 0.02
    return surface(np.stack([x, -v * drop, z], -1), np.stack([u * width, v * drop], -1), swap=True)


def cloth(name, seed, detail):
    """Scarves on two rails, folded piles on the counter."""
    model, r = Model(name), rng(seed)
    for rail, (y, z) in enumerate(((2.06, 0.78), (2.12, -0.25))):
        model.add(M.STEEL, sweep([(-1.4, y + 0.012, z), (1.4, y + 0.012, z)], 0.012, 6))
        for k in range(7 if rail else 5):
            x = (k - (3 if rail else 2)) * (0.38 if rail else 0.55) + r.uniform(-0.05, 0.05)
            drop = r.uniform(0.75, 1.05) if rail else r.uniform(0.42, 0.62)
            color = M.SCARVES[int(r.integers(0, 6))]
            scarf = hanging_cloth(r.uniform(0.26, 0.34), drop, seed * 31 + k + 9 * rail,
                                  9 if detail else 6, 6 if detail else 3)
            model.add(color, scarf, translate(x, y + 0.026, z))
    for k in range(6):
        x, y = (k - 2.5) * 0.4, TOP_Y
        for level in range(int(r.integers(3, 7))):
            h = r.uniform(0.022, 0.034)
            model.add(M.SCARVES[int(r.integers(0, 6))],
                      bevel_box(r.uniform(0.29, 0.33), h, r.uniform(0.24, 0.28), 0.010),
                      translate(x, y + h / 2, 0.40) @ rotate_y(r.uniform(-0.08, 0.08)))
            y += h
    return model


def _bowl(radius, height):
    out = [(0, 0), (radius * 0.4, 0), (radius * 0.7, height * 0.3), (radius * 0.93, height * 0.75),
           (radius, height)]
    return out + [(radius * 0.95, height), (radius * 0.85, height * 0.7), (radius * 0.5, height * 0.3),
                  (0, height * 0.2)]


def _vase(radius, height, neck):
    t = np.linspace(0, 1, 9)
    body = 0.45 + 0.55 * np.sin(np.pi * t ** 0.85) - (0.45 - neck) * t ** 3
    out = [(0, 0)] + [(radius * b, height * k) for b, k in zip(body, t)]
    return out + [(out[-1][0] - 0.008, height), (out[-1][0] - 0.014, height * 0.85)]


def pottery(name, seed, detail):
    """Bowls in stacks, vases and jars in four glazes, on counter, shelf and ground."""
    model, r = Model(name), rng(seed)
    segments = (6, 8, 20)[detail]
    sizes = ((0.085, 0.06), (0.11, 0.075), (0.065, 0.07))
    nested = [lathe(_bowl(*s)[1:5], segments, 45)
              for s in sizes]  # of a stack's lower bowls the outside is enough
    bowls = [lathe(_bowl(*s), segments, 45) for s in sizes]
    shapes = ((0.09, 0.26, 0.4), (0.075, 0.36, 0.3), (0.12, 0.2, 0.55))
    vases = [lathe(_vase(*s), segments, 50) for s in shapes]
    big = lathe(_vase(0.24, 0.62, 0.5), segments + 2, 50)
    for k in range(9):
        x = (k - 4) * 0.27 + r.uniform(-0.03, 0.03)
        glaze = M.GLAZES[int(r.integers(0, 4))]
        if k % 3 == 1:
            model.add(glaze, vases[int(r.integers(0, 3))],
                      translate(x, TOP_Y, 0.40) @ scale(r.uniform(0.85, 1.05)))
            continue
        shape, y = int(r.integers(0, 3)), TOP_Y
        stack = int(r.integers(2, 5))
        for level in range(stack):
            model.add(glaze, (bowls if level == stack - 1 else nested)[shape],
                      translate(x, y, 0.42) @ rotate_y(r.uniform(0, 6)) @ rotate_x(r.uniform(-0.03, 0.03)))
            y += 0.024
    for y in (1.32, 1.70):
        model.add(M.TIMBER, bevel_box(2.7, 0.024, 0.26, 0.004).with_uv_offset(y, 0.4),
                  translate(0, y - 0.02, -0.70))
        for k in range(6 if detail else 4):
            glaze, vase = M.GLAZES[int(r.integers(0, 4))], vases[int(r.integers(0, 3))]
            place = translate((k - 2.5) * 0.42 + r.uniform(-0.04, 0.04), y - 0.008, -0.70)
            model.add(glaze, vase, place @ scale(r.uniform(0.75, 1.0)))
    for x in (-1.05, -0.55, 1.02):
        model.add(M.GLAZES[int(r.integers(0, 4))], big, translate(x, 0, 1.05) @ scale(r.uniform(0.75, 1.0)))
    return model


def stool(model, material, matrix):
    model.add(material, cylinder(0.16, 0.03, 14, 0.008), matrix @ translate(0, 0.42, 0))
    for k in range(4):
        a = math.pi / 4 + k * math.pi / 2
        foot, top = (0.17 * math.cos(a), 0, 0.17 * math.sin(a)), (0.11 * math.cos(a), 0.425,
                                                                  0.11 * math.sin(a))
        model.add(material, sweep([foot, top], [0.018, 0.014], 4), matrix)
    model.add(material, torus(0.135, 0.008, 12, 4), matrix @ translate(0, 0.2, 0))


def noodles(name, seed, detail):
    """Stock pots with lids, bowls, chopstick jars; stools in front."""
    model, r = Model(name), rng(seed)
    segments = (8, 13, 32)[detail]
    pot = [(0, 0), (0.2, 0), (0.205, 0.006), (0.205, 0.30), (0.214, 0.304), (0.214, 0.312), (0.198, 0.314),
           (0.198, 0.25), (0, 0.245)]
    lid = [(0.0, 0.0), (0.21, 0.0), (0.21, 0.01), (0.12, 0.045), (0.03, 0.055), (0.026, 0.075), (0.03, 0.085),
           (0, 0.09)]
    for k, x in enumerate((-0.95, -0.48, 0.0)):
        model.add(M.STEEL, lathe(pot, segments, 40),
                  translate(x, TOP_Y, 0.30) @ scale(1, 1 + 0.12 * (k % 2), 1))
        if k != 1:
            model.add(M.STEEL, lathe(lid, segments, 40),
                      translate(x, TOP_Y + 0.312 * (1 + 0.12 * (k % 2)), 0.30))
        for s in (-1, 1):
            ear = [(0, 0.22, 0.205), (-0.05, 0.23, 0.205), (-0.05, 0.23, 0.245), (0.05, 0.23, 0.245),
                   (0.05, 0.23, 0.205)]
            model.add(M.STEEL, sweep(ear[1:], 0.007, 5),
                      translate(x, TOP_Y, 0.30) @ rotate_y(s * math.pi / 2))
    bowl = lathe(_bowl(0.095, 0.075), (6, 9, 18)[detail], 45)
    nested = lathe(_bowl(0.095, 0.075)[1:5], (6, 9, 18)[detail], 45)
    for k in range(4):
        glaze = M.GLAZES[(k + seed) % 4]
        y = TOP_Y
        stack = int(r.integers(3, 7))
        for level in range(stack):
            model.add(glaze, bowl if level == stack - 1 else nested,
                      translate(0.40 + 0.23 * k, y, 0.34) @ rotate_y(r.uniform(0, 6)))
            y += 0.026
    for x in (0.45, 0.95):
        model.add(M.GLAZES[2], lathe([(0, 0), (0.035, 0), (0.038, 0.1), (0.032, 0.1), (0.03, 0.05)], 12, 40),
                  translate(x, TOP_Y, 0.62))
        for _ in range(5 if detail else 0):
            tilt = rotate_y(r.uniform(0, 6.28)) @ rotate_x(r.uniform(0.05, 0.2))
            model.add(M.CRATE, bevel_box(0.006, 0.2, 0.006, 0.001), translate(x, TOP_Y + 0.12, 0.62) @ tilt)
    for k in range(4 if detail else 2):
        stool(model, M.PLASTIC[seed % 2],
              translate(-0.95 + 0.62 * k + r.uniform(-0.08, 0.08), 0, 1.25 + r.uniform(-0.1, 0.12)))
    return model
