"""The walls: a court of flagstones, an arcade of five arches along its back, a room behind with one doorway. X runs right,
Z towards the visitor, the court's floor is y = 0; columns stand on z = 0, the room's wall on z = -3."""
import math

import numpy as np

from kit.mesh import Model
from kit.noise import rng
from kit.shapes import bar, bevel_box, block, lathe, oriented, surface, sweep
from kit.transform import rotate_x, rotate_y, translate

from . import materials as M

BAYS, BAY_M = 5, 2.4
HALF = BAYS * BAY_M / 2                    # the arcade's half width
SPRING_Y, CEILING_Y, TOP_Y = 2.15, 3.62, 5.0
COLUMN_R = 0.17
ARCH_R = BAY_M / 2 - 0.2
ROOM_X, ROOM_Z, ROOM_Y = 3.4, -7.6, 3.1    # half width, back, ceiling
WALL_Z = -3.0                              # arcade side of the room's wall
DOOR_X, DOOR_Y = (-0.55, 0.65), 2.25
COURT_Z = 9.4
STEP_Y = 0.14                              # the arcade's floor above the court's


def column():
    """Base, shaft with a slight swelling, capital; stands on the step."""
    model, r = Model("column"), COLUMN_R
    top = SPRING_Y - STEP_Y
    shaft = [(r * (1.0 - 0.13 * t ** 2) + 0.006 * math.sin(math.pi * t), 0.26 + (top - 0.5) * t)
             for t in np.linspace(0, 1, 7)]
    profile = [(0, 0.1), (r + 0.07, 0.1), (r + 0.085, 0.135), (r + 0.07, 0.17), (r + 0.02, 0.19), (r + 0.04, 0.22),
               (r + 0.02, 0.245), *shaft, (r + 0.0, top - 0.22), (r - 0.01, top - 0.19), (r + 0.015, top - 0.16),
               (r + 0.075, top - 0.09), (0, top - 0.09)]
    model.add(M.COLUMN, lathe(profile, 28, 40))
    model.add(M.COLUMN, bevel_box(0.54, 0.1, 0.54, 0.012), translate(0, 0.05, 0))
    return model.add(M.COLUMN, bevel_box(0.52, 0.1, 0.52, 0.012), translate(0, top - 0.045, 0))


def arch_sheet(depth_z, out, half, top):
    """Front (out = 1) or back of the wall over an arch: from the curve up to a straight edge."""
    angle = np.linspace(0, math.pi, 25)
    low = [(half, SPRING_Y)] + [(ARCH_R * math.cos(a), SPRING_Y + ARCH_R * math.sin(a)) for a in angle] + \
          [(-half, SPRING_Y)]
    high = [(half, top)] + [(half * math.cos(a), top) for a in angle] + [(-half, top)]
    points = np.array([[(x, y, depth_z), (x1, y1, depth_z)] for (x, y), (x1, y1) in zip(low, high)])
    uv = points[..., :2] * (1, -1)
    normals = np.broadcast_to((0.0, 0.0, float(out)), points.shape)
    return oriented(surface(points, uv, normals=normals))


def arch():
    """One bay of the wall that the columns carry, 0.4 m thick, with a moulding along its edge."""
    model, half, thick = Model("arch"), BAY_M / 2, 0.2
    for z, out in ((thick, 1), (-thick, -1)):
        model.add(M.OCHRE, arch_sheet(z, out, half, CEILING_Y + 0.1))
    angle = np.linspace(0, math.pi, 25)
    ring = np.array([[(ARCH_R * math.cos(a), SPRING_Y + ARCH_R * math.sin(a), z) for z in (thick, -thick)]
                     for a in angle])
    inwards = np.array([[(-math.cos(a), -math.sin(a), 0.0)] * 2 for a in angle])
    uv = np.stack([np.broadcast_to((angle * ARCH_R)[:, None], (25, 2)), ring[..., 2]], -1)
    model.add(M.CREAM, oriented(surface(ring, uv, normals=inwards)))
    under = bevel_box(half - ARCH_R + 0.02, 0.01, 0.4, 0.002)  # the rest of the springing, on the capital
    for s in (-1, 1):
        model.add(M.CREAM, under, translate(s * (half + ARCH_R) / 2, SPRING_Y + 0.004, 0))
        edge = [((ARCH_R + 0.05) * math.cos(a), SPRING_Y + (ARCH_R + 0.05) * math.sin(a), s * thick) for a in angle]
        model.add(M.COLUMN, sweep(edge, 0.045, 8))
    return model


