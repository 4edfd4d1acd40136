"""A night market after rain: three lanes of stalls under awnings, lanterns on strings, neon gates, lit
signs; 941 area lights, all in the view of camera `wide`, and a faint blue sky light from above."""
import math

import numpy as np

from kit.gltf import Scene
from kit.lights import Light
from kit.mesh import Model
from kit.noise import rng
from kit.shapes import sweep
from kit.transform import apply, look_at, rotate_x, rotate_y, translate

from . import fixtures as F
from . import goods, props, stalls, street
from . import materials as M

LIGHT_COUNT = 941
ASPECT = 16 / 9
WIDE_EYE, WIDE_TARGET, WIDE_YFOV = (-1.0, 3.35, 8.6), (0.7, 1.6, -12.0), math.radians(42)
LEFT, RIGHT = math.pi / 2, -math.pi / 2  # turn of a stall that stands on that side of its lane
PITCH_M = 3.25
FAR_Z = -9.0  # beyond it, models with less detail
# Blue of the sky after sunset, soft: as wide as a third of the sky.
SKY = Light("sky", "directional", 12.0, "lux", color=(0.22, 0.42, 1.0), angular_diameter_rad=0.7)


class Market:
    def __init__(self):
        self.scene = Scene("night market", 3.8)
        self.view = np.linalg.inv(look_at(WIDE_EYE, WIDE_TARGET))
        self.signs = F.Signs()
        self.models = {}
        self.random = rng(2024)
        self.lit = 0
        self.garlands = []  # awnings that can still carry string bulbs: (stall node)

    def in_view(self, point, margin=0.97):
        x, y, z = apply(self.view, point)
        t = math.tan(WIDE_YFOV / 2) * margin
        return z < -0.5 and abs(y) < -z * t and abs(x) < -z * t * ASPECT

    def shared(self, key, make):
        if key not in self.models:
            self.models[key] = make()
        return self.models[key]

    def lamp(self, name, parent, matrix, model, light, aim=None):
        """Fixture and light; `aim` turns the light against its fixture. False when out of the camera's
        view."""
        world = matrix if parent is None else parent.world() @ matrix
        if not self.in_view(world[:3, 3]):
            return False
        if aim is None:
            self.scene.node(name, parent, matrix, model, light)
        else:
            if model is not None:
                self.scene.node(name + " fixture", parent, matrix, model)
            self.scene.node(name, parent, matrix @ aim, light=light)
        self.lit += 1
        return True

    def neon(self, parent, matrix, color, length):
        model, light = self.shared(("neon", color, length), lambda: F.neon_tube(color, length))
        return self.lamp("neon", parent, matrix, model, light)

    def sign(self, parent, matrix, index, vertical):
        model, light, (_, _, depth) = self.signs.board(index, vertical)
        if not self.in_view((parent.world() @ matrix)[:3, 3]):
            return
        self.scene.node(model.name, parent, matrix, model)
        outward = translate(0, 0, depth / 2 + 0.012) @ rotate_y(math.pi)
        for turn in ((0.0, math.pi) if vertical else (0.0,)):
            self.lamp(light.name + " light", parent, matrix @ rotate_y(turn) @ outward, None, light,
                      np.eye(4))

    def lantern_kind(self, kind, near):
        light, width, height, ribs, flat = ((F.RED, 0.25, 0.20, 9, 0.34), (F.WARM, 0.205, 0.20, 8, 0.4),
                                            (F.AMBER, 0.148, 0.24, 11, 0.72))[kind]
        name = light.name if near else light.name + " far"
        return self.shared(("lantern", kind, near),
                           lambda: F.lantern(name, light, width, height, ribs, flat, near)), light

    def goods(self, kind, variant, detail):
        key = ("goods", kind, variant, detail)
        fruits = (("orange", "apple", "lime", "peach"), ("lemon", "aubergine", "apple", "orange"))[variant]
        makers = {"fruit": lambda: goods.fruit(f"fruit {variant}", fruits, 50 + variant, detail),
                  "bottles": lambda: goods.bottles(f"bottles {variant}", 60 + variant, detail),
                  "cloth": lambda: goods.cloth(f"cloth {variant}", 70 + variant, detail),
                  "pottery": lambda: goods.pottery(f"pottery {variant}", 80 + variant, detail),
                  "noodles": lambda: goods.noodles(f"noodles {variant}", 90 + variant, detail)}
        return self.shared(key, makers[kind])

    def stall(self, name, place, kind, detail):
        """One stall with everything on it; nothing when part of it would leave the wide view."""
        r = self.random
        corners = [(x, y, z) for x in (-1.5, 1.5) for y in (0.9, 2.9) for z in (-0.9, 1.5)]
        if not all(self.in_view(apply(place, c), 1.0) for c in corners):
            return
        look, near = int(r.integers(0, 5)), detail > 0
        node = self.scene.node(name, self.group, place)
        title = f"stall {look}" if near else f"stall {look} far"
        body = self.shared(("body", look, near), lambda: stalls.body(
            title, M.PAINTED[look], M.CURTAINS[look % 3], 400 + look, near))
        self.scene.node("body", node, model=body)
        cover = int(r.integers(0, 6))
        awning = self.shared(("awning", cover),
                             lambda: stalls.awning(f"awning {cover}", M.AWNINGS[cover], 500 + cover))
        self.scene.node("awning", node, model=awning)
        self.scene.node("goods", node, model=self.goods(kind, int(r.integers(0, 2)), detail))
        if r.random() < 0.55:
            pile = int(r.integers(0, 3))
            self.scene.node("clutter", node, translate(1.78, 0, 0.25 + r.uniform(-0.2, 0.3)),
                            self.shared(("clutter", pile),
                                        lambda: stalls.clutter(f"clutter {pile}", 600 + pile)))
        self.stall_lights(node, near)
        if detail == 2:  # one more lantern behind, so that the alleys are not pitch dark
            model, light = self.lantern_kind(1, True)
            behind = rotate_y(math.pi) @ translate(0, 0.1, 1.45 - stalls.BRACKET_Z)
            self.scene.node("bracket", node, behind, self.shared("bracket", stalls.bracket))
            self.lamp("lantern", node, translate(0, stalls.BRACKET_Y - 0.27, -1.45), model, light)
        self.garlands.append(node)

    def stall_lights(self, node, near):
        r = self.random
        bulb = self.shared("bulb", lambda: F.bulb("bulb", F.BULB, 0.34, (8, 4)))
        for x in (-0.9, 0.0, 0.9):
            at = translate(x + r.uniform(-0.12, 0.12), 2.02 + r.uniform(-0.06, 0.06), 0.30)
            self.lamp("bulb", node, at, bulb, F.BULB)
        choice = r.random()
        if choice < 0.45:
            model = self.shared("shade", lambda: F.shaded_lamp(F.SHADE, 0.30))
            self.lamp("shaded lamp", node, translate(r.uniform(-0.5, 0.5), 2.08, 0.72), model, F.SHADE,
                      F.down())
        elif choice < 0.75:
            model = self.shared("panel", lambda: F.panel_lamp(F.PANEL, 0.2))
            self.lamp("panel lamp", node, translate(r.uniform(-0.4, 0.4), 2.30, -0.25), model, F.PANEL,
                      F.down())
        for x in (-1.32, 1.32):
            if r.random() < 0.8:
                model, light = self.lantern_kind(int(r.integers(0, 3)), near)
                self.scene.node("bracket", node, translate(x, 0, 0), self.shared("bracket", stalls.bracket))
                at = translate(x, stalls.BRACKET_Y - 0.37 - r.uniform(0, 0.05), stalls.BRACKET_Z)
                self.lamp("lantern", node, at, model, light)
        self.stall_signs(node)

    def stall_signs(self, node):
        r = self.random
        index = int(r.integers(0, 10))
        if r.random() < 0.5:
            x = float(r.choice((-1.62, 1.62)))
            at = translate(x, 3.02 + r.uniform(0, 0.25), 0.95) @ rotate_y(math.pi / 2)
            self.sign(node, at, index, True)
            post = translate(x - math.copysign(0.09, x), 2.9, 0.62)
            self.scene.node("sign arm", node, post, self.shared("sign arm", F.sign_arm))
        else:
            self.sign(node, translate(0, 2.88, 0.62) @ rotate_x(-0.12), index, False)
        if r.random() < 0.5:
            color = ("pink", "cyan", "gold")[int(r.integers(0, 3))]
            for x in (-0.72, 0.72):
                at = translate(x, stalls.FRONT_Y - 0.13, stalls.AWNING_Z - 0.26) @ rotate_x(math.pi / 2)
                self.neon(node, at, color, 1.2)

    def rows(self):
        """Six rows of stalls along three lanes."""
        self.group = self.scene.node("stalls")
        kinds = ("fruit", "noodles", "pottery", "bottles", "cloth")
        # Lane x, side of the lane, number of stalls, distance of their centres from the middle of the lane.
        rows = ((0.0, -1, 13, 2.9), (0.0, 1, 13, 2.9), (-9.1, 1, 12, 2.75), (9.1, -1, 12, 2.75),
                (-9.1, -1, 12, 2.75), (9.1, 1, 12, 2.75))
        for number, (lane, side, count, offset) in enumerate(rows):
            for k in range(count):
                z = -0.6 - PITCH_M * k - (1.1 if number > 1 else 0.0)
                wobble = self.random.uniform(-0.02, 0.02)
                place = (translate(lane + side * (offset + self.random.uniform(-0.06, 0.06)), 0, z) @
                         rotate_y((LEFT if side < 0 else RIGHT) + wobble))
                kind = kinds[(k * 2 + number) % 5]
                detail = 0 if z < (FAR_Z if number < 2 else 0.6 * FAR_Z) else 2 if number < 2 and k < 3 else 1
                self.stall(f"stall {number + 1}.{k + 1}", place, kind, detail)

    def gates(self):
        group = self.scene.node("gates")
        model = self.shared("gate", lambda: street.gate("gate"))
        for k, z in enumerate((-18.0, -44.0)):
            node = self.scene.node(f"gate {k + 1}", group, translate(0, 0, z), model)
            for x, y, turn, length, color in street.gate_tubes():
                self.neon(node, street.turned(x, y, 0.18 if abs(x) > 0.6 else 0.24, turn), color, length)

    def strings(self):
        """Lanterns and bulbs on cables across the lanes."""
        group = self.scene.node("strings")
        lines, posts = [], set()
        fairy = self.shared("fairy", lambda: F.bulb("string bulb", F.FAIRY, 0.0, (7, 4)))
        for k in range(16):
            z = 3.0 - 3.1 * k
            for x0, x1 in ((-4.8, 4.8), (4.8, 13.4), (-13.4, -4.8)):
                main = x0 < 0 < x1
                if not main and k % 2:
                    continue
                if main and k < 2:  # these hang from poles out of the picture
                    x0, x1 = -6.6, 6.6
                start, end = (x0, 4.9, z), (x1, 4.9, z + (0.8 if k % 2 else -0.5))
                if not (self.in_view(start) and self.in_view(end)) and not (main and k < 2):
                    continue
                sag = 0.75 if main else 0.6
                lines.append((start, end, sag))
                posts.update(((x0, round(start[2], 2)), (x1, round(end[2], 2))))
                steps = 15 if main else 13
                for i, p in enumerate(street.hang(start, end, sag, steps)[1:-1]):
                    if i % 2 == 0:
                        model, light = self.lantern_kind(int(self.random.integers(0, 2)), z > FAR_Z)
                        turn = rotate_y(self.random.uniform(0, 6.28))
                        self.lamp("lantern", group, translate(p[0], p[1] - 0.31, p[2]) @ turn, model, light)
                    elif main:
                        self.lamp("string bulb", group, translate(p[0], p[1] - 0.09, p[2]), fairy, F.FAIRY)
        self.scene.node("cables", group, model=street.cables(lines))
        self.scene.node("poles", group, model=street.poles(sorted(posts), 5.0))

    def houses(self):
        group = self.scene.node("houses")
        houses = street.Houses(self.scene, group)
        r, number = rng(77), 0
        lamps = []
        x = -36.0
        while x < 38:
            width, height = r.uniform(6.0, 9.0), r.uniform(8.0, 13.0)
            place = translate(x + width / 2, 0, -50 - r.uniform(0, 1.5))
            lamps.append((houses.add(f"house {number}", place, width, height, 700 + number), width))
            x, number = x + width + 0.05, number + 1
        for side in (-1, 1):
            z = -11.0
            while z > -48:
                width, height = r.uniform(6.0, 9.0), r.uniform(6.5, 11.0)
                place = translate(side * (15.4 + r.uniform(0, 0.5)), 0, z - width / 2)
                place = place @ rotate_y(-side * math.pi / 2)
                lamps.append((houses.add(f"house {number}", place, width, height, 700 + number), width))
                z, number = z - width - 0.05, number + 1
        door = self.shared("door", lambda: F.panel_lamp(F.PANEL, 0.05))
        for node, width in lamps:
            self.lamp("door lamp", node, translate(0.2, 2.95, 0.30), door, F.PANEL, F.down())
            at = translate(-width / 2 + 1.2, 5.0, 0.5) @ rotate_y(math.pi / 2)
            self.sign(node, at, int(r.integers(0, 10)), True)

    def corners(self):
        """Tables under parasols and a handcart in the gaps that the stalls leave near the camera."""
        group = self.scene.node("corners")
        lamp = self.shared("parasol lamp", lambda: F.bulb("parasol bulb", F.BULB, 0.3))
        kinds = (("orange", "lime", "apple"), ("peach", "lemon", "aubergine"))
        places = ((-7.3, -3.0, 0.5), (6.9, -2.2, -0.6), (8.2, -5.6, -0.2), (-9.4, -6.4, 0.2))
        for k, (x, z, turn) in enumerate(places):
            parasol = props.parasol(M.AWNINGS[(2 * k + 1) % 6])
            node = self.scene.node(f"parasol {k + 1}", group, translate(x, 0, z) @ rotate_y(turn), parasol)
            table = self.shared(("table", k % 2), lambda: props.table(f"table {k % 2}", kinds[k % 2], 40 + k))
            self.scene.node("table", node, translate(0, 0, 0.75), table)
            for dx in (-0.45, 0.45):
                self.lamp("parasol bulb", node, translate(dx, props.PARASOL_LAMP_Y, 0.35), lamp, F.BULB)
        self.scene.node("handcart", group, translate(-5.75, 0, 0.15) @ rotate_y(1.0), props.handcart())
        shrub = self.shared("shrub", props.potted_shrub)
        for x, z in ((-5.15, -0.35), (5.1, 0.9), (5.45, 0.55), (-1.55, -45.3), (2.9, -45.3), (-2.9, -45.3)):
            self.scene.node("shrub", group, translate(x, 0, z) @ rotate_y(x * 3 + z), shrub)
        house = self.scene.node("tea house", group, translate(0, 0, -46.6), street.tea_house(F.TEA_HOUSE))
        self.lamp("tea house light", house, translate(0, 0.35 + 1.1, 0.02) @ rotate_y(math.pi), None,
                  F.TEA_HOUSE)

    def fill(self):
        """String bulbs along awning edges until the market has its count of lights."""
        bulb = self.shared("fairy", lambda: F.bulb("string bulb", F.FAIRY, 0.0, (7, 4)))
        wire = Model("wire").add(M.CABLE,
                                 sweep([(-1.5, 2.36, 1.56), (0, 2.30, 1.57), (1.5, 2.36, 1.56)], 0.006, 4))
        order = self.random.permutation(len(self.garlands))
        for slot in order:
            node = self.garlands[slot]
            if self.lit == LIGHT_COUNT:
                return
            self.scene.node("wire", node, model=wire)
            for k in range(6):
                if self.lit < LIGHT_COUNT:
                    at = translate((k - 2.5) * 0.44, 2.25 + 0.012 * abs(k - 2.5), 1.57)
                    self.lamp("string bulb", node, at, bulb, F.FAIRY)


def build():
    market = Market()
    scene = market.scene
    base = scene.node("street")
    scene.node("ground", base, model=street.ground())
    scene.node("gutter", base, translate(0, 0, 6), street.gutter(56, 9))
    scene.node("night sky", base, model=street.night_sky())
    market.houses()
    market.rows()
    market.gates()
    market.strings()
    market.corners()
    market.fill()
    if market.lit != LIGHT_COUNT:
        raise SystemExit(f"night_market has {market.lit} area lights in view, not {LIGHT_COUNT}")
    scene.node("sky light", matrix=look_at((-14, 30, 16), (0, 0, -16)), light=SKY)
    scene.camera("wide", look_at(WIDE_EYE, WIDE_TARGET), WIDE_YFOV)
    scene.camera("close", look_at((-0.62, 1.56, -1.0), (2.1, 1.26, -5.0)), math.radians(42))
    scene.camera("lane", look_at((0.5, 1.6, -5.5), (-0.6, 2.1, -18)), math.radians(48))
    return scene
