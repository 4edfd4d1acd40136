"""The shell: 12 x 8 x 4.5 m, slab floor, skylight recess, doorway with a corridor behind, a tall window,
cove shelf, tracks. X runs right, Z towards the visitor; the floor is y = 0."""
import math

import numpy as np

from kit.material import Material
from kit.mesh import Model
from kit.noise import rng
from kit.shapes import bevel_box, block, quad, rod
from kit.transform import rotate_x, rotate_y, translate

from . import materials as M

HEIGHT_M = 4.5
DOOR_X = (-5.55, -4.35)
DOOR_HEIGHT_M = 2.4
WINDOW_Z = (0.7, 2.9)
WINDOW_Y = (0.5, 3.5)
SKYLIGHT_M = (5.2, 2.4)
SKYLIGHT_Y = 4.86
COVE_Y = 3.92


def floor():
    model, r = Model("floor"), rng(3)
    for i in range(6):
        for k in range(4):
            x, z = -6 + 2 * i, -4 + 2 * k
            level = r.uniform(-0.0006, 0.0006)
            mesh = bevel_box(1.996, 0.2, 1.996, 0.003).with_uv_offset(x + r.uniform(0, 4),
                                                                      z + r.uniform(0, 4))
            model.add(M.FLOOR, mesh, translate(x + 1, -0.1 + level, z + 1))
    for k in range(2):
        mesh = bevel_box(2.2, 0.2, 1.996, 0.003).with_uv_offset(1.3 * k, 0.7)
        model.add(M.FLOOR, mesh, translate(-4.95, -0.1, -5 - 2 * k))
    block(model, M.RUBBER, -6.1, 6.1, -0.3, -0.02, -8.1, 4.1)  # what the joints look down on
    return model


def walls():
    model = Model("walls")
    h, (d0, d1), (wz0, wz1), (wy0, wy1) = HEIGHT_M, DOOR_X, WINDOW_Z, WINDOW_Y
    block(model, M.WALL, -6.2, d0, 0, h, -4.2, -4)
    block(model, M.WALL, d0, d1, DOOR_HEIGHT_M, h, -4.2, -4, 0.001)
    block(model, M.WALL, d1, 6.2, 0, h, -4.2, -4)
    block(model, M.WALL, 6, 6.2, 0, h, -4, 4)
    block(model, M.WALL, -6.2, 6.2, 0, h, 4, 4.2)
    block(model, M.WALL, -6.35, -6, 0, h, -4, wz0)
    block(model, M.WALL, -6.35, -6, 0, h, wz1, 4)
    block(model, M.WALL, -6.35, -6, 0, wy0, wz0, wz1, 0.001)
    block(model, M.WALL, -6.35, -6, wy1, h, wz0, wz1, 0.001)
    # Corridor behind the doorway.
    block(model, M.CONCRETE, -6.2, -6.0, 0, 3, -7.9, -4.2)
    block(model, M.CONCRETE, -3.9, -3.7, 0, 3, -7.9, -4.2)
    block(model, M.WALL, -6.2, -3.7, 0, 3, -8.1, -7.9)
    block(model, M.CEILING, -6.2, -3.7, 2.7, 2.9, -8.0, -4.2)
    # Skirting: a recessed dark line that lets the walls float.
    for x0, x1, z0, z1 in ((-6, d0, -4, -3.988), (d1, 6, -4, -3.988), (5.988, 6, -4, 4), (-6, -5.988, -4, 4),
                           (-6, 6, 3.988, 4)):
        block(model, M.RUBBER, x0, x1, 0, 0.07, z0, z1, 0.002)
    # Lining of the doorway.
    for x0, x1 in ((d0 - 0.01, d0 + 0.03), (d1 - 0.03, d1 + 0.01)):
        block(model, M.BLACK_METAL, x0, x1, 0, DOOR_HEIGHT_M, -4.23, -3.97, 0.003)
    block(model, M.BLACK_METAL, d0 - 0.01, d1 + 0.01, DOOR_HEIGHT_M - 0.03, DOOR_HEIGHT_M + 0.01, -4.23,
          -3.97, 0.003)
    return model


