"""What is shown: framed pictures, sculptures of spheres and rings, a glass case; and the bench, ropes,
plinths."""
import math

import numpy as np

from kit.material import Material
from kit.mesh import Model
from kit.shapes import bevel_box, cylinder, lathe, quad, sphere, sweep, torus
from kit.transform import rotate_x, rotate_y, rotate_z, translate

from . import materials as M


def picture(name, key, width, height, frame):
    """Hangs at the origin on a wall behind it, facing +Z: canvas in a float frame, with its label."""
    model = Model(name)
    model.add(M.PICTURES[key], quad(width, height, unit_uv=True), translate(0, 0, 0.038))
    model.add(M.PAPER, bevel_box(width, height, 0.034, 0.003), translate(0, 0, 0.0205))
    depth, face, gap = 0.05, 0.022, 0.012
    for side in (-1, 1):
        x, y = side * (width / 2 + gap + face / 2), side * (height / 2 + gap + face / 2)
        model.add(frame, bevel_box(height + 2 * (gap + face), face, depth, 0.003).with_uv_offset(side, 0.3),
                  translate(x, 0, depth / 2) @ rotate_z(math.pi / 2))
        model.add(frame, bevel_box(width + 2 * gap, face, depth, 0.003).with_uv_offset(0.2, side),
                  translate(0, y, depth / 2))
    model.add(M.BLACK_METAL, bevel_box(width + 2 * gap, height + 2 * gap, 0.004, 0.001),
              translate(0, 0, 0.003))
    model.add(M.PAPER, bevel_box(0.14, 0.09, 0.006, 0.0015),
              translate(width / 2 + 0.22, -height / 2 + 0.10, 0.003))
    return model


def plinth(width, height):
    model = Model("plinth")
    model.add(M.RUBBER, bevel_box(width - 0.05, 0.04, width - 0.05, 0.002), translate(0, 0.02, 0))
    model.add(M.PLINTH, bevel_box(width, height - 0.03, width, 0.004),
              translate(0, 0.03 + (height - 0.03) / 2, 0))
    return model


def sculpture_orbit(material):
    """A sphere rests in a leaning ring."""
    model = Model("orbit")
    model.add(M.BLACK_METAL, cylinder(0.13, 0.03, 48, 0.004))
    model.add(material, torus(0.235, 0.045, 96, 32), translate(0, 0.29, 0) @ rotate_z(0.35) @ rotate_x(1.25))
    model.add(material, sphere(0.15, 64, 32), translate(0.0, 0.18, 0.0))
    return model


def sculpture_gate(material):
    """A standing ring holds a sphere above its centre."""
    model = Model("gate")
    model.add(material, cylinder(0.11, 0.035, 64, 0.005))
    model.add(material, torus(0.25, 0.05, 112, 36), translate(0, 0.325, 0) @ rotate_x(math.pi / 2))
    model.add(material, sphere(0.105, 64, 32), translate(0, 0.23 + 0.02, 0))
    model.add(material, torus(0.13, 0.018, 72, 16), translate(0, 0.36, 0) @ rotate_z(0.9) @ rotate_x(0.5))
    return model


def sculpture_stack(material):
    """Rings and a sphere, stacked like stones on a shore."""
    model = Model("stack")
    model.add(material, torus(0.165, 0.075, 96, 36), translate(0, 0.075, 0))
    model.add(material, torus(0.10, 0.055, 80, 32), translate(0.02, 0.19, 0.01) @ rotate_z(0.12))
    model.add(material, sphere(0.115, 64, 32), translate(0.0, 0.345, 0.0))
    model.add(material, torus(0.045, 0.02, 56, 20), translate(-0.01, 0.475, 0) @ rotate_z(-0.1))
    return model


def bowl_profile(radius, height, wall=0.006):
    t = np.linspace(0, 1, 12)
    outside = [(0, 0), (radius * 0.34, 0), (radius * 0.36, 0.008)]
    outside += [(radius * (0.36 + 0.64 * math.sin(a)), 0.008 + (height - 0.008) * (1 - math.cos(a)) ** 0.9)
                for a in t[1:] * math.pi / 2]
    inside = [(r - wall, max(y, wall + 0.008)) for r, y in reversed(outside[3:])]
    return outside + inside + [(0, wall + 0.01)]


def vase_profile(radius, height):
    t = np.linspace(0, 1, 22)
    body = 0.42 + 0.58 * np.sin(np.pi * np.clip(t * 1.05, 0, 1)) ** 0.8 - 0.30 * t ** 3
    body = np.where(t > 0.88, body + (t - 0.88) * 1.6, body)
    outside = [(0, 0), (radius * 0.40, 0)]
    outside += [(radius * b, height * (0.01 + 0.99 * k)) for b, k in zip(body, t)]
    rim = outside[-1]
    return outside + [(rim[0] - 0.004, rim[1] + 0.001), (rim[0] - 0.008, rim[1] - 0.004),
                      (rim[0] - 0.012, height * 0.8)]


