"""Lamps of the market: their light definitions and the things that hold them. Faces show the light's
radiance."""
import math

import numpy as np

from kit.lights import Light
from kit.material import Material
from kit.mesh import Model
from kit.noise import smoothstep
from kit.shapes import bar, bevel_box, cylinder, lathe, quad, rod, sphere
from kit.transform import rotate_x, rotate_y, rotate_z, translate

from . import materials as M

DEG = math.pi / 180
SIGN_NIT = 50.0
RANGE = 1.2  # scale of all ranges: sets how many lights reach a point


def _range(metres):
    return round(metres * RANGE, 3)


def lantern_light(name, color, lumen, radius, reach):
    return Light(name, "sphere", lumen, "lumen", color=color, range_m=_range(reach), radius_m=radius,
                 ray_end_bias_m=0.06)


# Paper tints the lamp inside; lumens are what would leave white paper.
RED = lantern_light("red lantern", (1.0, 0.17, 0.04), 62.0, 0.24, 5.2)
WARM = lantern_light("warm lantern", (1.0, 0.50, 0.18), 50.0, 0.20, 5.2)
AMBER = lantern_light("amber lantern", (1.0, 0.36, 0.08), 45.0, 0.15, 4.8)
BULB = Light("bulb", "sphere", 600.0, "lumen", temperature_k=2700.0, range_m=_range(4.6), radius_m=0.04,
             ray_end_bias_m=0.025)
FAIRY = Light("string bulb", "sphere", 115.0, "lumen", temperature_k=2500.0, range_m=_range(4.4),
              radius_m=0.028,
              ray_end_bias_m=0.02)
SHADE = Light("shaded lamp", "spot", 800.0, "lumen", temperature_k=3000.0, range_m=_range(4.8), radius_m=0.04,
              inner_rad=30 * DEG, outer_rad=58 * DEG, ray_end_bias_m=0.03)
PANEL = Light("panel lamp", "disk", 420.0, "lumen", temperature_k=4000.0, range_m=_range(4.6), width_m=0.3,
              ray_end_bias_m=0.02)
TEA_HOUSE = Light("tea house", "rect", 26.0, "nit", color=(1.0, 0.62, 0.27), range_m=_range(9.0), width_m=4.4,
                  height_m=2.2, ray_end_bias_m=0.2)
NEON_COLORS = {"pink": (1.0, 0.07, 0.30), "cyan": (0.06, 0.72, 1.0), "gold": (1.0, 0.48, 0.05)}


def neon_light(color, length):
    """120 lm/m before the glass's colour."""
    return Light(f"neon {color} {length:.2f} m", "tube", round(120.0 * length, 2), "lumen",
                 color=NEON_COLORS[color],
                 range_m=_range(4.6), radius_m=0.018, length_m=length, ray_end_bias_m=0.02)


def glow(name, light, share=1.0, base=(0.0, 0.0, 0.0), picture=None):
    return Material(name, base, 0.6, emission_nit=light.face_nit(share), emission_map=picture)


def paper_picture(ribs, size=64):
    """Emission over a lantern, mean near 1 around the belly: bright in the middle, darker ribs, dim ends."""
    y = np.linspace(1, 0, size)[:, None]
    rib = 0.62 + 0.38 * smoothstep(0.0, 0.35, np.abs(((y * ribs) % 1) - 0.5) * 2)
    belly = 0.40 + 0.60 * np.sin(np.pi * np.clip(y, 0, 1)) ** 1.2
    return np.repeat((rib * belly)[:, :, None] * np.ones((1, 4, 3)), 1, 1)


def lantern(name, light, width, height, ribs, flat, near):
    """Ribbed paper body around the origin with caps, a hook and a tassel."""
    model = Model(name)
    t = np.linspace(-1, 1, 8 if near else 6)
    body = width * (flat + (1 - flat) * np.sqrt(np.maximum(0, 1 - np.abs(t) ** 2.4)))
    paper = Material(name + " paper", tuple(0.45 * c for c in light.color), 0.75,
                     emission_nit=light.face_nit(1.1),
                     emission_map=paper_picture(ribs), double_sided=False)
    model.add(paper, lathe(np.stack([body, t * height], -1), 14 if near else 9, 180, unit_uv=True))
    cap = width * flat * 1.06
    for sign in (-1, 1):
        model.add(M.IRON, lathe([(cap, -0.012), (cap, 0.012), (0, 0.014)] if sign > 0
                                else [(0, -0.012), (cap, -0.012), (cap, 0.012)], 8 if near else 5, 40),
                  translate(0, sign * height, 0))
    model.add(M.CABLE, rod((0, height, 0), (0, height + 0.10, 0), 0.004, 4))
    model.add(M.SCARVES[1], lathe([(0, -0.16), (0.016, -0.16), (0.012, -0.02)], 5, 60),
              translate(0, -height, 0))
    return model


def bulb(name, light, cord, detail=(10, 6)):
    """Glass bulb at the origin, socket and a straight cord above."""
    r = light.radius_m
    model = Model(name)
    model.add(glow(name + " glass", light), sphere(r, *detail))
    model.add(M.CABLE, lathe([(0.017, r * 0.8), (0.019, r + 0.05), (0.008, r + 0.065)], 6, 50))
    if cord > 0:
        model.add(M.CABLE, rod((0, r + 0.06, 0), (0, cord, 0), 0.004, 4))
    return model


