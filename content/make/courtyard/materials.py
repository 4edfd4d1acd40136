"""Surfaces of the courtyard: lime plaster, flagstones, terracotta, oak, and leaves that are pictures with alpha."""
import math

import numpy as np

from kit.material import Material
from kit.noise import fbm, mix, normals_from_height, rng, smoothstep
from kit.surfaces import leaf, rough_concrete, soil, tinted, wood


def lime_plaster(name, color, seed, size=256):
    """Trowelled and weathered: broad stains, fine waves that low light finds."""
    stains = fbm(size, 3, 4, seed)
    fine = fbm(size, 24, 3, seed + 1)
    value = 1 + 0.16 * stains + 0.05 * fine
    height = 0.004 * fbm(size, 6, 3, seed + 2) + 0.0008 * fine
    return Material(name, (1, 1, 1), 0.92, color_map=np.round(np.clip(tinted(value, color), 0, 1) * 96) / 96,
                    normal_map=normals_from_height(height, 2.4), tile_m=2.4)


def stone(name, color, seed, roughness=0.62, size=256, tile_m=1.3):
    clouds = fbm(size, 4, 5, seed)
    pits = smoothstep(0.35, 0.6, fbm(size, 30, 2, seed + 1))
    value = (1 + 0.25 * clouds) * (1 - 0.35 * pits)
    height = 0.0015 * clouds - 0.002 * pits
    return Material(name, (1, 1, 1), color_map=np.round(np.clip(tinted(value * 0.9, color), 0, 1) * 96) / 96,
                    roughness_map=np.clip(roughness + 0.12 * clouds + 0.1 * pits, 0, 1),
                    normal_map=normals_from_height(height, tile_m), tile_m=tile_m)


def _leaf_mask(u, v, root, angle, length, width):
    """Inside of one pointed leaf from its root, and the distance across it as a share of its half width."""
    du, dv = u - root[0], v - root[1]
    along = (du * math.cos(angle) + dv * math.sin(angle)) / length
    across = (-du * math.sin(angle) + dv * math.cos(angle)) / (0.5 * width)
    t = np.clip(along, 0, 1)
    half = np.sin(np.pi * t ** 0.8) ** 0.8
    return (along > 0) & (along < 1) & (np.abs(across) < half), np.abs(across) / np.maximum(half, 1e-3)


def foliage(name, color, seed, leaves, length, width, size=256):
    """A twig from the bottom's middle with leaves to both sides; UV 0..1, the twig's root at v = 1. Between the leaves
    the colour goes on, so that smaller versions of the picture have no dark rims."""
    r = rng(seed)
    x = (np.arange(size) + 0.5) / size
    u, v = np.meshgrid(x, x)
    picture = np.broadcast_to(np.asarray(color, float), (size, size, 3)).copy()
    bend = r.uniform(-0.12, 0.12)
    twig = np.abs(u - 0.5 - bend * np.sin(math.pi * (1 - v))) < 0.008 + 0.008 * v
    alpha = twig & (v > 0.12)
    picture[alpha] = (0.16, 0.10, 0.05)
    for k in range(leaves):
        t = 0.06 + 0.86 * (k + 0.5) / leaves
        root = (0.5 + bend * math.sin(math.pi * t), 1 - t)
        side = 1 if k % 2 else -1
        angle = -math.pi / 2 + side * r.uniform(0.45, 1.15) * (1.1 - 0.5 * t)
        inside, across = _leaf_mask(u, v, root, angle, length * r.uniform(0.75, 1.1), width * r.uniform(0.8, 1.15))
        tone = np.asarray(color) * r.uniform(0.7, 1.35) * np.array([r.uniform(0.85, 1.3), 1.0, r.uniform(0.7, 1.0)])
        rib = smoothstep(0.16, 0.04, across)
        shaded = mix(tone, tone * (1.8, 1.5, 1.3), rib)
        picture = np.where(inside[..., None], shaded, picture)
        alpha |= inside
    pixels = np.concatenate([np.round(np.clip(picture, 0, 1) * 160) / 160, alpha[..., None].astype(float)], -1)
    return Material(name, (1, 1, 1), 0.55, color_map=pixels, tile_m=1.0, alpha_mode="MASK", double_sided=True)


OCHRE = lime_plaster("ochre plaster", (0.60, 0.42, 0.24), 201)
CREAM = lime_plaster("cream plaster", (0.72, 0.64, 0.50), 205)
ROOM = lime_plaster("room plaster", (0.62, 0.50, 0.38), 209)
COLUMN = stone("column stone", (0.62, 0.57, 0.48), 211, 0.6)
FLAGS = [stone(f"flagstone {k + 1}", color, 221 + 4 * k, 0.52 + 0.04 * k)
         for k, color in enumerate(((0.36, 0.33, 0.28), (0.31, 0.29, 0.26), (0.40, 0.35, 0.28)))]
JOINT = Material("joint", (0.12, 0.105, 0.085), 0.95)
TERRACOTTA = rough_concrete("terracotta", 128, 25, 0.5)
TERRACOTTA.color_map = np.round(np.clip(TERRACOTTA.color_map * (0.86, 0.36, 0.20), 0, 1) * 64) / 64
OAK = wood("weathered oak", (0.24, 0.15, 0.085), 256, 241, 0.6)
BOARDS = wood("floor boards", (0.26, 0.15, 0.08), 256, 245, 0.42)
BARK = Material("bark", (0.13, 0.095, 0.065), 0.9)
IRON = Material("iron", (0.03, 0.028, 0.027), 0.5)
WATER = Material("water", (0.012, 0.02, 0.02), 0.06)
SOIL = soil()
FIG_LEAF = leaf("fig leaf", (0.06, 0.15, 0.035), 128)
LEAVES = foliage("linden leaves", (0.13, 0.21, 0.045), 251, 13, 0.30, 0.19)
IVY = foliage("ivy", (0.06, 0.13, 0.035), 255, 7, 0.36, 0.30, 128)
LAVENDER = foliage("lavender", (0.30, 0.25, 0.42), 259, 16, 0.18, 0.06, 128)
LINEN = Material("linen", (0.62, 0.55, 0.44), 0.9)
BOOKS = [Material(f"cloth {k + 1}", color, 0.8)
         for k, color in enumerate(((0.28, 0.05, 0.03), (0.05, 0.10, 0.16), (0.22, 0.17, 0.08), (0.07, 0.12, 0.07)))]
GLAZE = Material("glaze", (0.05, 0.16, 0.20), 0.14)
