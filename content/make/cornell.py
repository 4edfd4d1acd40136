"""Cornell box for tests: 2 m room, two blocks, a rectangle light in the ceiling; two cameras."""
import math

from kit.gltf import Scene
from kit.lights import Light
from kit.material import Material
from kit.mesh import Model
from kit.shapes import bevel_box, quad
from kit.transform import look_at, rotate_x, rotate_y, translate

# Reflectances in the spirit of the measured box at Cornell, as Rec. 709 triples.
WHITE = Material("white", (0.73, 0.71, 0.68), 0.9)
RED = Material("red", (0.57, 0.043, 0.044), 0.9)
GREEN = Material("green", (0.11, 0.41, 0.09), 0.9)
LIGHT = Light("ceiling light", "rect", 1500.0, "nit", temperature_k=3500.0, width_m=0.5, height_m=0.5,
              range_m=12.0, ray_end_bias_m=0.02)
LAMP_FACE = Material("lamp face", (0.0, 0.0, 0.0), 1.0, emission_nit=LIGHT.face_nit())


def room():
    model = Model("room")
    half = math.pi / 2
    model.add(WHITE, quad(2, 2, divisions=4), translate(0, 0, 0) @ rotate_x(-half))   # floor
    model.add(WHITE, quad(2, 2, divisions=4), translate(0, 2, 0) @ rotate_x(half))    # ceiling
    model.add(WHITE, quad(2, 2, divisions=4), translate(0, 1, -1))                    # back wall
    model.add(RED, quad(2, 2, divisions=4), translate(-1, 1, 0) @ rotate_y(half))
    model.add(GREEN, quad(2, 2, divisions=4), translate(1, 1, 0) @ rotate_y(-half))
    return model


def build():
    scene = Scene("cornell", 5.5)
    scene.node("room", model=room())
    block = Model("tall block").add(WHITE, bevel_box(0.58, 1.2, 0.58, 0.004))
    cube = Model("short block").add(WHITE, bevel_box(0.58, 0.58, 0.58, 0.004))
    scene.node("tall block", matrix=translate(-0.34, 0.6, -0.32) @ rotate_y(0.31), model=block)
    scene.node("short block", matrix=translate(0.36, 0.29, 0.36) @ rotate_y(-0.29), model=cube)
    lamp = Model("lamp").add(LAMP_FACE, quad(0.5, 0.5))
    down = rotate_x(math.pi / 2)
    scene.node("lamp", matrix=translate(0, 1.995, 0) @ down, model=lamp)
    # The light looks down its -Z, the lamp's face along its +Z.
    scene.node("ceiling light", matrix=translate(0, 1.99, 0) @ rotate_x(-math.pi / 2), light=LIGHT)
    scene.camera("front", look_at((0, 1, 3.75), (0, 1, 0)), math.radians(40), 1.0)
    scene.camera("close", look_at((0.2, 0.9, 1.9), (0.0, 0.45, -0.2)), math.radians(46))
    return scene
