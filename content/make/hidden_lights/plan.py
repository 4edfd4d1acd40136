"""A floor plan from a seed: a rectangle cut in two again and again, one cut of some seeds being a corridor;
the largest cell is the hall. Openings join about half of the cells to the hall, the others are sealed."""
from dataclasses import dataclass, field

from sets.shell import DOOR_HEIGHT_M, Wall, outer_walls

MIN_CELL_M = 2.9
CLEAR_M = 0.45  # between an opening and the next wall


@dataclass(eq=False)
class Cell:
    x0: float
    z0: float
    x1: float
    z1: float
    corridor: bool = False
    open: bool = False
    doorways: list = field(default_factory=list)  # (x, z, width) of the openings and closed doors

    def area(self):
        return (self.x1 - self.x0) * (self.z1 - self.z0)

    def centre(self):
        return (self.x0 + self.x1) / 2, (self.z0 + self.z1) / 2


@dataclass(eq=False)
class Plan:
    width: float
    depth: float
    height: float
    walls: list
    cells: list
    hall: Cell = None

    def open_cells(self):
        return [c for c in self.cells if c.open]

    def sealed_cells(self):
        return [c for c in self.cells if not c.open]


def _cut(cell, axis, at):
    """The wall and the two cells of a cut along X (at a z) or along Z (at an x)."""
    if axis == "x":
        wall = Wall("x", at, cell.x0, cell.x1)
        return wall, Cell(cell.x0, cell.z0, cell.x1, at), Cell(cell.x0, at, cell.x1, cell.z1)
    wall = Wall("z", at, cell.z0, cell.z1)
    return wall, Cell(cell.x0, cell.z0, at, cell.z1), Cell(at, cell.z0, cell.x1, cell.z1)


def _corridor(r, cell, walls):
    """Two cuts 1.9 to 2.3 m apart, across the longer side's middle third."""
    axis = "x" if r.random() < 0.5 else "z"
    low, high = (cell.z0, cell.z1) if axis == "x" else (cell.x0, cell.x1)
    at = low + (high - low) * r.uniform(0.52, 0.60)
    first, near, rest = _cut(cell, axis, at)
    second, hallway, far = _cut(rest, axis, at + r.uniform(1.9, 2.3))
    hallway.corridor = True
    walls += [first, second]
    return [near, far], [hallway]


def _split(r, cell, walls, cells, keep_m2):
    """Cuts the longer side until cells are small; a cell below `keep_m2` may stay as it is."""
    wide, deep = cell.x1 - cell.x0, cell.z1 - cell.z0
    longer = max(wide, deep)
    if longer < 2 * MIN_CELL_M or cell.area() < keep_m2:
        cells.append(cell)
        return
    axis = "z" if wide >= deep else "x"
    low = cell.x0 if axis == "z" else cell.z0
    share = r.uniform(MIN_CELL_M / longer, 1 - MIN_CELL_M / longer)
    share = 0.5 + (share - 0.5) * 0.8
    wall, first, second = _cut(cell, axis, low + longer * share)
    walls.append(wall)
    # The halves differ in how large they may stay, so that one hall comes out among small rooms.
    big = r.random() < 0.5
    _split(r, first, walls, cells, keep_m2 * (1.0 if big else 0.45))
    _split(r, second, walls, cells, keep_m2 * (0.45 if big else 1.0))


def shared_edge(a, b):
    """(axis, at, lo, hi) of the wall between two cells, or None."""
    for axis, a0, a1, b0, b1, lo, hi in (
            ("z", a.x0, a.x1, b.x0, b.x1, max(a.z0, b.z0), min(a.z1, b.z1)),
            ("x", a.z0, a.z1, b.z0, b.z1, max(a.x0, b.x0), min(a.x1, b.x1))):
        if hi - lo < 1.0:
            continue
        if abs(a1 - b0) < 1e-6 or abs(b1 - a0) < 1e-6:
            return axis, a1 if abs(a1 - b0) < 1e-6 else a0, lo, hi
    return None


def _open_between(r, plan, a, b):
    """Cuts an opening into the wall between two cells."""
    axis, at, lo, hi = shared_edge(a, b)
    wall = next(w for w in plan.walls
                if w.axis == axis and abs(w.at - at) < 1e-6 and w.lo <= lo + 1e-6 and w.hi >= hi - 1e-6)
    room = hi - lo - 2 * CLEAR_M
    width = min(room, r.uniform(1.6, 2.8) if room > 2.2 else 1.0)
    start = lo + CLEAR_M + r.uniform(0, max(room - width, 0.0))
    top = min(DOOR_HEIGHT_M + r.uniform(0.0, 0.35), plan.height - 0.35)
    wall.openings.append((start, start + width, top))
    middle = start + width / 2
    point = (middle, at, width) if axis == "x" else (at, middle, width)
    a.doorways.append(point)
    b.doorways.append(point)


def _join(r, plan):
    """Opens cells one by one from the hall, corridors first, until half of the cells are open."""
    plan.hall = max((c for c in plan.cells if not c.corridor), key=Cell.area)
    plan.hall.open = True
    goal = max(3, round(0.5 * len(plan.cells)))
    while len(plan.open_cells()) < goal:
        doors = [(a, b) for a in plan.open_cells() for b in plan.sealed_cells()
                 if (edge := shared_edge(a, b)) and edge[3] - edge[2] > 2 * CLEAR_M + 0.95]
        if not doors:
            break
        first = [d for d in doors if d[1].corridor] or doors
        a, b = first[int(r.integers(0, len(first)))]
        _open_between(r, plan, a, b)
        b.open = True


def make(r, accent):
    """A plan of 14 to 18 m by 11 to 14 m with 6 to 12 cells; walls along X or Z may wear the accent paint."""
    while True:
        plan = Plan(r.uniform(14.0, 18.0), r.uniform(11.0, 14.0), r.uniform(2.9, 3.8), [], [])
        plan.walls = outer_walls(plan.width, plan.depth)
        whole, parts, done = Cell(0, 0, plan.width, plan.depth), None, []
        parts = [whole]
        if r.random() < 0.6:
            parts, done = _corridor(r, whole, plan.walls)
        for part in parts:
            _split(r, part, plan.walls, plan.cells, r.uniform(50, 64))
        plan.cells += done
        _join(r, plan)
        sealed = [c for c in plan.sealed_cells() if shared_edge(c, plan.hall)]
        hall = plan.hall
        slim = min(hall.x1 - hall.x0, hall.z1 - hall.z0)
        roomy = slim > 5.2 and hall.area() > 36
        if roomy and 6 <= len(plan.cells) <= 12 and len(sealed) >= 2 and hall.doorways:
            break
    for wall in plan.walls[4:]:
        if r.random() < 0.35:
            wall.material = accent
    return plan
