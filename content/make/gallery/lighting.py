"""The lights of the room and their fixtures. Each fixture's face has the radiance of its light; the light's
ray end bias keeps the fixture out of its own way."""
import math

import numpy as np

from kit import paintings
from kit.lights import Light
from kit.material import Material, kelvin
from kit.mesh import Model
from kit.shapes import bevel_box, cylinder, lathe, quad, rod, sphere
from kit.transform import look_at, rotate_x, rotate_y, rotate_z, translate

from . import exhibits, room
from . import materials as M

VIDEO = paintings.waves()
DEG = math.pi / 180
LIFT = kelvin(3900.0) / kelvin(3000.0)
# Gel on the warm heads. The picture is balanced for 6500 K; this lifts a 3000 K lamp to 3900 K, half-way to
# what an eye that has settled into the room sees. Like the real foil it takes its share of the light.
GEL = tuple(float(round(c, 3)) for c in LIFT / LIFT.max())


def spot_light(name, lumen, outer_deg, temperature_k=3000.0, inner=0.55, radius=0.035, gel=GEL):
    return Light(name, "spot", lumen, "lumen", color=gel, temperature_k=temperature_k, range_m=12.0,
                 radius_m=radius, inner_rad=outer_deg * inner * DEG, outer_rad=outer_deg * DEG,
                 ray_end_bias_m=0.06)


# Definitions are shared by all heads of a kind, as a lighting artist would set them up.
PICTURE = spot_light("picture spot", 1500.0, 27)
ACCENT = spot_light("accent spot", 1400.0, 17, 2800.0)
SOFT_ACCENT = spot_light("plant spot", 1100.0, 24, 3000.0)
WASHER = spot_light("wall washer", 1200.0, 52, 4500.0, 0.3, 0.05, (1.0, 1.0, 1.0))
SKYLIGHT = Light("skylight", "rect", 150.0, "nit", temperature_k=6500.0, width_m=room.SKYLIGHT_M[0],
                 height_m=room.SKYLIGHT_M[1], range_m=16.0, ray_end_bias_m=0.02)
FRAMER = Light("framing projector", "rect", 1400.0, "lumen", color=GEL, temperature_k=3000.0, width_m=0.12,
               height_m=0.12, range_m=10.0, door_angle_rad=38 * DEG, door_length_m=0.12, ray_end_bias_m=0.05)
COVE = Light("cove tube", "tube", 1500.0, "lumen", color=GEL, temperature_k=3500.0, radius_m=0.013,
             length_m=1.42, range_m=8.0,
             ray_end_bias_m=0.03)
CASE = Light("case tube", "tube", 260.0, "lumen", temperature_k=3500.0, radius_m=0.006, length_m=0.8,
             range_m=3.0,
             ray_end_bias_m=0.015)
DOWNLIGHT = Light("downlight", "disk", 420.0, "lumen", temperature_k=2900.0, width_m=0.16, range_m=9.0,
                  ray_end_bias_m=0.03)
GLOBE = Light("globe", "sphere", 380.0, "lumen", temperature_k=2700.0, radius_m=0.11, range_m=9.0,
              ray_end_bias_m=0.03)
DUSK = Light("dusk", "directional", 80.0, "lux", temperature_k=11000.0, angular_diameter_rad=0.05)


def screen_light():
    mean = VIDEO.mean(axis=(0, 1))
    color = tuple(float(v) for v in mean / mean.max())
    return Light("video wall", "rect", 170.0, "nit", color=color, width_m=2.4, height_m=1.35, range_m=14.0,
                 ray_end_bias_m=0.03)


def glow(name, light, share=1.0):
    return Material(name, (0.0, 0.0, 0.0), 0.6, emission_nit=light.face_nit(share))


def spot_head(light, radius):
    """Looks down -Z, the light's centre at the origin; the pivot is at (0, 0, 0.08)."""
    model = Model(light.name + " head")
    r = radius + 0.008
    turn = rotate_x(math.pi / 2)  # the profile runs along +Z
    body = lathe([(0, 0.165), (r * 0.7, 0.163), (r, 0.15), (r, -0.018), (r - 0.003, -0.02),
                  (r - 0.006, -0.018),
                  (r - 0.006, 0.002)][::-1], 28, 40)
    model.add(M.BLACK_METAL, body, turn)
    model.add(glow(light.name + " lens", light), lathe([(0, -0.001), (r - 0.006, -0.001)], 24), turn)
    for k in range(4):  # cooling fins
        model.add(M.BLACK_METAL, cylinder(r + 0.006, 0.004, 24, 0.001),
                  turn @ translate(0, 0.105 + 0.012 * k, 0))
    return model


