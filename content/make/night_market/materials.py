"""Everything on the market is made of these."""
import numpy as np

from kit import text
from kit.material import Material
from kit.noise import fbm, mix, normals_from_height, smoothstep, worley
from kit.surfaces import brushed_metal, glazed_clay, leaf, plaster, rough_concrete, tinted, wood, woven


def wet_asphalt(size=1024, tile_m=7.5):
    """Asphalt after rain: rough and grey where it has dried, dark with a thin film in between, puddles in the
    hollows. The film and the puddles are what the lights streak on."""
    hollows = fbm(size, 5, 6, 301) + 0.35 * fbm(size, 14, 4, 302)
    damp = smoothstep(-0.45, -0.05, hollows)
    puddle = smoothstep(-0.02, 0.04, hollows)
    first, second, own = worley(size, 300, 303)
    grain = smoothstep(0.1, 0.6, first)
    value = (0.13 + 0.10 * (own - 0.5)) * (1 - 0.25 * grain) * (1 - 0.55 * damp)
    cracks = smoothstep(0.05, 0.0, np.abs(fbm(size, 4, 5, 304)))
    cracks = cracks * smoothstep(0.1, 0.5, fbm(size, 3, 2, 305) + 0.2)
    value = value * (1 - 0.5 * cracks)
    rough = mix(mix(np.full((size, size), 0.72), np.full((size, size), 0.24), damp),
                np.full((size, size), 0.12), puddle)
    rough = rough + 0.05 * (own - 0.5) * (1 - puddle)
    height = -0.0022 * grain * (1 - 0.65 * damp) - 0.006 * cracks
    height = height * (1 - puddle)
    return Material("wet asphalt", (1, 1, 1), color_map=tinted(value, (0.98, 1.0, 1.04)), roughness_map=rough,
                    normal_map=normals_from_height(height, tile_m), tile_m=tile_m)


def striped(name, light, dark, size=128, seed=311, stripes=4):
    """Awning canvas, striped along U; a little weathered."""
    x = (np.arange(size) + 0.5) / size
    u, _ = np.meshgrid(x, x)
    band = smoothstep(0.46, 0.5, np.abs((u * stripes) % 1 - 0.5) * 2)
    value = mix(np.asarray(light), np.asarray(dark), band)
    value = value * (1 + 0.22 * fbm(size, 4, 5, seed))[..., None]
    return Material(name, (1, 1, 1), roughness=0.82, color_map=np.clip(value, 0, 1), tile_m=1.2,
                    double_sided=True)


def brick(size=512, tile_m=1.2):
    """Running bond, 5 x 15 courses; each brick has its own tone."""
    x = (np.arange(size) + 0.5) / size
    u, v = np.meshgrid(x, x)
    rows, columns = 16, 5
    row = np.floor(v * rows)
    shifted = u * columns + 0.5 * (row % 2)
    du, dv = np.abs(shifted % 1 - 0.5), np.abs((v * rows) % 1 - 0.5)
    edge = np.minimum((0.5 - du) * tile_m / columns, (0.5 - dv) * tile_m / rows)
    face = smoothstep(0.003, 0.007, edge)
    code = (row * 37 + np.floor(shifted) % columns * 17) * 0.618034 % 1
    tone = mix((0.20, 0.075, 0.045), (0.33, 0.15, 0.09), code)
    picture = mix((0.28, 0.26, 0.23), tone, face) * (1 + 0.3 * fbm(size, 8, 5, 321))[..., None]
    return Material("brick", (1, 1, 1), roughness=0.88, color_map=np.clip(picture, 0, 1),
                    normal_map=normals_from_height(0.005 * face + 0.0012 * fbm(size, 40, 3, 322), tile_m),
                    tile_m=tile_m)


ASPHALT = wet_asphalt()
STONE = rough_concrete("kerb stone", 256, 331, 0.26)
BRICK = brick()
RENDER = plaster("render", 256, 332, (0.42, 0.36, 0.30), 0.0008)
TIMBER = wood("timber", (0.23, 0.14, 0.075), 512, 341, 0.55, 0.5)
CRATE = wood("crate wood", (0.45, 0.31, 0.17), 256, 342, 0.65, 0.4, 0.5)
PAINTED = [Material("counter red", (0.34, 0.035, 0.028), 0.38),
           Material("counter teal", (0.03, 0.17, 0.18), 0.38),
           Material("counter ochre", (0.48, 0.27, 0.06), 0.42),
           Material("counter green", (0.05, 0.14, 0.06), 0.4),
           Material("counter blue", (0.04, 0.09, 0.24), 0.38)]
STEEL = brushed_metal("steel", (0.56, 0.57, 0.58), 0.33, 256, 351)
IRON = Material("iron", (0.045, 0.045, 0.05), 0.5)
BRASS = brushed_metal("brass", (0.887, 0.69, 0.37), 0.36, 256, 352)
CABLE = Material("cable", (0.02, 0.02, 0.022), 0.6)
ENAMEL = Material("enamel", (0.05, 0.16, 0.13), 0.22, double_sided=True)
CURTAINS = [woven("curtain rust", (0.36, 0.10, 0.05), 128, 361, 32, 0.2, 0.9, True),
            woven("curtain indigo", (0.05, 0.07, 0.20), 128, 362, 32, 0.2, 0.9, True),
            woven("curtain sand", (0.52, 0.40, 0.25), 128, 363, 32, 0.2, 0.9, True)]
