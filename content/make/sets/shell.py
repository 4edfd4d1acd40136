"""Walls, slabs, openings. Light must not find its way through a joint: walls reach into slabs and into the
walls they meet, and only surfaces that nobody sees coincide."""
from dataclasses import dataclass, field

from kit.mesh import Model
from kit.shapes import block

from . import materials as M

WALL_M = 0.14
DOOR_HEIGHT_M = 2.3
INTO_SLAB_M = 0.06


@dataclass(eq=False)
class Wall:
    """On a centre line: `axis` "x" runs along X at z = `at`, "z" along Z at x = `at`, from `lo` to `hi`."""
    axis: str
    at: float
    lo: float
    hi: float
    material: object = None
    thickness_m: float = WALL_M
    openings: list = field(default_factory=list)  # (from, to, height)


def along(model, material, wall, lo, hi, y0, y1, half, bevel=0.004):
    """A box that follows a wall's centre line."""
    if wall.axis == "x":
        block(model, material, lo, hi, y0, y1, wall.at - half, wall.at + half, bevel)
    else:
        block(model, material, wall.at - half, wall.at + half, y0, y1, lo, hi, bevel)


def _lining(model, wall, lo, hi, top):
    half = wall.thickness_m / 2 + 0.018
    for a, b in ((lo - 0.012, lo + 0.03), (hi - 0.03, hi + 0.012)):
        along(model, M.BLACK_METAL, wall, a, b, -0.01, top - 0.028, half, 0.003)
    along(model, M.BLACK_METAL, wall, lo - 0.012, hi + 0.012, top - 0.03, top + 0.012, half + 0.001, 0.003)


def add_wall(model, wall, height):
    """Piers of full height between the openings, lintels over them, a dark skirting, a lining in each
    opening."""
    material, half = wall.material or M.PLASTER, wall.thickness_m / 2
    at, skirting = wall.lo, 0.08
    for lo, hi, top in sorted(wall.openings) + [(wall.hi, None, None)]:
        along(model, material, wall, at, lo, -INTO_SLAB_M, height + INTO_SLAB_M, half)
        along(model, M.SKIRTING, wall, at - 0.009, lo + 0.009, -0.02, skirting, half + 0.009, 0)
        if hi is None:
            break
        # 2 mm thinner than the piers that it reaches into: nothing flickers there.
        along(model, material, wall, lo - 0.05, hi + 0.05, top, height + INTO_SLAB_M, half - 0.002)
        _lining(model, wall, lo, hi, top)
        at = hi


def slabs(width, depth, height, floor, ceiling=M.CEILING, overhang=0.3):
    """Floor and ceiling, one box each, over 0..width and 0..depth and somewhat further."""
    model = Model("slabs")
    x1, z1 = width + overhang, depth + overhang
    block(model, floor, -overhang, x1, -0.25, 0, -overhang, z1)
    block(model, ceiling, -overhang, x1, height, height + 0.25, -overhang, z1)
    return model


def outer_walls(width, depth, thickness=0.2):
    """Centre lines are at 0 and at width or depth; the walls along Z end inside those along X."""
    half = thickness / 2
    return [Wall("x", 0.0, -half, width + half, None, thickness),
            Wall("x", depth, -half, width + half, None, thickness),
            Wall("z", 0.0, 0.0, depth, None, thickness), Wall("z", width, 0.0, depth, None, thickness)]


def closed_room(scene, group, width, depth, height, floor, paints=()):
    """Nodes "slabs" and "walls" of a room over 0..width and 0..depth without openings; `paints` are its walls' materials in
    the order of outer_walls(), plaster where there are none."""
    scene.node("slabs", group, model=slabs(width, depth, height, floor))
    walls = Model("walls")
    for k, wall in enumerate(outer_walls(width, depth)):
        wall.material = paints[k] if k < len(paints) else None
        add_wall(walls, wall, height)
    scene.node("walls", group, model=walls)
