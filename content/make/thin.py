"""Thin things before strong lights: fences of bars, wire mesh, cables, a railing, a spoked wheel. What a voxel, a proxy or a
low-resolution depth buffer loses, shadows here show."""
import math

from kit.gltf import Scene
from kit.lights import Light
from kit.mesh import Model
from kit.shapes import bar, rod, sweep, torus
from kit.transform import look_at, rotate_x, rotate_y, rotate_z, translate
from sets import furniture as F
from sets import materials as M
from sets import shell
from sets.fixtures import Fixtures

WIDTH, DEPTH, HEIGHT = 9.0, 7.0, 3.4


def lamp(name, kind, lumen, kelvin, **shape):
    return Light(name, kind, lumen, "lumen", temperature_k=kelvin, range_m=12.0, ray_end_bias_m=0.02, **shape)


POINT = lamp("small globe", "sphere", 1200.0, 3000.0, radius_m=0.03)
SPOT = lamp("spot", "spot", 2200.0, 4600.0, radius_m=0.03, inner_rad=0.3, outer_rad=0.6)
TUBE = lamp("tube", "tube", 900.0, 5600.0, length_m=1.2, radius_m=0.015)
PANEL = lamp("panel", "rect", 1500.0, 6500.0, width_m=1.2, height_m=0.4)


def fence(length, height, step, radius):
    """Upright bars between two rails, along X."""
    model = Model("fence")
    for y in (0.12, height - 0.1):
        model.add(M.BLACK_METAL, bar((-length / 2, y, 0), (length / 2, y, 0), 0.03, 0.012, 0.002))
    for k in range(int(length / step) + 1):
        x = -length / 2 + step * k
        model.add(M.BLACK_METAL, rod((x, 0, 0), (x, height, 0), radius, 6))
    return model


def wire_mesh(width, height, step, radius):
    model = Model("wire mesh")
    for k in range(int(width / step) + 1):
        x = -width / 2 + step * k
        model.add(M.STEEL, rod((x, 0, radius), (x, height, radius), radius, 4))
    for k in range(int(height / step) + 1):
        model.add(M.STEEL, rod((-width / 2, step * k, -radius), (width / 2, step * k, -radius), radius, 4))
    for s in (-1, 1):
        F.box(model, M.BLACK_METAL, 0.03, height + 0.03, 0.03, s * (width / 2 + 0.015), 0, 0, 0, 0.003)
    return model


def wheel(radius, spokes):
    model = Model("wheel").add(M.STEEL, torus(radius, 0.012, 40, 8), rotate_x(math.pi / 2))
    for k in range(spokes):
        a = 2 * math.pi * k / spokes
        model.add(M.STEEL, rod((0, 0, 0.02 * (-1) ** k), (radius * math.cos(a), radius * math.sin(a), 0), 0.0015, 4))
    return model.add(M.BLACK_METAL, rod((0, 0, -0.04), (0, 0, 0.04), 0.02, 8))


def cables():
    """Slack between the walls below the ceiling."""
    model = Model("cables")
    for k in range(9):
        z, drop = 0.7 + 0.65 * k, 0.3 + 0.04 * (k * 5 % 7)
        points = [(WIDTH * t / 12, HEIGHT - 0.3 - drop * 4 * (t / 12) * (1 - t / 12), z) for t in range(13)]
        model.add(M.RUBBER, sweep(points, 0.004 + 0.002 * (k % 3), 5))
    return model


def build():
    scene = Scene("thin", 5.0)
    group = scene.node("yard")
    shell.closed_room(scene, group, WIDTH, DEPTH, HEIGHT, M.polished_concrete(0.4, 0.5, 461))
    scene.node("fence near", group, translate(5.6, 0, 4.4) @ rotate_y(0.1), fence(3.0, 1.5, 0.1, 0.008))
    scene.node("fence far", group, translate(2.6, 0, 1.5) @ rotate_y(-0.15), fence(3.4, 1.9, 0.07, 0.005))
    scene.node("wire mesh", group, translate(6.4, 0.02, 1.7) @ rotate_y(-0.4), wire_mesh(2.0, 1.8, 0.05, 0.0015))
    scene.node("fine mesh", group, translate(1.4, 0.02, 3.8) @ rotate_y(0.9), wire_mesh(1.2, 1.5, 0.03, 0.001))
    scene.node("wheel", group, translate(4.2, 0.36, 3.0) @ rotate_y(0.7) @ rotate_z(0.1), wheel(0.34, 32))
    scene.node("cables", group, model=cables())
    oak = M.timber("oak", (0.42, 0.29, 0.16), 0.5, 463)
    for model, x, z, a in ((F.ornament(M.PORCELAIN, 465), 7.4, 3.2, 0.4), (F.bench(oak), 4.6, 1.0, 0.0)):
        scene.node(model.name, group, translate(x, 0, z) @ rotate_y(a), model)
    fixtures = Fixtures(scene, scene.node("lights"))
    fixtures.ceiling(POINT, 3.2, 0.7, HEIGHT, 1.3)
    fixtures.ceiling(POINT, 6.2, 3.6, HEIGHT, 1.6)
    fixtures.ceiling(SPOT, 8.2, 0.8, HEIGHT, 0.3, target=(5.6, 0.4, 2.6))
    fixtures.ceiling(SPOT, 0.8, 6.2, HEIGHT, 0.3, target=(2.2, 0.4, 3.4))
    fixtures.place(TUBE, translate(0.16, 2.3, 2.4) @ rotate_y(math.pi / 2))
    fixtures.ceiling(PANEL, 4.5, 5.6, HEIGHT, 0.056)
    scene.camera("wide", look_at((7.8, 1.8, 6.5), (3.6, 0.7, 1.7)), math.radians(54))
    scene.camera("close", look_at((3.2, 1.1, 4.6), (5.2, 0.5, 2.2)), math.radians(46))
    return scene
