"""So many small lights of five types over a floor with things on it: `crowd_10000` has 10,000, about 30 in range of a point
whatever the number, since the floor grows with it. For scaling over lights."""
import math

from kit.gltf import Scene
from kit.lights import Light
from kit.mesh import Model
from kit.noise import rng
from kit.shapes import bevel_box, block, cylinder, sphere
from kit.transform import look_at, rotate_y, translate
from sets import furniture as F
from sets import materials as M

PER_M2 = 2.0
KINDS = (("sphere", dict(radius_m=0.04)), ("spot", dict(radius_m=0.03, inner_rad=0.3, outer_rad=0.8)),
         ("tube", dict(length_m=0.3, radius_m=0.01)), ("rect", dict(width_m=0.25, height_m=0.12)),
         ("disk", dict(width_m=0.16)))
TINTS = ((1.0, 0.78, 0.5), (1.0, 0.92, 0.8), (0.6, 0.78, 1.0))


def things(scene, side, r):
    models = [Model("block").add(M.PLASTER, bevel_box(0.5, 1.1, 0.5, 0.01), translate(0, 0.55, 0)),
              Model("ball").add(M.BRASS, sphere(0.35, 20, 12), translate(0, 0.35, 0)),
              Model("post").add(M.PORCELAIN, cylinder(0.12, 2.0, 16, 0.01)),
              F.drum(F.painted("blue enamel", (0.03, 0.10, 0.24)))]
    group = scene.node("things")
    for k in range(max(12, int(side * side / 6))):
        place = translate(r.uniform(0.4, side - 0.4), 0, r.uniform(0.4, side - 0.4)) @ rotate_y(r.uniform(0, 6.28))
        scene.node("thing", group, place, models[int(r.integers(0, len(models)))])


def build(count):
    scene, r = Scene(f"crowd of {count}", 4.0), rng(481)
    side = math.sqrt(count / PER_M2)
    ground = Model("ground")
    block(ground, M.polished_concrete(0.3, 0.35, 483), -1, side + 1, -0.2, 0, -1, side + 1)
    scene.node("ground", model=ground)
    things(scene, side, r)
    lights = [Light(f"{kind} {t + 1}", kind, 60.0, "lumen", color=tint, range_m=2.2, ray_end_bias_m=0.01, **shape)
              for kind, shape in KINDS for t, tint in enumerate(TINTS)]
    group = scene.node("lights")
    for k in range(count):
        eye = (r.uniform(0, side), r.uniform(0.6, 2.4), r.uniform(0, side))
        down = (eye[0] + r.uniform(-0.8, 0.8), 0.0, eye[2] + r.uniform(-0.8, 0.8))
        scene.node(f"light {k + 1}", group, look_at(eye, down, up=(0.1, 0, 1)), light=lights[int(r.integers(0, len(lights)))])
    scene.camera("wide", look_at((side * 0.5, 3.2, side + 0.8), (side * 0.5, 0.2, side - 5.0)), math.radians(54))
    scene.camera("above", look_at((side * 0.5, side * 0.7 + 3, side * 1.05), (side * 0.5, 0.0, side * 0.5)), math.radians(50))
    return scene