def shaded_lamp(light, cord):
    """Enamel shade over a bulb; looks down (-Y in this model, the light's node turns by itself)."""
    model = Model("shaded lamp")
    model.add(M.ENAMEL, lathe([(0.17, -0.03), (0.165, -0.02), (0.06, 0.07), (0.04, 0.12)], 12, 60))
    model.add(glow("shaded bulb", light), sphere(light.radius_m * 0.98, 8, 5))
    model.add(M.CABLE, rod((0, 0.12, 0), (0, cord, 0), 0.005, 5))
    return model


def panel_lamp(light, cord):
    """Round luminous panel that looks down."""
    r = light.width_m / 2
    model = Model("panel lamp")
    model.add(M.IRON, lathe([(r, -0.004), (r + 0.012, -0.004), (r + 0.012, 0.02), (0, 0.045)], 14, 40))
    model.add(glow("panel face", light), lathe([(0, 0.004), (r, 0.004)], 14))
    model.add(M.CABLE, rod((0, 0.04, 0), (0, cord, 0), 0.005, 5))
    return model


def neon_tube(color, length):
    """Glass along X at the origin, with black end caps and two stand-offs behind (-Z)."""
    light = neon_light(color, length)
    model = Model(light.name)
    turn = rotate_z(math.pi / 2)
    half, r = length / 2, light.radius_m
    model.add(glow(light.name + " glass", light), lathe([(r * 0.97, -half), (r * 0.97, half)], 10), turn)
    for s in (-1, 1):
        cap = cylinder(r * 1.2, 0.035, 8, 0.002)
        model.add(M.CABLE, cap, translate(s * half + (0.035 if s > 0 else 0), 0, 0) @ turn)
        model.add(M.IRON, rod((s * half * 0.7, 0, -r), (s * half * 0.7, 0, -0.05), 0.005, 4))
    return model, light


class Signs:
    """Lit boards: a model and a light for each design, shared by all places where it hangs."""
    DESIGNS = (("NOODLES", (0.85, 0.16, 0.06), (1.0, 0.92, 0.70), (1.0, 0.75, 0.3)),
               ("TEA", (0.10, 0.45, 0.24), (0.95, 1.0, 0.85), (0.9, 0.95, 0.6)),
               ("FRUIT", (1.0, 0.62, 0.14), (0.55, 0.05, 0.02), (0.75, 0.15, 0.04)),
               ("SILK", (0.45, 0.05, 0.26), (1.0, 0.72, 0.80), (1.0, 0.5, 0.7)),
               ("SPICE", (0.95, 0.80, 0.52), (0.62, 0.12, 0.02), (0.62, 0.12, 0.02)),
               ("FISH", (0.04, 0.26, 0.62), (0.80, 0.96, 1.0), (0.35, 0.8, 1.0)),
               ("SOUP", (0.92, 0.86, 0.70), (0.07, 0.10, 0.35), (0.8, 0.1, 0.05)),
               ("BOTTLES", (0.03, 0.34, 0.36), (1.0, 0.93, 0.66), (0.2, 0.9, 0.85)),
               ("LUCKY 8", (0.70, 0.04, 0.05), (1.0, 0.80, 0.22), (1.0, 0.8, 0.22)),
               ("OPEN", (0.05, 0.05, 0.10), (1.0, 0.30, 0.45), (0.2, 0.75, 1.0)))

    def __init__(self):
        self.made = {}

    def board(self, index, vertical):
        """(model, light, size): face looks to local +Z; the light's node is turned by half about Y."""
        word, ground, ink, rim = self.DESIGNS[index % len(self.DESIGNS)]
        word = word.replace(" ", "") if vertical else word
        key = (word, vertical)
        if key not in self.made:
            picture = M.sign_picture(word, ground, ink, rim, vertical)
            h, w = picture.shape[:2]
            picture = M.resized(picture, 64 if vertical else 256, 128)
            width, height = (0.46, 0.46 * h / w) if vertical else (0.52 * w / h, 0.52)
            mean = picture.mean(axis=(0, 1))
            color = tuple(float(round(c, 4)) for c in mean / mean.max())
            nit = round(SIGN_NIT * float(mean.max()), 2)
            name = f"sign {word.lower()}{' blade' if vertical else ''}"
            light = Light(name, "rect", nit, "nit", color=color, range_m=_range(5.2), width_m=round(width, 4),
                          height_m=round(height, 4), ray_end_bias_m=0.02)
            face = Material(name + " face", (0.02, 0.02, 0.02), 0.25, emission_nit=(SIGN_NIT,) * 3,
                            emission_map=picture)
            model = Model(name)
            sides = (0.0, math.pi) if vertical else (0.0,)
            depth = 0.12 if vertical else 0.09
            model.add(M.IRON, bevel_box(width + 0.05, height + 0.05, depth, 0.006))
            for turn in sides:
                model.add(face, quad(width, height, unit_uv=True),
                          rotate_y(turn) @ translate(0, 0, depth / 2 + 0.004))
            self.made[key] = (model, light, (width, height, depth))
        return self.made[key]


def sign_arm():
    """Post and arm that carry a blade sign; the sign hangs at z = 0.33."""
    model = Model("sign arm")
    model.add(M.IRON, bar((0, 0.0, -0.95), (0, 0.0, 0.3), 0.03, 0.03))
    return model.add(M.IRON, bar((0, -2.9, -0.03), (0, 0.7, -0.03), 0.04, 0.04))


def down():
    """Turns a light that looks along -Z to look at the ground."""
    return rotate_x(-math.pi / 2)