class Rig:
    """Puts fixtures into the scene; each head model is made once and shared."""

    def __init__(self, scene, parent):
        self.scene, self.parent = scene, parent
        self.heads = {}
        self.stem = Model("stem")
        self.stem.add(M.BLACK_METAL, bevel_box(0.05, 0.03, 0.03, 0.003), translate(0, 0.27, 0))
        self.stem.add(M.BLACK_METAL, rod((0, 0, 0), (0, 0.26, 0), 0.007, 10))

    def spot(self, name, light, at, target):
        """A track head whose pivot hangs below the track at (x, z)."""
        if light not in self.heads:
            self.heads[light] = spot_head(light, light.radius_m)
        pivot = np.array([at[0], 3.92, at[1]])
        toward = np.asarray(target, float) - pivot
        toward /= np.linalg.norm(toward)
        self.scene.node(name + " stem", self.parent, translate(*pivot), self.stem)
        self.scene.node(name, self.parent, look_at(pivot + 0.08 * toward, target), self.heads[light], light)

    def framer(self, name, light, at, target):
        """A square projector with four doors; the doors' angle opens from the light's face."""
        if light not in self.heads:
            model, half = Model("framer head"), light.width_m / 2
            model.add(M.BLACK_METAL, bevel_box(2 * half + 0.03, 2 * half + 0.03, 0.16, 0.005),
                      translate(0, 0, 0.09))
            model.add(glow("framer face", light), quad(2 * half, 2 * half),
                      translate(0, 0, 0.004) @ rotate_y(math.pi))
            length, open_rad = light.door_length_m, light.door_angle_rad
            for k in range(4):
                door = bevel_box(2 * half + 0.02, length, 0.003, 0.001)
                hinge = rotate_z(k * math.pi / 2) @ translate(0, half + 0.008, 0.006)
                model.add(M.BLACK_METAL, door, hinge @ rotate_x(-open_rad) @ translate(0, length / 2, 0))
            self.heads[light] = model
        pivot = np.array([at[0], 3.90, at[1]])
        toward = np.asarray(target, float) - pivot
        toward /= np.linalg.norm(toward)
        self.scene.node(name + " stem", self.parent, translate(*pivot), self.stem)
        self.scene.node(name, self.parent, look_at(pivot + 0.09 * toward, target), self.heads[light], light)


def tube_model(light):
    """Luminous tube along X between two caps."""
    model = Model(light.name)
    half, r = light.length_m / 2, light.radius_m
    side = rotate_z(math.pi / 2)
    model.add(glow(light.name + " glass", light), lathe([(r * 0.98, -half), (r * 0.98, half)], 12), side)
    for s in (-1, 1):
        cap = cylinder(r * 1.15, 0.03, 12, 0.002)
        model.add(M.STEEL, cap, translate(s * (half + 0.012) + 0.015, 0, 0) @ side)
    return model


def downlight_model(light):
    """Trim ring flush with a ceiling above; the face looks down."""
    model = Model("downlight")
    r = light.width_m / 2
    ring = [(r, 0.01), (r, -0.002), (r + 0.012, -0.004), (r + 0.016, 0.0), (r + 0.016, 0.02)]
    model.add(M.STEEL, lathe(ring, 32, 40))
    model.add(glow("downlight face", light), lathe([(0, 0.004), (r, 0.004)], 32))
    return model


def globe_model(light, drop):
    """Opal globe at the origin on a brass cap and a cord of `drop` metres."""
    model = Model("globe pendant")
    model.add(glow("opal glass", light), sphere(light.radius_m, 40, 20))
    model.add(M.BRASS, lathe([(0, 0.100), (0.036, 0.100), (0.04, 0.104), (0.038, 0.125), (0.012, 0.14),
                              (0, 0.142)], 28))
    model.add(M.BLACK_METAL, rod((0, 0.14, 0), (0, drop, 0), 0.003, 6))
    return model


def place_architectural(scene, group):
    """Skylight, cove, downlights, screen, dusk."""
    down = rotate_x(-math.pi / 2)
    scene.node("skylight panel", group, model=room.skylight_face(SKYLIGHT))
    scene.node("skylight", group, translate(0, room.SKYLIGHT_Y, 0) @ down, light=SKYLIGHT)
    tube = tube_model(COVE)
    for k in range(6):
        scene.node(f"cove tube {k + 1}", group, translate(-3.35 + 1.68 * k, room.COVE_Y + 0.02, -3.82), tube,
                   COVE)
    trim = downlight_model(DOWNLIGHT)
    for k, (x, y, z) in enumerate(((-4.95, 2.695, -5.2), (-4.95, 2.695, -6.9), (4.9, 4.495, -3.0),
                                   (-5.0, 4.495, -0.2))):
        place = translate(x, y, z)
        scene.node(f"downlight trim {k + 1}", group, place, trim)
        scene.node(f"downlight {k + 1}", group, place @ down, light=DOWNLIGHT)
    screen = screen_light()
    place = translate(-6, 1.72, -1.75) @ rotate_y(math.pi / 2)
    scene.node("screen", group, place, exhibits.video_wall(screen, VIDEO))
    scene.node("video wall", group, place @ translate(0, 0, 0.058) @ rotate_y(math.pi), light=screen)
    scene.node("dusk", group, look_at((-9, 6.6, 5.4), (-2.4, 0.0, 0.2)), light=DUSK)
