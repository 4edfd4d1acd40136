"""Evening in a museum room: warm track spots on pictures and sculptures, a cool skylight and a video wall,
tubes in a cove, globes over a reading corner, the last blue of dusk through a window."""
import math

from kit.gltf import Scene
from kit.plants import fig, palm
from kit.transform import look_at, rotate_y, translate

from . import exhibits, room
from . import lighting as L
from . import materials as M

BACK, RIGHT, FRONT = 0.0, -math.pi / 2, math.pi
# name, picture, width, height, centre, turn, frame
PICTURES = (
    ("Fields", "fields", 2.3, 1.75, (-2.35, 1.68, -3.999), BACK, M.OAK_FRAME),
    ("Circles", "circles", 1.35, 1.7, (0.75, 1.68, -3.999), BACK, M.BLACK_FRAME),
    ("Shards", "shards", 1.5, 1.5, (3.5, 1.65, -3.999), BACK, M.OAK_FRAME),
    ("Strokes", "strokes", 2.1, 1.5, (5.999, 1.62, -0.6), RIGHT, M.OAK_FRAME),
    ("Marble", "marble", 1.7, 1.7, (1.2, 1.66, 3.999), FRONT, M.BLACK_FRAME),
)
TRACK_BACK, TRACK_FRONT = -1.9, 1.7


def place_exhibits(scene):
    group = scene.node("exhibits")
    for name, key, width, height, centre, turn, frame in PICTURES:
        scene.node(name, group, translate(*centre) @ rotate_y(turn),
                   exhibits.picture(name, key, width, height, frame))
    plinth = exhibits.plinth(0.46, 1.0)
    for name, sculpture, (x, z), turn in (
            ("Orbit (plaster)", exhibits.sculpture_orbit(M.PLASTER_CAST), (-0.85, -1.55), 0.5),
            ("Gate (brass)", exhibits.sculpture_gate(M.POLISHED_BRASS), (2.15, -0.15), 0.2),
            ("Stack (clay)", exhibits.sculpture_stack(M.CLAY), (-3.55, -0.75), 0.2)):
        base = scene.node("plinth of " + name, group, translate(x, 0, z) @ rotate_y(0.06 * turn), plinth)
        scene.node(name, base, translate(0, 1.0, 0) @ rotate_y(turn), sculpture)
    case = scene.node("glass case", group, translate(3.9, 0, -1.75) @ rotate_y(-0.35), exhibits.glass_case())
    scene.node("case tube", case, translate(0, 1.488, 0.18), L.tube_model(L.CASE), L.CASE)
    scene.node("bench", group, translate(-0.9, 0, 0.95) @ rotate_y(0.04), exhibits.bench())
    scene.node("ropes", group, model=exhibits.rope_line([(-3.75, -2.85), (-2.35, -2.72), (-0.95, -2.85)]))
    table = scene.node("side table", group, translate(-4.9, 0, 3.1), exhibits.side_table())
    for k, (x, y, z) in enumerate(((-0.16, 2.05, 0.05), (0.2, 2.38, -0.16), (0.12, 1.78, 0.24))):
        scene.node(f"globe {k + 1}", table, translate(x, y, z), L.globe_model(L.GLOBE, room.HEIGHT_M - y),
                   L.GLOBE)
    scene.node("fig", group, translate(5.3, 0, -3.35) @ rotate_y(0.8),
               fig("fig", M.LEAF, M.BARK, M.POT, M.SOIL, 1.95, 96))
    scene.node("palm", group, translate(-5.35, 0, -0.1) @ rotate_y(2.0),
               palm("palm", M.PALM_LEAF, M.POT, M.SOIL, 1.75, 15))
    scene.node("corridor picture", group, translate(-4.95, 1.6, -7.899),
               exhibits.picture("corridor picture", "marble", 0.9, 0.9, M.BLACK_FRAME))


def place_track_lights(scene, group):
    rig = L.Rig(scene, group)
    rig.spot("Fields left", L.PICTURE, (-3.0, TRACK_BACK), (-2.85, 1.62, -4))
    rig.spot("Fields right", L.PICTURE, (-1.7, TRACK_BACK), (-1.85, 1.62, -4))
    rig.spot("Circles", L.PICTURE, (0.75, TRACK_BACK), (0.75, 1.6, -4))
    rig.spot("Shards", L.PICTURE, (3.4, TRACK_BACK), (3.5, 1.6, -4))
    rig.spot("Marble", L.PICTURE, (1.2, TRACK_FRONT), (1.2, 1.6, 4))
    rig.framer("Strokes", L.FRAMER, (3.9, -0.6), (6, 1.55, -0.6))
    rig.framer("Case", L.FRAMER, (3.2, TRACK_FRONT), (3.85, 1.1, -1.7))
    rig.spot("Orbit", L.ACCENT, (0.2, TRACK_BACK), (-0.85, 1.2, -1.55))
    rig.spot("Orbit back", L.ACCENT, (-2.2, TRACK_FRONT), (-0.85, 1.25, -1.55))
    rig.spot("Gate", L.ACCENT, (0.9, TRACK_FRONT), (2.15, 1.3, -0.15))
    rig.spot("Gate rim", L.ACCENT, (2.4, TRACK_BACK), (2.15, 1.3, -0.15))
    rig.spot("Stack", L.ACCENT, (-4.6, TRACK_FRONT), (-3.55, 1.25, -0.75))
    rig.spot("Stack rim", L.ACCENT, (-4.3, TRACK_BACK), (-3.55, 1.25, -0.75))
    rig.spot("Fig", L.SOFT_ACCENT, (4.6, TRACK_BACK), (5.3, 1.2, -3.35))
    rig.spot("Bench", L.SOFT_ACCENT, (-0.9, TRACK_FRONT), (-0.9, 0.4, 0.95))
    for k, x in enumerate((-4.2, -1.4, 2.9, 5.0)):
        rig.spot(f"Wall washer {k + 1}", L.WASHER, (x, TRACK_FRONT), (x * 1.05, 2.0, 4.0))


def build():
    scene = Scene("gallery", 5.5)
    shell = scene.node("building")
    for model in (room.floor(), room.walls(), room.ceiling(), room.cove(), room.window(), room.dusk_sky(),
                  room.tracks([(-5.2, 5.4, TRACK_BACK), (-5.2, 5.4, TRACK_FRONT), (3.4, 4.4, -0.6)])):
        scene.node(model.name, shell, model=model)
    place_exhibits(scene)
    lights = scene.node("lights")
    L.place_architectural(scene, lights)
    place_track_lights(scene, lights)
    scene.camera("wide", look_at((5.0, 1.62, 3.35), (-1.6, 1.45, -2.9)), math.radians(45))
    scene.camera("close", look_at((3.55, 1.52, 1.25), (1.55, 1.18, -1.0)), math.radians(34))
    scene.camera("case", look_at((2.75, 1.5, -0.35), (4.05, 1.12, -1.85)), math.radians(38))
    scene.camera("screen", look_at((0.2, 1.5, 0.6), (-5.6, 1.35, -1.9)), math.radians(44))
    scene.camera("window", look_at((1.9, 1.6, -1.7), (-5.4, 1.3, 2.3)), math.radians(44))
    return scene
