"""What stands in the rooms: furniture that keeps clear of doorways, of the camera and of each other."""
import math

import numpy as np

from kit.transform import rotate_y, translate
from sets import furniture as F
from sets import materials as M

from . import lights
from .plan import shared_edge

DRUM_PAINTS = (F.painted("blue enamel", (0.03, 0.10, 0.24), 0.22),
               F.painted("red enamel", (0.34, 0.03, 0.02), 0.22),
               F.painted("ochre enamel", (0.46, 0.25, 0.04), 0.26),
               F.painted("green enamel", (0.04, 0.16, 0.09), 0.22))
BOX_PAINTS = (M.CARDBOARD, F.painted("white box", (0.62, 0.60, 0.56), 0.6),
              F.painted("slate box", (0.10, 0.12, 0.15), 0.5),
              F.painted("rust box", (0.36, 0.12, 0.05), 0.6))


class Room:
    """Free floor of a cell: what is placed is remembered as circles."""

    def __init__(self, r, cell, circles):
        self.r, self.cell = r, cell
        self.circles = list(circles)

    def fits(self, x, z, radius, margin=0.08):
        c = self.cell
        inside = (c.x0 + margin + radius < x < c.x1 - margin - radius and
                  c.z0 + margin + radius < z < c.z1 - margin - radius)
        return inside and all(math.hypot(x - a, z - b) > radius + s for a, b, s in self.circles)

    def take(self, x, z, radius):
        self.circles.append((x, z, radius))

    def anywhere(self, radius):
        """A free point, or None."""
        for _ in range(60):
            x, z = self.r.uniform(self.cell.x0, self.cell.x1), self.r.uniform(self.cell.z0, self.cell.z1)
            if self.fits(x, z, radius):
                self.take(x, z, radius)
                return x, z
        return None

    def at_wall(self, width, depth):
        """(x, z, turn) of something with its back to a wall, facing the room, or None."""
        c, clear = self.cell, 0.12
        for _ in range(60):
            side, t = int(self.r.integers(0, 4)), self.r.random()
            off = clear + depth / 2
            x = (c.x0 + off, c.x1 - off, None, None)[side]
            z = (None, None, c.z0 + off, c.z1 - off)[side]
            x = c.x0 + width / 2 + 0.1 + t * (c.x1 - c.x0 - width - 0.2) if x is None else x
            z = c.z0 + width / 2 + 0.1 + t * (c.z1 - c.z0 - width - 0.2) if z is None else z
            radius = math.hypot(width, depth) / 2
            if all(math.hypot(x - a, z - b) > radius + s for a, b, s in self.circles):
                self.take(x, z, radius)
                return x, z, (math.pi / 2, -math.pi / 2, 0.0, math.pi)[side]
        return None