AWNINGS = [striped("awning red", (0.72, 0.66, 0.55), (0.42, 0.035, 0.025), seed=311),
           striped("awning green", (0.70, 0.66, 0.54), (0.05, 0.20, 0.09), seed=312),
           striped("awning blue", (0.66, 0.65, 0.60), (0.03, 0.09, 0.27), seed=313),
           striped("awning amber", (0.66, 0.42, 0.10), (0.52, 0.20, 0.03), seed=314, stripes=2),
           striped("awning teal", (0.08, 0.28, 0.28), (0.03, 0.14, 0.15), seed=315, stripes=2),
           striped("awning plum", (0.62, 0.55, 0.50), (0.20, 0.03, 0.10), seed=316)]
SCARVES = [Material(f"scarf {name}", color, 0.7, double_sided=True) for name, color in (
    ("saffron", (0.72, 0.36, 0.03)), ("crimson", (0.45, 0.02, 0.04)), ("peacock", (0.02, 0.22, 0.28)),
    ("rose", (0.62, 0.20, 0.24)), ("ivory", (0.70, 0.64, 0.52)), ("violet", (0.18, 0.05, 0.28)))]
FRUIT = {name: Material(name, color, rough) for name, color, rough in (
    ("orange", (0.78, 0.26, 0.02), 0.42), ("apple", (0.48, 0.03, 0.02), 0.22),
    ("lime", (0.17, 0.36, 0.03), 0.32),
    ("lemon", (0.80, 0.58, 0.05), 0.38), ("aubergine", (0.05, 0.012, 0.05), 0.16),
    ("peach", (0.75, 0.34, 0.17), 0.6))}
BOTTLES = [Material(f"bottle {name}", color, 0.08) for name, color in (
    ("green", (0.015, 0.09, 0.025)), ("amber", (0.20, 0.065, 0.008)), ("clear", (0.35, 0.40, 0.40)),
    ("blue", (0.015, 0.05, 0.22)), ("red", (0.30, 0.012, 0.012)))]
LABEL = Material("label", (0.70, 0.66, 0.56), 0.7)
CAP = Material("cap", (0.55, 0.42, 0.16), 0.35, 1.0)
GLAZES = [glazed_clay("celadon", (0.40, 0.52, 0.40), (0.50, 0.42, 0.26), 128, 371, 0.12),
          glazed_clay("cobalt", (0.03, 0.07, 0.30), (0.35, 0.38, 0.42), 128, 372, 0.10),
          glazed_clay("tenmoku", (0.06, 0.03, 0.02), (0.28, 0.12, 0.03), 128, 373, 0.12),
          glazed_clay("shino", (0.66, 0.56, 0.46), (0.45, 0.18, 0.07), 128, 374, 0.28)]
LEAF = leaf("leaf", (0.05, 0.16, 0.04), 128, 381)
TERRACOTTA = Material("terracotta", (0.42, 0.16, 0.08), 0.85)
TARPAULIN = Material("tarpaulin", (0.05, 0.12, 0.20), 0.35, double_sided=True)
CARDBOARD = Material("cardboard", (0.38, 0.26, 0.15), 0.9)
DARK_GLASS = Material("dark window", (0.015, 0.02, 0.03), 0.08)
PLASTIC = [Material("stool red", (0.55, 0.03, 0.025), 0.3), Material("stool blue", (0.03, 0.12, 0.42), 0.3)]


def resized(picture, width, height):
    """Bilinear, to sizes that are powers of two."""
    def along(values, count):
        at = np.clip((np.arange(count) + 0.5) * len(values) / count - 0.5, 0, len(values) - 1)
        low = np.minimum(at.astype(int), len(values) - 2)
        t = (at - low).reshape(-1, *[1] * (values.ndim - 1))
        return values[low] * (1 - t) + values[low + 1] * t
    return along(along(picture, height).swapaxes(0, 1), width).swapaxes(0, 1)


def sign_picture(word, ground, ink, rim, vertical=False, height=128):
    """Emission picture of a lit sign board, linear; letters and a rim on a ground that glows unevenly."""
    lines = text.strokes(word, vertical=vertical)[1]
    width = int(height * 0.36) if vertical else int(height * max(1.6, 0.62 * lines[0] + 0.5))
    letters, distance = text.mask(word, width, height, 0.10 if vertical else 0.16, 0.17, vertical)
    x, y = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    tubes = 0.82 + 0.18 * np.cos((x if vertical else y) * 2 * np.pi * 2 - np.pi)
    border = np.minimum(np.minimum(x, 1 - x) * width, np.minimum(y, 1 - y) * height) / height
    frame = smoothstep(0.052, 0.045, border) * smoothstep(0.018, 0.025, border)
    halo = 0.35 * np.exp(-np.maximum(distance - 0.08, 0) * 9)
    picture = np.asarray(ground) * tubes[..., None]
    picture = mix(picture, np.asarray(ink), np.clip(halo, 0, 1) * 0.5)
    picture = mix(picture, ink, letters)
    return np.clip(mix(picture, rim, frame), 0, 1)
