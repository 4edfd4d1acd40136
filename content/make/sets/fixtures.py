"""Fixtures that show their light's radiance. All look along -Z as their lights do, so that one node carries
both; models are made once for each light definition and shared."""
import math

from kit.material import Material
from kit.mesh import Model
from kit.shapes import bevel_box, cylinder, lathe, quad, rod, sphere
from kit.transform import look_at, rotate_x, rotate_y, rotate_z, translate

from . import materials as M

TURN = rotate_x(math.pi / 2)  # a lathe's +Y becomes +Z: what is built upwards lies behind the face


def glow(light):
    return Material(light.name + " glow", (0.0, 0.0, 0.0), 0.6, emission_nit=light.face_nit())


def panel(light):
    """Flat box behind a luminous face."""
    model = Model(light.name)
    model.add(M.BLACK_METAL, bevel_box(light.width_m + 0.03, light.height_m + 0.03, 0.05, 0.004),
              translate(0, 0, 0.031))
    return model.add(glow(light), quad(light.width_m, light.height_m),
                     translate(0, 0, 0.002) @ rotate_y(math.pi))


def tube(light):
    """Luminous tube along X with a cap at each end and a rail above."""
    model, half, r = Model(light.name), light.length_m / 2, light.radius_m
    side = rotate_z(math.pi / 2)
    model.add(glow(light), lathe([(r * 0.98, -half), (r * 0.98, half)], 10), side)
    for s in (-1, 1):
        model.add(M.STEEL, cylinder(r * 1.2, 0.03, 10, 0.003),
                  translate(s * (half + 0.015) + 0.015, 0, 0) @ side)
    return model


def globe(light):
    model, r = Model(light.name), light.radius_m
    model.add(glow(light), sphere(r, 14, 8))
    return model.add(M.BRASS, lathe([(0, r * 0.92), (r * 0.33, r * 0.92), (r * 0.36, r * 1.12),
                                     (0.01, r * 1.3),
                                     (0, r * 1.3)], 10))


def can(light):
    """Spot head with a short snoot."""
    model, r = Model(light.name), light.radius_m + 0.008
    body = [(r - 0.006, 0.003), (r - 0.006, -0.018), (r, -0.018), (r, 0.13), (r * 0.7, 0.145), (0, 0.147)]
    model.add(M.BLACK_METAL, lathe(body, 12, 40), TURN)
    return model.add(glow(light), lathe([(0, 0.002), (r - 0.006, 0.002)], 12), TURN)


def disk(light):
    """Round surface luminaire."""
    model, r = Model(light.name), light.width_m / 2
    body = [(0, 0.006), (r + 0.014, 0.006), (r + 0.02, 0.012), (r + 0.02, 0.05), (0, 0.05)]
    model.add(M.STEEL, lathe(body, 16, 40), TURN)
    return model.add(glow(light), lathe([(0, 0.002), (r, 0.002)], 16), TURN)


MAKERS = {"rect": panel, "tube": tube, "sphere": globe, "spot": can, "disk": disk}


class Fixtures:
    """Puts lights with their fixtures into a scene."""

    def __init__(self, scene, parent):
        self.scene, self.parent = scene, parent
        self.models, self.rods = {}, {}
        self.count = 0

    def bare(self, light, matrix):
        """A light without a fixture, for places that nobody sees."""
        self.count += 1
        return self.scene.node(f"{light.name} {self.count}", self.parent, matrix, light=light)

    def place(self, light, matrix, name=None):
        if light not in self.models:
            self.models[light] = MAKERS[light.type](light)
        self.count += 1
        return self.scene.node(name or f"{light.name} {self.count}", self.parent, matrix, self.models[light],
                               light)

    def stem(self, x, y, z, length):
        """Thin rod upwards from a point."""
        key = round(length, 2)
        if key not in self.rods:
            self.rods[key] = Model("stem").add(M.BLACK_METAL, rod((0, 0, 0), (0, key, 0), 0.006, 5))
        self.scene.node("stem", self.parent, translate(x, y, z), self.rods[key])

    def ceiling(self, light, x, z, ceiling_m, drop, turn_rad=0.0, target=None):
        """Hangs a fixture `drop` below the ceiling: rectangles, disks and spots look down or at a target."""
        y = ceiling_m - drop
        if light.type in ("sphere", "tube"):
            inner = 0.0 if light.type == "sphere" else light.length_m * 0.38
            for s in ((0,) if inner == 0 else (-1, 1)):
                self.stem(x + s * inner * math.cos(turn_rad), y, z - s * inner * math.sin(turn_rad),
                          drop + 0.02)
            return self.place(light, translate(x, y, z) @ rotate_y(turn_rad))
        if light.type == "spot":
            head = look_at((x, y, z), target if target is not None else (x + 0.01, 0.0, z), up=(0, 0, 1))
            if drop > 0.16:
                back = head @ translate(0, 0, 0.14)
                self.stem(*back[:3, 3], ceiling_m + 0.02 - float(back[1, 3]))
            return self.place(light, head)
        if drop > 0.08:
            for s in (-1, 1):
                reach = s * 0.3 * light.width_m
                self.stem(x + reach * math.cos(turn_rad), y + 0.05, z - reach * math.sin(turn_rad),
                          drop - 0.03)
        return self.place(light, translate(x, y, z) @ rotate_y(turn_rad) @ rotate_x(-math.pi / 2))