class Furnisher:
    def __init__(self, r, scene, plan, timber, column):
        self.r, self.scene, self.plan = r, scene, plan
        self.timber, self.column_material = timber, column
        self.group = scene.node("furniture")
        self.panels = []  # (x, z, width) of what hangs on walls
        self.models = {}
        self.drum_paints = [DRUM_PAINTS[i] for i in r.permutation(4)[:2]]

    def shared(self, key, make):
        if key not in self.models:
            self.models[key] = make()
        return self.models[key]

    def put(self, model, x, z, turn=0.0):
        return self.scene.node(model.name, self.group, translate(x, 0, z) @ rotate_y(turn), model)

    def columns(self, room, count, keep):
        """On a line along the hall's longer side, a third from one wall."""
        c, r = room.cell, self.r
        along_x = c.x1 - c.x0 > c.z1 - c.z0
        round_shape = r.random() < 0.5
        model = self.shared("column", lambda: F.column(self.column_material, self.plan.height, 0.19,
                                                       round_shape))
        share = r.choice((0.34, 0.66))
        for k in range(count):
            s = (k + 0.5) / count
            x = c.x0 + (c.x1 - c.x0) * (s if along_x else share)
            z = c.z0 + (c.z1 - c.z0) * (share if along_x else s)
            if room.fits(x, z, 0.3) and all(math.hypot(x - a, z - b) > s for a, b, s in keep):
                room.take(x, z, 0.35)
                self.put(model, x, z)

    def wall_piece(self, room, kind, seed):
        size = {"rack": (1.8, 0.45), "bench": (1.5, 0.4)}[kind]
        spot = room.at_wall(*size)
        if spot:
            makers = {"rack": lambda: F.rack(seed % 2, BOX_PAINTS), "bench": lambda: F.bench(self.timber)}
            self.put(self.shared((kind, seed % 2 if kind == "rack" else 0), makers[kind]), *spot)

    def floor_piece(self, room, kind, seed):
        r = self.r
        radius = {"pile": 0.85, "drums": 0.55, "table": 0.95, "ornament": 0.4, "crate": 0.45}[kind]
        spot = room.anywhere(radius)
        if spot is None:
            return
        x, z = spot
        turn = r.uniform(-0.3, 0.3) + (math.pi / 2 if r.random() < 0.5 else 0.0)
        if kind == "drums":
            for k in range(int(r.integers(1, 4))):
                paint = self.drum_paints[int(r.integers(0, 2))]
                a = turn + 2 * math.pi * k / 3
                self.put(self.shared(paint, lambda p=paint: F.drum(p)), x + 0.33 * math.cos(a),
                         z + 0.33 * math.sin(a),
                         a)
            return
        crate = self.shared("crate", lambda: F.crate(self.timber))
        makers = {"pile": lambda: F.pile(crate, 0.6, seed % 2), "crate": lambda: crate,
                  "table": lambda: F.table(self.timber, 0),
                  "ornament": lambda: F.ornament((M.BRASS, M.PORCELAIN)[seed % 2], seed % 2)}
        variant = {"pile": seed % 2, "ornament": seed % 2}.get(kind, 0)
        self.put(self.shared((kind, variant), makers[kind]), x, z, turn)

    def fill(self, room, pieces):
        order = ("rack", "pile", "drums", "table", "bench", "ornament", "crate", "pile", "drums", "rack")
        start = int(self.r.integers(0, len(order)))
        for k in range(pieces):
            kind = order[(start + k) % len(order)]
            (self.wall_piece if kind in ("rack", "bench") else self.floor_piece)(room, kind, start + k)

    def cabinets(self, room, count, fixtures, kinds, first, eye):
        """Closed cabinets against the walls, with a strong light inside each, away from the camera; how many
        found room."""
        placed = 0
        free = Room(self.r, room.cell, [*room.circles, (eye[0], eye[2], 2.6)])
        model = self.shared("cabinet", lambda: F.cabinet(F.painted("cabinet grey", (0.20, 0.22, 0.23), 0.38)))
        for k in range(count):
            spot = free.at_wall(1.05, 0.75)
            if spot is None:
                break
            room.take(spot[0], spot[1], 0.7)
            node = self.put(model, *spot)
            lights.place_in_cabinet(self.r, fixtures, kinds, node.world(), first + k)
            placed += 1
        return placed

    def doors(self):
        """A closed door on the hall's side of each wall to a sealed cell, where the eye expects one."""
        model = self.shared("door", lambda: F.door(F.painted("door grey", (0.16, 0.17, 0.18), 0.45)))
        for open_cell in self.plan.open_cells():
            for cell in self.plan.sealed_cells():
                edge = shared_edge(open_cell, cell)
                if not edge or edge[3] - edge[2] < 1.6:
                    continue
                axis, at, lo, hi = edge
                s = lo + 0.75 if self.r.random() < 0.5 else hi - 0.75
                x, z = (s, at) if axis == "x" else (at, s)
                if any(math.hypot(x - a, z - b) < w / 2 + 0.8 for a, b, w in self.panels):
                    continue
                mx, mz = open_cell.centre()
                facing = ((0.0 if mz > at else math.pi) if axis == "x" else
                          (math.pi / 2 if mx > at else -math.pi / 2))
                self.scene.node("door", self.group,
                                translate(x, 0, z) @ rotate_y(facing) @ translate(0, 0, 0.075),
                                model)
                open_cell.doorways.append((x, z, 1.0))


def half_hidden_panel(r, furnisher, room, fixtures, light, screens, span, s):
    """A large upright rectangle at `s` along a span of wall, and a screen before one half of it."""
    axis, at, _, _, inward = span
    side = 1 if r.random() < 0.5 else -1
    turn = (0.0 if inward > 0 else math.pi) if axis == "x" else (math.pi / 2 if inward > 0 else -math.pi / 2)
    x, z = (s, at) if axis == "x" else (at, s)
    furnisher.panels.append((x, z, light.width_m))
    wall = translate(x, 0, z) @ rotate_y(turn)  # local +Z into the room
    fixtures.place(light, wall @ translate(0, 1.35, 0.13) @ rotate_y(math.pi))
    gap = r.uniform(0.3, 0.55)
    screen = wall @ translate(side * light.width_m / 4, 0, 0.14 + gap)
    furnisher.scene.node("screen", furnisher.group, screen, screens)
    for u in (-0.45, 0.0, 0.45):
        p = (wall @ np.array([u * light.width_m, 0, 0.55, 1.0]))[:3]
        room.take(float(p[0]), float(p[2]), 0.6)