def glass_case():
    """Vitrine on a black foot: brass edges, thin panes, three vessels on steps, a lamp rail in the lid."""
    model = Model("glass case")
    w, d, base, top = 1.0, 0.55, 0.86, 1.50
    model.add(M.BLACK_METAL, bevel_box(w - 0.12, 0.05, d - 0.12, 0.003), translate(0, 0.025, 0))
    model.add(M.PLINTH, bevel_box(w, base - 0.05, d, 0.005), translate(0, 0.05 + (base - 0.05) / 2, 0))
    model.add(M.BRASS, bevel_box(w + 0.012, 0.02, d + 0.012, 0.003), translate(0, base - 0.01, 0))
    for sx in (-1, 1):
        for sz in (-1, 1):
            model.add(M.BRASS, bevel_box(0.012, top - base, 0.012, 0.002),
                      translate(sx * (w / 2 - 0.006), (base + top) / 2, sz * (d / 2 - 0.006)))
    model.add(M.BRASS, bevel_box(w + 0.004, 0.05, d + 0.004, 0.003), translate(0, top + 0.025, 0))
    for sx in (-1, 1):
        side = translate(sx * (w / 2 - 0.003), (base + top) / 2, 0) @ rotate_y(sx * math.pi / 2)
        front = translate(0, (base + top) / 2, sx * (d / 2 - 0.003)) @ rotate_y(0 if sx > 0 else math.pi)
        model.add(M.GLASS, quad(d - 0.02, top - base), side)
        model.add(M.GLASS, quad(w - 0.02, top - base), front)
    model.add(M.VELVET, bevel_box(w - 0.03, 0.006, d - 0.03, 0.002), translate(0, base + 0.003, 0))
    for x, h in ((-0.29, 0.05), (0.02, 0.11), (0.31, 0.05)):
        model.add(M.PLINTH, bevel_box(0.2, h, 0.2, 0.003), translate(x, base + 0.006 + h / 2, -0.02))
    model.add(M.CELADON, lathe(vase_profile(0.075, 0.24), 48, 50), translate(-0.29, base + 0.056, -0.02))
    model.add(M.OXBLOOD, lathe(vase_profile(0.085, 0.17), 48, 50), translate(0.02, base + 0.116, -0.02))
    model.add(M.CLAY, lathe(bowl_profile(0.10, 0.085), 48, 50), translate(0.31, base + 0.056, -0.02))
    for k, (x, z) in enumerate(((-0.13, 0.15), (0.16, 0.16), (0.22, 0.12))):
        model.add(M.POLISHED_BRASS, sphere(0.022 - 0.004 * k, 24, 12),
                  translate(x, base + 0.028 - 0.004 * k, z))
    return model


def bench():
    model = Model("bench")
    for k in range(5):
        z = (k - 2) * 0.098
        model.add(M.OAK, bevel_box(2.0, 0.05, 0.09, 0.006).with_uv_offset(0.31 * k, 0.17 * k),
                  translate(0, 0.425, z))
    for x in (-0.75, 0.75):
        model.add(M.BLACK_METAL, bevel_box(0.05, 0.012, 0.46, 0.003), translate(x, 0.394, 0))
        model.add(M.BLACK_METAL, bevel_box(0.05, 0.012, 0.46, 0.003), translate(x, 0.006, 0))
        for z in (-0.224, 0.224):
            model.add(M.BLACK_METAL, bevel_box(0.05, 0.39, 0.012, 0.003), translate(x, 0.2, z))
    return model


def rope_line(posts):
    """Brass posts [(x, z)...] with a velvet rope sagging between them."""
    model = Model("ropes")
    for x, z in posts:
        foot = lathe([(0, 0), (0.155, 0), (0.16, 0.006), (0.15, 0.016), (0.05, 0.03), (0.02, 0.05),
                      (0.016, 0.08), (0.016, 0.90), (0.024, 0.905), (0.024, 0.94), (0.016, 0.945),
                      (0.03, 0.975), (0.026, 0.995), (0, 1.005)], 40, 30)
        model.add(M.POLISHED_BRASS, foot, translate(x, 0, z))
    for (x0, z0), (x1, z1) in zip(posts, posts[1:]):
        t = np.linspace(0, 1, 20)
        y = 0.90 - 0.24 * (1 - (2 * t - 1) ** 2)
        path = np.stack([x0 + (x1 - x0) * t, y, z0 + (z1 - z0) * t], -1)
        model.add(M.VELVET, sweep(path, 0.018, 12))
    return model


def side_table():
    """Small round table with books beside the pendants."""
    model = Model("side table")
    model.add(M.OAK, lathe([(0, 0.70), (0.315, 0.70), (0.33, 0.71), (0.33, 0.722), (0.322, 0.73), (0, 0.73)],
                           56, 40))
    model.add(M.BLACK_METAL, cylinder(0.022, 0.69, 20), translate(0, 0.012, 0))
    model.add(M.BLACK_METAL, cylinder(0.2, 0.014, 48))
    y = 0.73
    covers = (M.VELVET, M.PLINTH, M.BLACK_FRAME)
    for k, (w, d, h, turn) in enumerate(((0.30, 0.24, 0.028, 0.2), (0.27, 0.22, 0.022, -0.12),
                                         (0.22, 0.16, 0.018, 0.5))):
        place = translate(-0.05, y + h / 2, 0.03) @ rotate_y(turn)
        model.add(covers[k], bevel_box(w, h, d, 0.002), place)
        model.add(M.PAPER, bevel_box(w - 0.006, h - 0.008, d + 0.001, 0.001), place @ translate(0.005, 0, 0))
        y += h
    model.add(M.CELADON, lathe(vase_profile(0.05, 0.15), 40, 50), translate(0.19, 0.73, -0.08))
    return model


def video_wall(light, emission):
    """Screen in a thin black case that hangs on a wall behind it and faces +Z."""
    model = Model("video wall")
    mean = emission.mean(axis=(0, 1))
    nit = tuple(float(v) for v in np.asarray(light.face_nit()) / mean)
    # One strength for all channels: the map holds the colours, its mean is the light's radiance.
    face = Material("screen", (0.01, 0.01, 0.01), 0.25, emission_nit=(max(nit),) * 3, emission_map=emission)
    model.add(face, quad(light.width_m, light.height_m, unit_uv=True), translate(0, 0, 0.056))
    model.add(M.BLACK_METAL, bevel_box(light.width_m + 0.03, light.height_m + 0.03, 0.05, 0.004),
              translate(0, 0, 0.03))
    return model
