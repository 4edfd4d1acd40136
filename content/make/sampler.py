"""Every light type and shaping in a bay of its own, the same things in each: a sphere, a box, a rough and a smooth
strip of floor. Eighteen bays, three shelves of six, a plate with its name under each. Lighting channels keep the sun in
its bay, and the last light of the middle shelf from its box."""
import math

import numpy as np
from kit import png, text
from kit.gltf import Scene
from kit.lights import Light
from kit.material import Material
from kit.mesh import Model
from kit.shapes import bevel_box, block, quad, sphere
from kit.transform import look_at, rotate_x, rotate_y, translate
from profiles import profiles

WIDE_M, HIGH_M, DEEP_M = 2.0, 1.7, 1.6
COLUMNS = 6
SUN_CHANNELS, BOX_CHANNELS = 2, 4
BOARD_M = 0.1    # thickness of shelves and walls between bays
PLATE_M = 0.16   # height of the fascia that carries the names

WALL = Material("wall", (0.55, 0.55, 0.54), 0.9)
ROUGH = Material("rough floor", (0.36, 0.35, 0.34), 0.85)
SMOOTH = Material("smooth floor", (0.16, 0.16, 0.17), 0.16)
PLASTER = Material("plaster", (0.72, 0.71, 0.69), 0.7)
PAINT = Material("paint", (0.50, 0.13, 0.09), 0.4)
FIXTURE = Material("fixture", (0.05, 0.05, 0.05), 0.5)


def plate(word):
    """Pale letters that can be read without any light on them."""
    mask, _ = text.mask(word, 512, 64, 0.2, 0.16)
    return Material(f"plate {word}", (0.03, 0.03, 0.03), 0.6, emission_nit=(34.0, 32.0, 29.0),
                    emission_map=np.repeat(mask[..., None], 3, -1))


