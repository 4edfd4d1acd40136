"""Furniture of stores and workshops: crates, drums, racks, tables, columns, screens, cabinets. Models stand
on y = 0 about the origin; wide sides face +Z."""
import math

from kit.material import Material
from kit.mesh import Model
from kit.noise import rng
from kit.shapes import bevel_box, cylinder, lathe, rod, sphere, torus
from kit.transform import rotate_x, rotate_y, rotate_z, translate

from . import materials as M


def box(model, material, sx, sy, sz, x, y, z, turn=0.0, bevel=0.005):
    """Box whose underside is at y."""
    model.add(material, bevel_box(sx, sy, sz, bevel).with_uv_offset(0.37 * x + 0.21 * y, 0.43 * z + 0.7 * y),
              translate(x, y + sy / 2, z) @ rotate_y(turn))


def crate(timber, name="crate", size=0.6):
    """Board box with battens."""
    model, s = Model(name), size
    box(model, timber, s, s * 0.82, s, 0, 0.02, 0)
    for y in (0.06, s * 0.82 - 0.07):
        box(model, timber, s + 0.03, 0.06, s + 0.03, 0, y, 0)
    return model


def pile(crate_model, size, seed):
    """Two or three crates, the upper one turned."""
    model, r = Model(f"pile {seed}"), rng(seed)
    high, gap = size * 0.82 + 0.02, size * 0.56
    model.include(crate_model, translate(-gap, 0, 0) @ rotate_y(r.uniform(-0.12, 0.12)))
    model.include(crate_model, translate(gap, 0, r.uniform(-0.1, 0.1)) @ rotate_y(r.uniform(-0.15, 0.15)))
    if r.random() < 0.7:
        model.include(crate_model, translate(r.uniform(-0.2, 0.2), high, 0) @ rotate_y(r.uniform(-0.4, 0.4)))
    return model


def drum(paint):
    model, r, h = Model("drum " + paint.name), 0.28, 0.86
    profile = [(0, 0), (r - 0.01, 0), (r, 0.012), (r, 0.28), (r + 0.012, 0.29), (r, 0.30), (r, 0.57),
               (r + 0.012, 0.58), (r, 0.59), (r, h - 0.012), (r - 0.01, h), (r - 0.02, h - 0.015),
               (0, h - 0.015)]
    return model.add(paint, lathe(profile, 14, 60))


def rack(seed, paints, width=1.8, height=2.0, depth=0.45):
    """Steel shelves with boxes on them."""
    model, r = Model(f"rack {seed}"), rng(seed)
    for sx in (-1, 1):
        for sz in (-1, 1):
            box(model, M.BLACK_METAL, 0.04, height, 0.04, sx * (width / 2 - 0.02), 0, sz * (depth / 2 - 0.02),
                0,
                0.003)
    for level in (0.12, 0.72, 1.32, height - 0.06):
        box(model, M.STEEL, width - 0.02, 0.03, depth - 0.02, 0, level, 0, 0, 0.003)
        x = -width / 2 + 0.1
        while x < width / 2 - 0.45 and level < height - 0.2:
            w, h = r.uniform(0.22, 0.42), r.uniform(0.16, 0.42)
            if r.random() < 0.8:
                box(model, paints[int(r.integers(0, len(paints)))], w, h, r.uniform(0.26, 0.36), x + w / 2,
                    level + 0.031, r.uniform(-0.03, 0.03), r.uniform(-0.06, 0.06), 0.004)
            x += w + r.uniform(0.04, 0.16)
    return model


def table(timber, seed, length=1.6, depth=0.75):
    """Work table with a bowl, a ball and a box."""
    model, r = Model(f"table {seed}"), rng(seed)
    box(model, timber, length, 0.04, depth, 0, 0.71, 0, 0, 0.006)
    for sx in (-1, 1):
        for sz in (-1, 1):
            box(model, M.BLACK_METAL, 0.05, 0.71, 0.05, sx * (length / 2 - 0.08), 0, sz * (depth / 2 - 0.08),
                0,
                0.004)
    bowl = [(0, 0), (0.05, 0), (0.12, 0.04), (0.16, 0.10), (0.15, 0.10), (0.11, 0.045), (0, 0.012)]
    model.add(M.PORCELAIN, lathe(bowl, 14, 50), translate(r.uniform(-0.5, -0.2), 0.75, r.uniform(-0.1, 0.15)))
    model.add(M.BRASS, sphere(0.09, 12, 6), translate(r.uniform(0.0, 0.2), 0.84, r.uniform(-0.15, 0.15)))
    box(model, M.CARDBOARD, 0.3, 0.2, 0.24, length / 2 - 0.3, 0.751, 0, r.uniform(-0.5, 0.5))
    return model


