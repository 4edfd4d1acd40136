"""Materials with procedural textures. Albedos follow measured values: plaster 0.75, concrete 0.35, oak
0.3."""
import numpy as np

from .material import Material
from .noise import fbm, mix, normals_from_height, perlin, smoothstep, worley


def tinted(value, color):
    """A picture of albedo times colour."""
    return np.clip(value, 0, 1)[..., None] * np.asarray(color)


def polished_concrete(name="polished concrete", size=1024, seed=11, albedo=0.38):
    clouds = fbm(size, 5, 5, seed)
    patches = smoothstep(-0.25, 0.35, fbm(size, 3, 3, seed + 1))
    first, _, own = worley(size, 90, seed + 2)
    stones = smoothstep(0.42, 0.25, first) * smoothstep(0.55, 0.75, own)
    value = albedo * (1 + 0.22 * clouds + 0.10 * (patches - 0.5)) + 0.05 * stones * (own - 0.75) * 4
    warm = mix((1.03, 1.0, 0.95), (0.97, 1.0, 1.02), patches)
    # Traffic wears the polish off in clouds: the highlight streaks break up instead of being a mirror's.
    rough = 0.17 + 0.10 * smoothstep(-0.2, 0.5, fbm(size, 4, 5, seed + 3)) + 0.03 * stones
    height = 0.0011 * perlin(size, 6, seed + 4) + 0.00012 * fbm(size, 40, 3, seed + 5)
    return Material(name, (1, 1, 1), color_map=np.clip(value, 0, 1)[..., None] * warm, roughness_map=rough,
                    normal_map=normals_from_height(height, 4.0), tile_m=4.0)


def rough_concrete(name="concrete", size=512, seed=21, albedo=0.33):
    clouds = fbm(size, 4, 6, seed)
    first, _, own = worley(size, 48, seed + 1)
    pores = smoothstep(0.30, 0.12, first) * (own > 0.9)
    value = albedo * (1 + 0.35 * clouds) * (1 - 0.45 * pores)
    height = 0.0008 * clouds - 0.0025 * pores + 0.0003 * fbm(size, 60, 2, seed + 2)
    return Material(name, (1, 1, 1), color_map=tinted(value, (1.0, 0.98, 0.94)),
                    roughness_map=0.85 + 0.1 * clouds,
                    normal_map=normals_from_height(height, 2.0), tile_m=2.0)


def plaster(name="white wall", size=512, seed=31, color=(0.76, 0.755, 0.74), depth_m=0.00045):
    """Rolled paint: even in colour, alive only where light grazes it."""
    roller = fbm(size, (70, 46), 3, seed, 0.6)
    waves = fbm(size, 3, 3, seed + 1)
    height = depth_m * roller + 0.0015 * waves
    return Material(name, color, 0.88, normal_map=normals_from_height(height, 1.6), tile_m=1.6)


def wood(name, color=(0.40, 0.25, 0.13), size=512, seed=41, roughness=0.42, contrast=0.35, tile_m=0.9):
    """Grain runs along U."""
    warp = fbm(size, (2, 3), 3, seed)
    x = np.arange(size) / size
    _, v = np.meshgrid(x, x)
    rings = 0.5 + 0.5 * np.cos(2 * np.pi * (v * 7 + 1.6 * warp))
    pores = np.clip(fbm(size, (6, 120), 2, seed + 1), 0, 1)
    streak = fbm(size, (3, 40), 3, seed + 2)
    value = 1 + contrast * (0.55 * (rings - 0.5) + 0.5 * streak) - 0.5 * pores
    red = mix((1.0, 1.0, 1.0), (1.08, 0.97, 0.86), rings)
    height = -0.0004 * pores - 0.00012 * rings
    return Material(name, (1, 1, 1),
                    color_map=np.clip(tinted(np.clip(value, 0.2, 1.6) / 1.6, color) * 1.6 * red, 0, 1),
                    roughness_map=np.clip(roughness + 0.12 * pores - 0.05 * streak, 0, 1),
                    normal_map=normals_from_height(height, tile_m), tile_m=tile_m)


def brushed_metal(name, color, roughness=0.24, size=256, seed=51):
    scratches = fbm(size, (4, 100), 2, seed)
    smudge = fbm(size, 4, 4, seed + 1)
    return Material(name, color, metallic=1.0, tile_m=0.5,
                    roughness_map=np.clip(roughness + 0.05 * scratches + 0.07 * smudge, 0.06, 1))


def glazed_clay(name, color, dark, size=512, seed=61, roughness=0.13):
    """Glaze that breaks to `dark` where it runs thin, with iron specks."""
    flow = fbm(size, (5, 3), 5, seed)
    first, _, own = worley(size, 45, seed + 1)
    specks = smoothstep(0.22, 0.10, first) * (own > 0.72)
    base = mix(color, dark, smoothstep(-0.1, 0.55, flow))
    height = 0.0010 * perlin(size, 9, seed + 2) + 0.0002 * flow
    return Material(name, (1, 1, 1), color_map=np.clip(base * (1 - 0.7 * specks[..., None]), 0, 1),
                    roughness_map=roughness + 0.10 * smoothstep(0.1, 0.6, flow) + 0.1 * specks,
                    normal_map=normals_from_height(height, 0.6), tile_m=0.6)


def woven(name, color, size=256, seed=71, threads=64, tile_m=0.25, roughness=0.85, double_sided=False):
    """Plain weave, warp and weft in turn on top."""
    x = (np.arange(size) + 0.5) / size * threads
    u, v = np.meshgrid(x, x)
    over = (np.floor(u) + np.floor(v)) % 2
    round_u, round_v = np.sin(np.pi * (u % 1)), np.sin(np.pi * (v % 1))
    height = np.where(over > 0, round_u * (0.6 + 0.4 * round_v), round_v * (0.6 + 0.4 * round_u))
    value = (0.72 + 0.28 * height) * (1 + 0.12 * fbm(size, 8, 3, seed))
    return Material(name, (1, 1, 1), color_map=tinted(value, color), roughness=roughness,
                    normal_map=normals_from_height(height * tile_m / threads * 0.25, tile_m), tile_m=tile_m,
                    double_sided=double_sided)


def leaf(name, color=(0.10, 0.22, 0.06), size=256, seed=81):
    """UV 0..1 from stalk (v = 1) to tip (v = 0), midrib at u = 0.5."""
    x = (np.arange(size) + 0.5) / size
    u, v = np.meshgrid(x, x)
    side = np.abs(u - 0.5)
    ribs = np.abs(((v + side * 0.9) * 9) % 1 - 0.5) * 2
    vein = np.maximum(smoothstep(0.22, 0.0, ribs) * 0.6, smoothstep(0.035, 0.012, side))
    value = mix(color, np.asarray(color) * (1.7, 1.5, 1.3), vein) * (1 + 0.25 * fbm(size, 5, 4, seed))[...,
        None]
    height = -0.0015 * vein + 0.0007 * np.cos(ribs * np.pi)
    return Material(name, (1, 1, 1), color_map=np.clip(value, 0, 1), roughness=0.38,
                    normal_map=normals_from_height(height, 0.2), tile_m=1.0, double_sided=True)


def soil(name="soil", size=128, seed=91):
    first, _, own = worley(size, 14, seed)
    value = 0.03 + 0.05 * own * smoothstep(0.6, 0.1, first)
    return Material(name, (1, 1, 1), color_map=tinted(value, (1, 0.75, 0.55)), roughness=0.95,
                    normal_map=normals_from_height(-0.006 * first, 0.25), tile_m=0.25)
