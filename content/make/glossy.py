"""A polished floor in strips of rising roughness under tubes and rectangles: highlights from mirror-like to wide, which fitted
specular light, light lists and the denoiser have to keep apart."""
import math

from kit.gltf import Scene
from kit.lights import Light
from kit.material import Material
from kit.mesh import Model
from kit.shapes import bevel_box, block, sphere
from kit.transform import look_at, rotate_y, translate
from sets import furniture as F
from sets import materials as M
from sets import shell
from sets.fixtures import Fixtures

WIDTH, DEPTH, HEIGHT = 10.0, 8.0, 3.6
ROUGHNESS = (0.05, 0.09, 0.14, 0.2, 0.28, 0.4)
TUBE_TINTS = ((1.0, 0.55, 0.3), (0.4, 0.65, 1.0), (1.0, 0.9, 0.75), (0.55, 1.0, 0.7), (1.0, 0.45, 0.6))


def lamp(name, kind, lumen, color, **shape):
    return Light(name, kind, lumen, "lumen", color=color, range_m=12.0, ray_end_bias_m=0.03, **shape)


def floor():
    model, step = Model("floor strips"), WIDTH / len(ROUGHNESS)
    for k, roughness in enumerate(ROUGHNESS):
        shade = 0.06 + 0.05 * (k % 2)
        block(model, Material(f"roughness {roughness}", (shade, shade, shade * 1.05), roughness), step * k + 0.003,
              step * (k + 1) - 0.003, -0.1, 0.02, 0, DEPTH, 0.003)
    return model


def build():
    scene = Scene("glossy", 4.6)
    group = scene.node("hall")
    grey = [M.paint("grey wall", (0.3, 0.3, 0.31), 0.8) for _ in range(4)]
    shell.closed_room(scene, group, WIDTH, DEPTH, HEIGHT, M.RUBBER, grey)
    scene.node("floor strips", group, model=floor())
    for k, roughness in enumerate(ROUGHNESS):
        x = WIDTH / len(ROUGHNESS) * (k + 0.5)
        metal = Material(f"metal {roughness}", (0.9, 0.75, 0.5), roughness, metallic=1.0)
        stand = Model(f"stand {k + 1}").add(M.PORCELAIN, bevel_box(0.5, 0.5, 0.5, 0.01), translate(0, 0.25, 0))
        stand.add(metal, sphere(0.24, 28, 16), translate(0, 0.74, 0))
        scene.node(stand.name, group, translate(x, 0.02, 2.6) @ rotate_y(0.3 * k), stand)
        box = Model(f"lacquer {k + 1}").add(Material(f"lacquer {roughness}", (0.25, 0.03, 0.03), roughness),
                                            bevel_box(0.6, 0.9, 0.4, 0.02), translate(0, 0.45, 0))
        scene.node(box.name, group, translate(x, 0.02, 5.0) @ rotate_y(0.4 - 0.2 * k), box)
    fixtures = Fixtures(scene, scene.node("lights"))
    for k in range(10):
        tube = lamp(f"tube {k % 5 + 1}", "tube", 420.0, TUBE_TINTS[k % 5], length_m=1.3, radius_m=0.015)
        fixtures.place(tube, translate(1.0 + 2.0 * (k % 5), 1.4 + 0.9 * (k // 5), 0.22), f"wall tube {k + 1}")
    for k in range(8):
        panel = lamp(f"panel {k % 2 + 1}", "rect", 520.0, ((1.0, 0.86, 0.7), (0.8, 0.9, 1.0))[k % 2], width_m=1.1,
                     height_m=0.22)
        fixtures.ceiling(panel, 1.6 + 2.25 * (k % 4), 2.0 + 3.4 * (k // 4), HEIGHT, 0.6, 0.3 * k)
    scene.camera("wide", look_at((5.0, 1.75, 7.7), (5.0, 0.5, 1.0)), math.radians(60))
    scene.camera("close", look_at((1.2, 1.3, 5.6), (3.2, 0.35, 1.4)), math.radians(46))
    return scene