def tiles():
    """Two rows of half-round tiles over the arcade's wall."""
    model, r = Model("roof tiles"), rng(5)
    half = np.linspace(0, math.pi, 7)
    for row in range(2):
        for k in range(int(2 * HALF / 0.2) + 3):
            x = -HALF - 0.2 + 0.2 * k + r.uniform(-0.008, 0.008)
            z = np.array([0.52, 0.0]) - 0.42 * row + r.uniform(-0.015, 0.015)
            y = TOP_Y + 0.12 + 0.17 * row + np.array([0.0, 0.2])
            points = np.array([[(x + 0.095 * math.cos(a), y[i] + 0.085 * math.sin(a), z[i]) for i in (0, 1)]
                               for a in half])
            normals = np.array([[(math.cos(a), math.sin(a), 0.1)] * 2 for a in half])
            normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
            uv = np.stack([np.broadcast_to((half * 0.1)[:, None], (7, 2)), points[..., 2]], -1) + (0.3 * k, 0.2 * row)
            model.add(M.TERRACOTTA, oriented(surface(points, uv, normals=normals)))
    block(model, M.OAK, -HALF - 0.3, HALF + 0.3, TOP_Y, TOP_Y + 0.1, -0.3, 0.48, 0.01)
    return model


def flags(scene, parent):
    """Flagstones in courses of unequal width, each a node of one of nine stones."""
    r = rng(31)
    widths = (0.46, 0.62, 0.84)
    stones = {}
    for i, width in enumerate(widths):
        for k, material in enumerate(M.FLAGS):
            mesh = bevel_box(width - 0.006, 0.12, 0.514, 0.007).with_uv_offset(0.31 * i, 0.47 * k)
            stones[i, k] = Model(f"flag {i}{k}").add(material, mesh)
    for row in range(int(COURT_Z / 0.52) + 1):
        x, z = -HALF - 0.15 - r.uniform(0, 0.4), 0.42 + 0.26 + 0.52 * row
        while x < HALF + 0.4:
            i, k = int(r.integers(0, 3)), int(r.integers(0, 3))
            x += widths[i]
            tilt = rotate_x(r.uniform(-0.006, 0.006)) @ rotate_y(math.pi * int(r.integers(0, 2)))
            scene.node("flag", parent, translate(x - widths[i] / 2, -0.06 + r.uniform(-0.004, 0.004), z) @ tilt,
                       stones[i, k])


def court():
    """What lies under the flags and stands about them: the step, the walls to the left, to the right and in front."""
    model = Model("court")
    block(model, M.JOINT, -HALF - 0.6, HALF + 0.6, -0.3, -0.035, 0, COURT_Z + 0.5)
    for k in range(10):  # the step's stones
        x = -HALF + 1.2 * k
        block(model, M.COLUMN, x + 0.004, x + 1.196, -0.1, STEP_Y, -0.32, 0.42, 0.015)
    block(model, M.FLAGS[0], -HALF, HALF, -0.1, STEP_Y - 0.004, WALL_Z, -0.3)
    block(model, M.OCHRE, -HALF - 0.5, -HALF, -0.1, 4.1, -0.2, COURT_Z + 0.5, 0.02)
    block(model, M.COLUMN, -HALF - 0.56, -HALF + 0.06, 4.1, 4.2, -0.2, COURT_Z + 0.5, 0.015)
    block(model, M.CREAM, HALF, HALF + 0.4, -0.1, 2.0, 0.2, COURT_Z + 0.5, 0.02)
    block(model, M.COLUMN, HALF - 0.06, HALF + 0.46, 2.0, 2.09, 0.2, COURT_Z + 0.5, 0.015)
    block(model, M.CREAM, -HALF, HALF, -0.1, 2.4, COURT_Z, COURT_Z + 0.4, 0.02)
    block(model, M.COLUMN, -HALF, HALF, 2.4, 2.49, COURT_Z - 0.06, COURT_Z + 0.46, 0.015)
    return model


def upper_wall():
    """Over the arches, with a string course and shuttered windows."""
    model = Model("upper wall")
    block(model, M.OCHRE, -HALF - 0.2, HALF + 0.2, CEILING_Y + 0.08, TOP_Y, -0.2, 0.2, 0.01)
    block(model, M.COLUMN, -HALF - 0.2, HALF + 0.2, CEILING_Y + 0.04, CEILING_Y + 0.14, -0.21, 0.25, 0.015)
    for s in (-1, 1):  # piers at the ends close the arcade
        block(model, M.OCHRE, min(s * HALF, s * (HALF + 0.4)), max(s * HALF, s * (HALF + 0.4)), -0.1, TOP_Y, -3.3, 0.2)
    for x in (-BAY_M, 0.0, BAY_M):
        block(model, M.COLUMN, x - 0.5, x + 0.5, 3.96, 4.04, 0.1, 0.29, 0.01)
        for s in (-1, 1):
            for k in range(9):
                slat = bevel_box(0.36, 0.07, 0.014, 0.003).at(rotate_x(0.5))
                model.add(M.OAK, slat, translate(x + s * 0.215, 4.1 + 0.085 * k, 0.235))
            for dx in (-0.19, 0.19):
                block(model, M.OAK, x + s * 0.215 + dx - 0.02, x + s * 0.215 + dx + 0.02, 4.05, 4.84, 0.2, 0.26, 0.004)
    return model


