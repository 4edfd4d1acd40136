"""Stall bodies: posts, counter, curtain, awning. Local frame: X along the lane, +Z to the customer, floor y
= 0; footprint 2.9 x 1.8 m, the awning reaches 0.65 m beyond it."""
import math

import numpy as np

from kit.mesh import Model
from kit.noise import rng
from kit.shapes import bar, bevel_box, surface, sweep
from kit.transform import rotate_y, rotate_z, translate

from . import materials as M
from .goods import crate

HALF_WIDTH_M = 1.45
BACK_Z, FRONT_Z, AWNING_Z = -0.88, 0.85, 1.50
BACK_Y, FRONT_Y = 2.78, 2.28
BRACKET_Y, BRACKET_Z = 2.36, 1.83  # where a lantern hangs in front of the valance


def awning_y(z):
    """Height of the awning's frame at depth z."""
    return BACK_Y + (FRONT_Y - BACK_Y) * (z - BACK_Z) / (AWNING_Z - BACK_Z)


def body(name, paint, curtain, seed, near):
    """`near`: bevelled; the far ones have plain boxes and fewer folds."""
    model, r, b = Model(name), rng(seed), 1 if near else 0
    for x in (-1, 1):
        model.add(M.TIMBER, bevel_box(0.07, BACK_Y, 0.07, 0.006 * b).with_uv_offset(r.random(), r.random()),
                  translate(x * (HALF_WIDTH_M - 0.04), BACK_Y / 2, BACK_Z))
        front = awning_y(FRONT_Z)
        model.add(M.TIMBER, bevel_box(0.07, front, 0.07, 0.006 * b).with_uv_offset(r.random(), r.random()),
                  translate(x * (HALF_WIDTH_M - 0.04), front / 2, FRONT_Z))
        model.add(M.TIMBER, bar((x * 1.41, BACK_Y - 0.03, BACK_Z - 0.04),
                                (x * 1.41, FRONT_Y - 0.01, AWNING_Z), 0.05, 0.05, 0.005 * b))
    for z in (BACK_Z, FRONT_Z):
        y = awning_y(z) - 0.07
        model.add(M.TIMBER, bar((-1.44, y, z), (1.44, y, z), 0.05, 0.06, 0.005 * b))
    # Counter: boarded front, thick top.
    boards = 6
    for k in range(boards):
        w = 2.6 / boards
        board = bevel_box(w - 0.006, 0.82 + r.uniform(-0.008, 0.008), 0.025, 0.004 * b)
        model.add(paint, board, translate((k - (boards - 1) / 2) * w, 0.45, 0.74 + r.uniform(-0.003, 0.003)))
    model.add(M.TIMBER, bevel_box(2.72, 0.045, 0.78, 0.008 * b).with_uv_offset(r.random(), r.random()),
              translate(0, 0.8975, 0.40))
    for y, height in ((0.80, 0.10), (0.08, 0.09)):
        model.add(M.TIMBER, bevel_box(2.64, height, 0.02, 0.005 * b), translate(0, y, 0.762))
    for k in range(3):  # price cards along the edge
        card = bevel_box(0.13, 0.17, 0.004, 0).at(rotate_z(r.uniform(-0.06, 0.06)))
        model.add(M.LABEL, card, translate(-0.9 + 0.8 * k + r.uniform(-0.2, 0.2), 0.70, 0.778))
    for x in (-1.3, 1.3):
        model.add(paint, bevel_box(0.03, 0.86, 0.66, 0.004 * b), translate(x, 0.44, 0.41))
    model.add(curtain, drape(2.76, 2.5, seed, 21 if near else 15, 6 if near else 4),
              translate(0, BACK_Y - 0.12, BACK_Z + 0.05))
    for x in (-1, 1):
        if r.random() < 0.75:
            # Drawn back to the rear half, so that the counter is open to the side.
            side = drape(0.62, r.uniform(1.3, 2.3), seed + 7 + x, 9, 4)
            model.add(curtain, side, translate(x * 1.40, 2.55, -0.52) @ rotate_y(x * math.pi / 2))
    return model


def bracket():
    """Iron arm from the awning's frame to a hook."""
    model = Model("bracket")
    arm = [(0, FRONT_Y + 0.06, 1.2), (0, BRACKET_Y + 0.02, 1.6), (0, BRACKET_Y, BRACKET_Z),
           (0, BRACKET_Y - 0.04, BRACKET_Z)]
    return model.add(M.IRON, sweep(arm, 0.011, 4))


def drape(width, drop, seed, columns=21, rows=6):
    """Curtain that hangs from y = 0: regular folds, irregular hem."""
    r = rng(seed)
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, columns), np.linspace(0, 1, rows), indexing="ij")
    phase = r.uniform(0, 6)
    fold = np.sin(2 * math.pi * 4.5 * u * width / 2.76 + phase + 0.5 * np.sin(5 * u + 2 * v))
    z = fold * (0.018 + 0.035 * v)
    y = -v * drop * (1 + 0.012 * np.sin(9 * u + phase))
    return surface(np.stack([u * width, y, z], -1), np.stack([u * width, v * drop], -1), swap=True)


def awning(name, canvas, seed):
    """Canvas over the frame: sags between three rafters, ends in a scalloped valance."""
    model, r = Model(name), rng(seed)
    columns, rows = 21, 6
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, columns), np.linspace(0, 1, rows), indexing="ij")
    width = 3.04
    between = np.abs(np.sin(2 * math.pi * u)) * np.sin(math.pi * np.clip(v * 1.02, 0, 1))
    z = BACK_Z - 0.08 + (AWNING_Z + 0.02 - BACK_Z + 0.08) * v
    y = awning_y(z) + 0.035 - (0.055 + r.uniform(0, 0.05)) * between + 0.006 * np.sin(13 * u + 5 * v + seed)
    sheet = surface(np.stack([u * width, y, z], -1), np.stack([u * width, v * 2.45], -1), swap=True)
    model.add(canvas, sheet)
    columns = 37
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, columns), np.linspace(0, 1, 3), indexing="ij")
    scallop = 0.13 + 0.07 * np.abs(np.sin(math.pi * 6 * (u + 0.5)))
    wave = 0.018 * np.sin(2 * math.pi * 5 * u + seed) * v
    edge_z = AWNING_Z + 0.02
    points = np.stack([u * width, awning_y(edge_z) + 0.035 - v * scallop, edge_z + 0.004 + wave], -1)
    model.add(canvas, surface(points, np.stack([u * width, 2.45 + v * 0.2], -1), swap=True))
    pole = [(-1.5, FRONT_Y + 0.02, AWNING_Z), (1.5, FRONT_Y + 0.02, AWNING_Z)]
    model.add(M.IRON, sweep(pole, 0.016, 6))
    return model


def clutter(name, seed):
    """Boxes, sacks and crates that stand beside a stall."""
    model, r = Model(name), rng(seed)
    y = 0.0
    for _ in range(int(r.integers(2, 5))):
        place = translate(r.uniform(-0.03, 0.03), y,
                          r.uniform(-0.03, 0.03)) @ rotate_y(r.uniform(-0.15, 0.15))
        crate(model, place, 0.52, 0.36, 0.26, int(r.integers(0, 999)), 1)
        y += 0.265
    for k in range(2):
        size = r.uniform(0.28, 0.42)
        model.add(M.CARDBOARD, bevel_box(size * 1.2, size, size, 0.005),
                  translate(0.55, size / 2, -0.2 + 0.45 * k) @ rotate_y(r.uniform(-0.4, 0.4)))
    return model