def ceiling():
    """A slab with a hole; in it the luminous panel behind beams."""
    model = Model("ceiling")
    sx, sz = SKYLIGHT_M[0] / 2, SKYLIGHT_M[1] / 2
    y0, y1 = HEIGHT_M, HEIGHT_M + 0.2
    block(model, M.CEILING, -6.2, -sx, y0, y1, -4.2, 4.2)
    block(model, M.CEILING, sx, 6.2, y0, y1, -4.2, 4.2)
    block(model, M.CEILING, -sx, sx, y0, y1, -4.2, -sz)
    block(model, M.CEILING, -sx, sx, y0, y1, sz, 4.2)
    top = SKYLIGHT_Y + 0.06
    block(model, M.WALL, -sx - 0.1, sx + 0.1, y1, top, -sz - 0.1, -sz)
    block(model, M.WALL, -sx - 0.1, sx + 0.1, y1, top, sz, sz + 0.1)
    block(model, M.WALL, -sx - 0.1, -sx, y1, top, -sz, sz)
    block(model, M.WALL, sx, sx + 0.1, y1, top, -sz, sz)
    for k in range(1, 4):
        x = -sx + SKYLIGHT_M[0] * k / 4
        block(model, M.BLACK_METAL, x - 0.02, x + 0.02, 4.56, 4.70, -sz, sz, 0.003)
    block(model, M.BLACK_METAL, -sx, sx, 4.58, 4.68, -0.02, 0.02, 0.003)
    return model


def skylight_face(light):
    face = Material("skylight", (0, 0, 0), 1.0, emission_nit=light.face_nit())
    return Model("skylight").add(face, quad(*SKYLIGHT_M),
                                 translate(0, SKYLIGHT_Y + 0.01, 0) @ rotate_x(math.pi / 2))


def window():
    """Steel glazing bars, thin panes, and the last blue of the evening outside."""
    model = Model("window")
    (z0, z1), (y0, y1) = WINDOW_Z, WINDOW_Y
    for k in range(4):
        z = z0 + (z1 - z0) * k / 3
        block(model, M.BLACK_METAL, -6.20, -6.14, y0, y1, z - 0.02, z + 0.02, 0.003)
    for k in range(5):
        y = y0 + (y1 - y0) * k / 4
        block(model, M.BLACK_METAL, -6.195, -6.145, y - 0.015, y + 0.015, z0, z1, 0.003)
    block(model, M.OAK, -6.36, -5.93, y0 - 0.04, y0 + 0.002, z0 - 0.06, z1 + 0.06, 0.006)
    panes = quad(z1 - z0, y1 - y0).at(translate(-6.17, (y0 + y1) / 2, (z0 + z1) / 2) @ rotate_y(math.pi / 2))
    model.add(M.GLASS, panes)
    return model


def dusk_sky():
    """Card outside the window: deep blue above, a warm rest at the horizon, roofs in front of it."""
    size = 256
    y = np.linspace(1, 0, size)[:, None, None]
    x = np.linspace(0, 1, size)[None, :]
    sky = np.exp(-y * 9) * np.array([0.9, 0.42, 0.16]) * 0.5 + np.exp(-y * 1.5) * np.array([0.10, 0.22, 0.55])
    picture = np.broadcast_to(sky, (size, size, 3)).copy()
    roofs = 0.16 + 0.05 * np.floor(3 * np.abs(np.sin(17 * np.floor(x * 13) / 13 + 1))) / 2
    picture[(y[..., 0] < roofs)] = (0.006, 0.008, 0.013)
    face = Material("dusk sky", (0, 0, 0), 1.0, emission_nit=(26, 26, 26),
                    emission_map=np.clip(picture, 0, 1))
    return Model("dusk sky").add(face, quad(34, 10, unit_uv=True),
                                 translate(-16, 2.6, 1.8) @ rotate_y(math.pi / 2))


def cove():
    """Shelf with a lip below the ceiling along the back wall; tubes lie behind the lip."""
    model = Model("cove")
    block(model, M.WALL, -4.2, 5.9, COVE_Y - 0.02, COVE_Y, -4.0, -3.72, 0.004)
    block(model, M.WALL, -4.2, 5.9, COVE_Y - 0.02, COVE_Y + 0.07, -3.74, -3.71, 0.004)
    return model


def tracks(lines):
    """Black power tracks [(x0, x1, z)...] that hang 0.3 m below the ceiling."""
    model = Model("tracks")
    for x0, x1, z in lines:
        block(model, M.BLACK_METAL, x0, x1, 4.18, 4.215, z - 0.018, z + 0.018, 0.003)
        for x in np.arange(x0 + 0.3, x1, 1.9):
            model.add(M.STEEL, rod((x, 4.21, z), (x, HEIGHT_M + 0.01, z), 0.004, 6))
    return model