def arcade_ceiling():
    """Beams and boards."""
    model = Model("arcade ceiling")
    block(model, M.BOARDS, -HALF - 0.1, HALF + 0.1, CEILING_Y, CEILING_Y + 0.06, WALL_Z - 0.1, -0.1)
    for k in range(21):
        x = -HALF + 0.6 * k
        model.add(M.OAK, bar((x, CEILING_Y - 0.08, WALL_Z - 0.05), (x, CEILING_Y - 0.08, -0.15), 0.11, 0.16, 0.008))
    return model


def room():
    """The wall with the doorway, three more without any opening, boards and a ceiling: no light but through the door."""
    model, (d0, d1) = Model("room"), DOOR_X
    z0, z1 = WALL_Z - 0.4, WALL_Z
    top = CEILING_Y + 0.06
    for x0, x1 in ((-HALF - 0.2, d0), (d1, HALF + 0.2)):
        block(model, M.CREAM, x0, x1, -0.1, top, z0 + 0.1, z1, 0.012)
        block(model, M.ROOM, max(x0, -ROOM_X - 0.3), min(x1, ROOM_X + 0.3), -0.1, top, z0, z0 + 0.12, 0.012)
    block(model, M.CREAM, d0 - 0.05, d1 + 0.05, DOOR_Y, top, z0 + 0.1, z1 - 0.002, 0.008)
    block(model, M.ROOM, d0 - 0.05, d1 + 0.05, DOOR_Y, top, z0 + 0.002, z0 + 0.12, 0.008)
    for s in (-1, 1):
        block(model, M.ROOM, min(s * ROOM_X, s * (ROOM_X + 0.3)), max(s * ROOM_X, s * (ROOM_X + 0.3)), -0.1, top,
              ROOM_Z - 0.3, z0 + 0.05)
    block(model, M.ROOM, -ROOM_X - 0.3, ROOM_X + 0.3, -0.1, top, ROOM_Z - 0.3, ROOM_Z)
    block(model, M.CREAM, -ROOM_X - 0.3, ROOM_X + 0.3, ROOM_Y, top + 0.1, ROOM_Z - 0.3, z0 + 0.05)
    for k in range(6):  # beams
        z = ROOM_Z + 0.35 + 0.72 * k
        block(model, M.OAK, -ROOM_X, ROOM_X, ROOM_Y - 0.16, ROOM_Y + 0.01, z - 0.07, z + 0.07, 0.01)
    r = rng(41)
    x = -ROOM_X
    while x < ROOM_X:  # boards run towards the door
        width = float(r.uniform(0.16, 0.24))
        board = bevel_box(ROOM_Z * -1 - 3.0, 0.06, width - 0.004, 0.003).with_uv_offset(r.uniform(0, 3), 0.2 * x)
        model.add(M.BOARDS, board, translate(x + width / 2, STEP_Y - 0.03 + r.uniform(-0.001, 0.001),
                                             (ROOM_Z - 3.0) / 2) @ rotate_y(math.pi / 2))
        x += width
    block(model, M.JOINT, -ROOM_X - 0.2, ROOM_X + 0.2, -0.1, STEP_Y - 0.07, ROOM_Z - 0.2, z0)
    block(model, M.COLUMN, d0 - 0.02, d1 + 0.02, 0, STEP_Y + 0.012, z0 - 0.04, z1 + 0.05, 0.012)  # threshold
    return model


def doorway():
    """A frame of stone outside, and the leaf, which stands open into the room."""
    model, (d0, d1) = Model("doorway"), DOOR_X
    for x0, x1 in ((d0 - 0.16, d0), (d1, d1 + 0.16)):
        block(model, M.COLUMN, x0, x1, STEP_Y, DOOR_Y + 0.16, WALL_Z - 0.1, WALL_Z + 0.05, 0.014)
    block(model, M.COLUMN, d0 - 0.2, d1 + 0.2, DOOR_Y, DOOR_Y + 0.2, WALL_Z - 0.1, WALL_Z + 0.07, 0.014)
    leaf, width = Model("leaf"), d1 - d0 - 0.04
    for k in range(6):
        board = bevel_box(width / 6 - 0.006, DOOR_Y - 0.2, 0.035, 0.005).with_uv_offset(0.4 * k, 0.1)
        leaf.add(M.OAK, board, translate(width * (k + 0.5) / 6, (DOOR_Y + 0.06) / 2, 0))
    for y in (0.35, 1.05, 1.75):
        leaf.add(M.OAK, bevel_box(width - 0.06, 0.12, 0.03, 0.005), translate(width / 2, y, -0.03))
        leaf.add(M.IRON, bevel_box(width * 0.8, 0.035, 0.006, 0.002), translate(width * 0.42, y, 0.02))
    return model.include(leaf, translate(d1 - 0.02, STEP_Y, WALL_Z - 0.42) @ rotate_y(math.radians(76)))