def bench(timber):
    model = Model("bench")
    for k in (-1, 0, 1):
        box(model, timber, 1.5, 0.045, 0.125, 0, 0.405, 0.135 * k)
    for x in (-0.55, 0.55):
        box(model, M.BLACK_METAL, 0.06, 0.404, 0.36, x, 0, 0, 0, 0.004)
    return model


def column(material, height, radius=0.2, round_shape=True):
    """From the floor into the ceiling, with a base."""
    model = Model("column")
    if round_shape:
        model.add(material, lathe([(radius, -0.02), (radius, height + 0.02)], 22, 40))
        return model.add(M.SKIRTING, cylinder(radius + 0.03, 0.1, 22, 0.008))
    box(model, material, 2 * radius, height + 0.04, 2 * radius, 0, -0.02, 0, 0, 0.012)
    box(model, M.SKIRTING, 2 * radius + 0.04, 0.12, 2 * radius + 0.04, 0, -0.01, 0, 0, 0.006)
    return model


def ornament(material, seed):
    """A ring around a ball on a plinth."""
    model = Model(f"ornament {seed}")
    box(model, M.PLASTER, 0.42, 0.95, 0.42, 0, 0, 0)
    model.add(material, torus(0.20, 0.035, 22, 8), translate(0, 1.18, 0) @ rotate_z(0.4) @ rotate_x(1.1))
    return model.add(material, sphere(0.13, 14, 8), translate(0, 1.075, 0))


def screen(panel, width, height):
    """Folding-free partition on two feet; its panel is opaque."""
    model = Model("screen")
    box(model, panel, width, height - 0.06, 0.03, 0, 0.06, 0, 0, 0.004)
    for s in (-1, 1):
        box(model, M.BLACK_METAL, 0.04, height, 0.05, s * (width / 2 + 0.01), 0, 0, 0, 0.004)
        box(model, M.BLACK_METAL, 0.06, 0.03, 0.42, s * (width / 2 + 0.01), 0, 0, 0, 0.004)
    return model


def cabinet(paint, width=1.0, height=1.9, depth=0.7):
    """Closed steel cabinet: a skin around whatever shines inside, two door leaves with handles."""
    model = Model("cabinet")
    box(model, paint, width, height - 0.05, depth, 0, 0.05, 0, 0, 0.006)
    box(model, M.SKIRTING, width - 0.06, 0.06, depth - 0.06, 0, 0, 0, 0, 0.003)
    for s in (-1, 1):
        box(model, paint, width / 2 - 0.02, height - 0.12, 0.02, s * width / 4, 0.085, depth / 2 + 0.008, 0,
            0.005)
        model.add(M.STEEL, rod((s * 0.05, height * 0.45, depth / 2 + 0.04),
                               (s * 0.05, height * 0.55, depth / 2 + 0.04), 0.008, 6))
    return model


def door(paint):
    """Closed leaf in a frame, mounted on a wall behind it (facing +Z): a mock for the eye, the wall is
    whole."""
    model = Model("door")
    box(model, M.BLACK_METAL, 1.06, 2.13, 0.05, 0, -0.005, 0.015, 0, 0.004)
    box(model, paint, 0.94, 2.06, 0.04, 0, 0.01, 0.03, 0, 0.006)
    return model.add(M.STEEL, rod((0.36, 1.02, 0.09), (0.24, 1.02, 0.09), 0.01, 6))


def pipe(points, radius=0.05, material=M.STEEL):
    """Pipe along a straight line with collars."""
    (x0, y0, z0), (x1, y1, z1) = points
    model = Model("pipe").add(material, rod(points[0], points[1], radius, 10))
    for t in (0.2, 0.5, 0.8):
        a, b = t - 0.006, t + 0.006
        ends = [(x0 + (x1 - x0) * k, y0 + (y1 - y0) * k, z0 + (z1 - z0) * k) for k in (a, b)]
        model.add(M.BLACK_METAL, rod(ends[0], ends[1], radius + 0.012, 10))
    return model


def painted(name, color, roughness=0.35):
    return Material(name, color, roughness)
