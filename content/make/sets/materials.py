"""Surfaces with textures of 128 pixels, quantized so that a PNG of them takes 5 to 15 KB."""
import numpy as np

from kit.material import Material
from kit.noise import fbm, rng, smoothstep
from kit.surfaces import tinted

SIZE = 128


def _steps(x, steps=48):
    """Fewer values than a byte has: what the eye does not miss and zlib does not like."""
    return np.round(np.clip(x, 0, 1) * steps) / steps


def polished_concrete(albedo=0.36, roughness=0.22, seed=11):
    """Worn in clouds, so that reflected lights streak and break up."""
    value = albedo * (1 + 0.25 * fbm(SIZE, 4, 4, seed))
    rough = roughness + 0.12 * smoothstep(-0.2, 0.5, fbm(SIZE, 3, 3, seed + 1))
    return Material("polished concrete", (1, 1, 1), color_map=_steps(tinted(value, (1.0, 0.98, 0.94))),
                    roughness_map=_steps(rough), tile_m=4.0)


def boards(color=(0.36, 0.23, 0.12), roughness=0.32, seed=21):
    """Floor boards 0.2 m wide along U, each of its own tone, with dark joints."""
    rows = 8
    r, y = rng(seed), np.arange(SIZE) * rows / SIZE
    row = y.astype(int)
    tone = r.uniform(0.82, 1.18, rows)[row][:, None]
    grain = 1 + 0.14 * fbm(SIZE, (2, 32), 2, seed + 1)
    ends = np.floor(r.uniform(0, SIZE, rows))[row][:, None]
    joint = ((y % 1 < 0.08)[:, None]) | (np.arange(SIZE)[None, :] == ends)
    value = tone * grain * np.where(joint, 0.35, 1.0)
    rough = np.where(joint, 0.7, roughness + 0.1 * (grain - 1))
    return Material("boards", (1, 1, 1), color_map=_steps(tinted(value, color)), roughness_map=_steps(rough),
                    tile_m=1.6)


def tiles(color=(0.42, 0.40, 0.36), roughness=0.16, seed=31, count=4, tile_m=1.6):
    """Glazed tiles with matt joints."""
    x = np.arange(SIZE) * count / SIZE
    u, v = np.meshgrid(x, x)
    joint = (u % 1 < 0.07) | (v % 1 < 0.07)
    tone = rng(seed).uniform(0.85, 1.12, (count, count))[v.astype(int), u.astype(int)]
    value = np.where(joint, 0.55, tone)
    return Material("tiles", (1, 1, 1), color_map=_steps(tinted(value, color)),
                    roughness_map=_steps(np.where(joint, 0.8, roughness + 0.1 * (tone - 0.85))),
                    tile_m=tile_m)


def timber(name="timber", color=(0.42, 0.29, 0.16), roughness=0.6, seed=41):
    grain = 1 + 0.3 * fbm(SIZE, (2, 20), 3, seed)
    return Material(name, (1, 1, 1), color_map=_steps(tinted(grain * 0.9, color)), roughness=roughness,
                    tile_m=1.1)


def paint(name, color, roughness=0.85):
    return Material(name, color, roughness)


PLASTER = paint("white plaster", (0.74, 0.73, 0.71), 0.88)
CEILING = paint("ceiling", (0.60, 0.60, 0.59), 0.92)
SKIRTING = paint("skirting", (0.05, 0.05, 0.052), 0.55)
BLACK_METAL = paint("black metal", (0.024, 0.024, 0.026), 0.40)
STEEL = Material("steel", (0.56, 0.57, 0.58), 0.34, metallic=1.0)
BRASS = Material("satin brass", (0.887, 0.69, 0.37), 0.30, metallic=1.0)
PORCELAIN = paint("porcelain", (0.78, 0.77, 0.74), 0.12)
CARDBOARD = paint("cardboard", (0.38, 0.27, 0.16), 0.9)
RUBBER = paint("rubber", (0.035, 0.035, 0.036), 0.7)
