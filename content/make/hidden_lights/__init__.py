"""Seeded interiors with strong hidden lights, for measuring how well sampling learns what is visible: about
half of the lights, 10 to 50 times as strong as the others, are in sealed rooms and closed cabinets; two large
rectangles stand half behind screens. `hidden_lights_N` is the layout of seed N."""
import math

from kit.gltf import Scene
from kit.lights import Light
from kit.mesh import Model
from kit.noise import rng
from kit.transform import look_at, translate
from sets import furniture, shell
from sets import materials as M
from sets.fixtures import Fixtures

from . import furnish, lights, plan

EYE_M = 1.66
ACCENTS = ((0.16, 0.26, 0.28), (0.42, 0.18, 0.10), (0.45, 0.33, 0.13), (0.13, 0.20, 0.34), (0.24, 0.29, 0.17))


def floor_material(seed):
    return (M.polished_concrete, M.boards, M.tiles)[(seed + 1) % 3](seed=seed * 10 + 1)


def camera_corner(building):
    """The corner of the hall from which most doorways lie ahead, and the point that is looked at."""
    hall = building.hall
    cx, cz = hall.centre()
    best = None
    for sx in (-1, 1):
        for sz in (-1, 1):
            x = (hall.x0 + 0.62) if sx < 0 else (hall.x1 - 0.62)
            z = (hall.z0 + 0.62) if sz < 0 else (hall.z1 - 0.62)
            score = sum(math.hypot(dx - x, dz - z) for dx, dz, _ in hall.doorways)
            score -= 20 * sum(math.hypot(dx - x, dz - z) < 1.3 for dx, dz, _ in hall.doorways)
            if best is None or score > best[0]:
                best = (score, (x, EYE_M, z), (cx - 0.18 * sx * (hall.x1 - hall.x0), 1.12,
                                               cz - 0.18 * sz * (hall.z1 - hall.z0)))
    return best[1], best[2]


def solid_spans(building, eye):
    """(axis, face, lo, hi, inward) of the hall's wall faces without openings, far sides of the camera
    first."""
    hall, out = building.hall, []
    for axis, at, inward, lo, hi in (("x", hall.z0, 1, hall.x0, hall.x1),
                                     ("x", hall.z1, -1, hall.x0, hall.x1),
                                     ("z", hall.x0, 1, hall.z0, hall.z1),
                                     ("z", hall.x1, -1, hall.z0, hall.z1)):
        outer = at in (0.0, building.width, building.depth)
        cuts = sorted((x if axis == "x" else z, width / 2 + 0.15) for x, z, width in hall.doorways
                      if abs((z if axis == "x" else x) - at) < 1e-6)
        edges = [lo + 0.1] + [c + s * half for c, half in cuts for s in (-1, 1)] + [hi - 0.1]
        for a, b in zip(edges[::2], edges[1::2]):
            if b - a > 2.4:
                out.append((axis, at + inward * (0.1 if outer else shell.WALL_M / 2), a, b, inward))
    distance = {s: abs((eye[2] if s[0] == "x" else eye[0]) - s[1]) for s in out}
    return sorted(out, key=lambda s: -distance[s])


def place_panels(r, furnisher, room, fixtures, eye):
    """Two large rectangles, each half behind a screen."""
    count = 0
    for span in solid_spans(furnisher.plan, eye):
        axis, at, lo, hi, _ = span
        width = round(min(2.6, hi - lo - 0.5), 2)
        s = r.uniform(lo + width / 2 + 0.2, hi - width / 2 - 0.2)
        away = math.hypot((eye[0] if axis == "x" else eye[2]) - s, (eye[2] if axis == "x" else eye[0]) - at)
        if away < 0.6 * width + 1.6 or count == 2:
            continue
        light = Light("half hidden panel" if count == 0 else f"half hidden panel {count + 1}", "rect",
                      round(r.uniform(130, 190), 1), "nit", temperature_k=float(r.choice((3500, 5000, 6500))),
                      width_m=width, height_m=1.5, range_m=14.0, ray_end_bias_m=0.02)
        screen = furniture.screen(furniture.painted("screen cloth", (0.30, 0.28, 0.25), 0.9),
                                  round(width * 0.5, 2),
                                  2.25)
        furnish.half_hidden_panel(r, furnisher, room, fixtures, light, screen, span, s)
        count += 1
    return count


def build(seed):
    r = rng(9000 + seed)
    accent = M.paint("accent wall", ACCENTS[seed % len(ACCENTS)], 0.85)
    building = plan.make(r, accent)
    scene = Scene(f"hidden lights {seed}", 4.9)
    base = scene.node("building")
    scene.node("slabs", base, model=shell.slabs(building.width, building.depth, building.height,
                                                floor_material(seed)))
    walls = Model("walls")
    for wall in building.walls:
        shell.add_wall(walls, wall, building.height)
    scene.node("walls", base, model=walls)

    timber = M.timber(color=((0.42, 0.29, 0.16), (0.30, 0.17, 0.09), (0.46, 0.36, 0.24))[seed % 3],
                      seed=40 + seed)
    column = (M.PORCELAIN, accent, M.PLASTER)[seed % 3]
    furnisher = furnish.Furnisher(r, scene, building, timber, column)
    fixtures = Fixtures(scene, scene.node("lights"))
    kinds = lights.strong_kinds(r)
    eye, target = camera_corner(building)
    hall = building.hall
    toward = math.atan2(target[2] - eye[2], target[0] - eye[0])
    view = [(eye[0] + d * math.cos(toward), eye[2] + d * math.sin(toward), s)
            for d, s in ((0, 1.5), (1.3, 0.9), (2.4, 0.5))]
    visible = lights.place_visible(r, building, fixtures)
    cabinets = 0
    for cell in building.open_cells():
        room = furnish.Room(r, cell, [(x, z, 0.5 + 0.5 * w) for x, z, w in cell.doorways])
        if cell is hall:
            visible += place_panels(r, furnisher, room, fixtures, eye)
            furnisher.doors()
            room.circles += view + [(x, z, 0.6) for x, z, _ in hall.doorways]
            furnisher.columns(room, int(r.integers(1, 4)), view)
        if not cell.corridor:
            cabinets += furnisher.cabinets(room, 3 if cell is hall else 1, fixtures, kinds, cabinets, eye)
        furnisher.fill(room, max(2, round(cell.area() / (3.4 if cell is hall else 4.5))))
    lights.place_sealed(r, building, fixtures, kinds, max(8, visible - cabinets))
    pipe = furniture.pipe(((hall.x0, building.height - 0.2, 0), (hall.x1, building.height - 0.2, 0)), 0.045)
    for share in (0.3, 0.34):
        scene.node("pipe", base, translate(0, 0, hall.z0 + (hall.z1 - hall.z0) * share), pipe)
    scene.camera("wide", look_at(eye, target), math.radians(52))
    return scene