def stripes():
    """For the luminous picture: bands of four colours with a dark frame."""
    y, x = np.mgrid[0:96, 0:160]
    colors = np.array([(1.0, 0.25, 0.1), (1.0, 0.8, 0.3), (0.15, 0.5, 1.0), (0.2, 0.9, 0.4)])
    pixels = colors[np.minimum(x * 4 // 160, 3)] * (0.35 + 0.65 * (y[..., None] < 48))
    frame = (x < 4) | (x >= 156) | (y < 4) | (y >= 92)
    return png.encode(png.to_bytes(np.where(frame[..., None], 0.02, pixels)))


def leaves():
    """For the mask: overlapping discs, as light through a crown falls."""
    y, x = np.mgrid[0:128, 0:128]
    light = np.ones((128, 128))
    rng = np.random.RandomState(5)
    for _ in range(70):
        cx, cy, r = rng.randint(0, 128), rng.randint(0, 128), rng.randint(5, 15)
        dx, dy = np.minimum(abs(x - cx), 128 - abs(x - cx)), np.minimum(abs(y - cy), 128 - abs(y - cy))
        light = np.minimum(light, np.clip((np.hypot(dx, dy) - r) / 3.0 + 0.5, 0.0, 1.0))
    return png.encode(png.to_bytes(np.repeat(light[..., None], 3, -1)))


def bays():
    """Name and light of each bay, from the left, the upper shelf first."""
    shapes = profiles()
    common = dict(temperature_k=4600.0, range_m=4.0)

    def spot(name, **more):
        return Light(name, "spot", 900.0, "lumen", radius_m=0.03, inner_rad=0.35, outer_rad=0.75, **common, **more)

    def rect(name, **more):
        return Light(name, "rect", 700.0, "lumen", width_m=0.6, height_m=0.4, **common, **more)

    doors = tuple((f"barnDoor{side}{what}", value) for side, length, angle in
                  (("Left", 0.35, 0.15), ("Right", 0.1, 1.2), ("Top", 0.3, 0.9), ("Bottom", 0.3, 0.25))
                  for what, value in (("LengthM", length), ("AngleRad", angle)))
    function = (("lightFunctionSoftness", 0.15),)
    return [
        ("POINT", Light("point", "sphere", 500.0, "lumen", **common)),
        ("SPHERE", Light("sphere", "sphere", 500.0, "lumen", radius_m=0.12, **common)),
        ("SPOT", spot("spot")),
        ("TUBE", Light("tube", "tube", 600.0, "lumen", radius_m=0.02, length_m=1.2, **common)),
        ("DISK", Light("disk", "disk", 600.0, "lumen", width_m=0.45, **common)),
        ("IES SHAPE", Light("profile", "sphere", 700.0, "lumen", radius_m=0.05,
                            shaping=(("iesUse", "shape"), ("iesIntensity", False)),
                            profile=shapes["wall_washer.ies"].text(), **common)),
        ("RECT", rect("rect")),
        ("PENUMBRA", rect("penumbra", shaping=(("penumbraScale", 0.15),))),
        ("DOORS", rect("doors", door_angle_rad=0.35, door_length_m=0.3)),
        ("FLAPS", rect("flaps", shaping=doors)),
        ("PICTURE", rect("picture", pictures=(("sourceTexture", stripes()),))),
        ("CHANNELS", rect("channels")),
        ("SUN", Light("sun", "directional", 150.0, "lux", temperature_k=5200.0, angular_diameter_rad=0.02,
                      shaping=(("channels", SUN_CHANNELS), ("channelsCast", False)))),
        ("IES MASK", spot("profile mask", shaping=(("iesUse", "mask"),), profile=shapes["bollard_ring.ies"].text())),
        ("GRID", spot("grid", shaping=(("lightFunction", "grid"), ("lightFunctionScale", 0.2), *function))),
        ("BLINDS", spot("blinds", shaping=(("lightFunction", "blinds"), ("lightFunctionScale", 0.16),
                                           ("lightFunctionAngleRad", 0.4), *function))),
        ("CAUSTICS", spot("caustics", shaping=(("lightFunction", "caustics"), ("lightFunctionScale", 0.5),
                                               ("lightFunctionSpeed", 0.0), *function))),
        ("IMAGE", spot("image", shaping=(("lightFunction", "image"), ("lightFunctionScale", 1.2)),
                       pictures=(("lightFunctionImage", leaves()),))),
    ]


def shelves(columns, rows):
    """Boards, walls between bays and the back, one model; bays are open to +Z."""
    model = Model("shelves")
    width, height = columns * WIDE_M, rows * HIGH_M
    block(model, WALL, -BOARD_M / 2, width + BOARD_M / 2, -BOARD_M, height, -DEEP_M - BOARD_M, -DEEP_M)
    for column in range(columns + 1):
        x = column * WIDE_M
        block(model, WALL, x - BOARD_M / 2, x + BOARD_M / 2, -BOARD_M, height, -DEEP_M, 0)
    for row in range(rows + 1):
        y = row * HIGH_M
        block(model, WALL, 0, width, y - BOARD_M, y, -DEEP_M, 0)
    return model


def box(model):
    return model.add(PAINT, bevel_box(0.34, 0.5, 0.34, 0.008), translate(0.42, 0.252, -0.1) @ rotate_y(0.5))


def things(name):
    """What stands in every bay; its floor's middle is the origin."""
    model = Model(name)
    half = (WIDE_M - BOARD_M) / 4
    for material, x in ((ROUGH, -half), (SMOOTH, half)):
        model.add(material, quad(2 * half, DEEP_M - 0.04), translate(x, 0.002, 0) @ rotate_x(-math.pi / 2))
    return model.add(PLASTER, sphere(0.22, 40, 20), translate(-0.42, 0.222, 0.1))


def build():
    list_of_bays = bays()
    columns, rows = COLUMNS, len(list_of_bays) // COLUMNS
    scene = Scene("sampler", 5.6)
    scene.node("shelves", model=shelves(columns, rows))
    shared, fewer, alone = box(things("things")), things("things without a box"), box(Model("box"))
    wall = Model("wall").add(WALL, quad(WIDE_M - BOARD_M, HIGH_M - BOARD_M))
    stem = Model("fixture").add(FIXTURE, bevel_box(0.1, 0.06, 0.1, 0.006))
    for i, (word, light) in enumerate(list_of_bays):
        x, y = (i % columns + 0.5) * WIDE_M, (rows - 1 - i // columns) * HIGH_M
        bay = scene.node(f"bay {word.lower()}", matrix=translate(x, y, -DEEP_M / 2))
        sunny = light.type == "directional"
        if word == "CHANNELS":
            scene.node("things", bay, model=fewer)
            scene.node("box", bay, model=alone, channels=BOX_CHANNELS)
        else:
            scene.node("things", bay, model=shared, channels=SUN_CHANNELS if sunny else None)
        label = Model(f"label {word}").add(plate(word), quad(PLATE_M * 8, PLATE_M, unit_uv=True))
        scene.node("label", bay, translate(0, -BOARD_M / 2 + 0.0, DEEP_M / 2 + 0.012), model=label)
        top = HIGH_M - BOARD_M
        if sunny:
            scene.node("wall", bay, translate(0, (HIGH_M - BOARD_M) / 2, 0.004 - DEEP_M / 2), model=wall,
                       channels=SUN_CHANNELS)
            scene.node(light.name, bay, rotate_y(1.1) @ rotate_x(-0.8), light=light)
            continue
        scene.node("fixture", bay, translate(0, top - 0.03, 0.1), model=stem)
        scene.node(light.name, bay, translate(0, top - 0.2, 0.1) @ rotate_x(-math.pi / 2 + 0.12), light=light)
    width, height = columns * WIDE_M, rows * HIGH_M
    middle = (width / 2, height / 2 - 0.05, -0.6)
    scene.camera("wide", look_at((width / 2, height / 2 + 0.1, 7.6), middle), math.radians(46))
    scene.camera("doors", look_at((5.1, 2.55, 2.2), (6.1, 2.35, -0.8)), math.radians(38))
    scene.camera("masks", look_at((6.6, 0.95, 2.4), (6.9, 0.65, -0.8)), math.radians(42))
    return scene
