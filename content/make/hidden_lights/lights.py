"""The lights of a layout: modest ones in the rooms that can be seen, ones 10 to 50 times as strong in sealed
rooms and cabinets, aimed at the hall that they never reach."""
import math

from kit.lights import Light
from kit.transform import look_at, rotate_x, rotate_y, translate

from .plan import shared_edge

DEG = math.pi / 180
TYPES = ("rect", "tube", "sphere", "spot", "disk")
VISIBLE_LM = {"rect": 900.0, "tube": 800.0, "sphere": 520.0, "spot": 650.0, "disk": 700.0}
RANGE_M = (11.0, 15.0)  # beyond the hall's diagonal: a pixel there is in range of most lights of the building


def definition(r, kind, factor=1.0, tint=(1.0, 1.0, 1.0), size=1.0, label=""):
    """One light definition; `factor` multiplies the flux that a visible one has."""
    lumen = round(VISIBLE_LM[kind] * factor * r.uniform(0.95, 1.05), 1)
    kelvin = float(round(r.uniform(3600, 5600), -2))
    common = dict(color=tint, temperature_k=kelvin, range_m=round(r.uniform(*RANGE_M), 2))
    name = f"{label} {kind}".strip()
    if kind == "rect":
        return Light(name, kind, lumen, "lumen", width_m=round(1.2 * size, 3), height_m=round(0.32 * size, 3),
                     ray_end_bias_m=0.02, **common)
    if kind == "tube":
        return Light(name, kind, lumen, "lumen", radius_m=0.019, length_m=round(1.15 * size, 3),
                     ray_end_bias_m=0.03, **common)
    if kind == "sphere":
        return Light(name, kind, lumen, "lumen", radius_m=round(0.11 * size, 3), ray_end_bias_m=0.03,
                     **common)
    if kind == "spot":
        outer = r.uniform(26, 44)
        return Light(name, kind, lumen, "lumen", radius_m=round(0.04 * size, 3), inner_rad=0.5 * outer * DEG,
                     outer_rad=outer * DEG, ray_end_bias_m=0.06, **common)
    return Light(name, kind, lumen, "lumen", width_m=round(0.34 * size, 3), ray_end_bias_m=0.02, **common)


def _grid(cell, pitch, margin):
    """Points of a regular grid over a cell."""
    wide, deep = cell.x1 - cell.x0 - 2 * margin, cell.z1 - cell.z0 - 2 * margin
    nx, nz = max(1, round(wide / pitch)), max(1, round(deep / pitch))
    return [(cell.x0 + margin + wide * (i + 0.5) / nx, cell.z0 + margin + deep * (k + 0.5) / nz)
            for i in range(nx) for k in range(nz)]


def place_visible(r, plan, fixtures):
    """Ceiling fixtures over the open cells, all five types in turn. Rectangles, disks and spots look down,
    globes and tubes hang lower and light the ceiling too."""
    tints = ((1.0, 1.0, 1.0), (1.0, 0.80, 0.58), (0.66, 0.83, 1.0))
    kinds = [definition(r, k, 1.0, tints[int(r.integers(0, 3)) if k in ("sphere", "tube") else 0])
             for k in TYPES]
    order = [kinds[i] for i in r.permutation(len(kinds))]
    count = 0
    for cell in plan.open_cells():
        pitch = 1.95 if cell is plan.hall else 2.1
        turn = 0.0 if cell.x1 - cell.x0 > cell.z1 - cell.z0 else math.pi / 2
        for x, z in _grid(cell, pitch, 0.5):
            light = order[count % len(order)]
            count += 1
            drop = {"sphere": round(r.uniform(0.55, 0.95), 1), "tube": 0.5,
                    "rect": float(r.choice((0.056, 0.35))),
                    "disk": 0.05, "spot": 0.14}[light.type]
            target = (x + r.uniform(-1.2, 1.2), 0.0, z + r.uniform(-1.2, 1.2))
            fixtures.ceiling(light, x + r.uniform(-0.15, 0.15), z + r.uniform(-0.15, 0.15), plan.height, drop,
                             turn,
                             target)
    return count


def strong_kinds(r):
    """Two definitions of each type, larger than a visible one and, with the spread of both, 10 to 50 times as
    strong."""
    return {k: [definition(r, k, r.uniform(12, 20), size=1.25, label="strong"),
                definition(r, k, r.uniform(25, 45), size=1.6, label="fierce")] for k in TYPES}


def place_sealed(r, plan, fixtures, kinds, count):
    """Behind the walls of the hall and of the other open cells, near to them and looking at them."""
    pairs = [(c, o, e) for c in plan.sealed_cells() for o in plan.open_cells() if (e := shared_edge(c, o))]
    at_hall = [p for p in pairs if p[1] is plan.hall]
    for k in range(count):
        choice = at_hall if k % 3 < 2 else pairs
        cell, target, (axis, at, lo, hi) = choice[int(r.integers(0, len(choice)))]
        # Long lights need room between the walls beside them.
        kind = TYPES[k % len(TYPES)] if hi - lo > 2.3 else ("sphere", "spot")[k % 2]
        light = kinds[kind][int(r.integers(0, 2))]
        depth = (cell.z1 - cell.z0) if axis == "x" else (cell.x1 - cell.x0)
        inward = 1.0 if (cell.z0 if axis == "x" else cell.x0) >= at - 1e-6 else -1.0
        s = r.uniform(lo + 1.05, hi - 1.05) if hi - lo > 2.3 else (lo + hi) / 2
        t, y = at + inward * r.uniform(0.5, min(1.8, depth - 0.6)), r.uniform(0.9, plan.height - 0.5)
        place = (s, y, t) if axis == "x" else (t, y, s)
        if kind in ("sphere", "tube"):
            turn = (0.0 if axis == "x" else math.pi / 2) + r.uniform(-0.25, 0.25)
            fixtures.bare(light, translate(*place) @ rotate_y(turn))
            continue
        across = (s, y, at - inward) if axis == "x" else (at - inward, y, s)
        tx, tz = target.centre()
        aim = (tx + r.uniform(-1, 1), 0.8, tz + r.uniform(-1, 1)) if kind == "spot" else across
        fixtures.bare(light, look_at(place, aim))


def place_in_cabinet(r, fixtures, kinds, cabinet, k):
    """One light in the middle of a closed cabinet, looking out of its doors."""
    light = kinds[("spot", "sphere", "disk")[k % 3]][int(r.integers(0, 2))]
    fixtures.bare(light, cabinet @ translate(0, r.uniform(0.9, 1.2), 0.0) @ rotate_y(math.pi))
