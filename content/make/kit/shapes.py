"""Basic solids and sheets. Sizes in metres; UVs in metres too unless a function says 0..1. Edges that a
razor would be proud of do not exist: boxes, prisms and lathes carry bevels that catch highlights."""
import math

import numpy as np

from .mesh import Mesh, merge
from .transform import align_x, translate


def bevel_box(sx, sy, sz, bevel=0.004):
    """Box centred at the origin. Face corners are pulled in by the bevel; strips and corners between them
    share the faces' vertices, so the shading runs smoothly around each edge: 24 vertices, 44 triangles.
    Without a bevel (things that are only seen from afar): 24 vertices, 12 triangles."""
    half = np.array([sx, sy, sz]) / 2
    b = min(bevel, 0.49 * min(sx, sy, sz))
    positions, normals, uvs, index = [], [], [], {}
    axes = {0: (2, 1, -1, 1), 1: (0, 2, 1, -1),
            2: (0, 1, 1, 1)}  # face axis -> u axis, v axis and their signs
    for axis in range(3):
        for side in (-1, 1):
            for corner in np.ndindex(2, 2, 2):
                s = np.array(corner) * 2 - 1
                if s[axis] != side:
                    continue
                p = s * (half - b)
                p[axis] = side * half[axis]
                n = np.zeros(3)
                n[axis] = side
                ua, va, us, vs = axes[axis]
                index[(axis, tuple(s))] = len(positions)
                positions.append(p)
                normals.append(n)
                uvs.append((p[ua] * us * side if axis != 1 else p[ua],
                            -p[va] * vs if axis != 1 else p[va] * side))
    triangles = []

    def polygon(ids):
        points = [positions[i] for i in ids]
        n = np.cross(points[1] - points[0], points[2] - points[0])
        if np.dot(n, np.sum(points, axis=0)) < 0:  # convex and centred: outward is away from the origin
            ids = ids[::-1]
        for k in range(1, len(ids) - 1):
            triangles.append((ids[0], ids[k], ids[k + 1]))

    for axis in range(3):
        o1, o2 = [a for a in range(3) if a != axis]
        for side in (-1, 1):
            ring = []
            for a, c in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                s = [0, 0, 0]
                s[axis], s[o1], s[o2] = side, a, c
                ring.append(index[(axis, tuple(s))])
            polygon(ring)
        for a in (-1, 1) if b > 0 else ():  # the four edges that run along this axis
            for c in (-1, 1):
                lo, hi = [0, 0, 0], [0, 0, 0]
                lo[axis], hi[axis] = -1, 1
                lo[o1] = hi[o1] = a
                lo[o2] = hi[o2] = c
                polygon([index[(o1, tuple(lo))], index[(o1, tuple(hi))], index[(o2, tuple(hi))],
                         index[(o2, tuple(lo))]])
    for corner in np.ndindex(2, 2, 2) if b > 0 else ():
        s = tuple(np.array(corner) * 2 - 1)
        polygon([index[(0, s)], index[(1, s)], index[(2, s)]])
    return Mesh(positions, normals, uvs, triangles)


def block(model, material, x0, x1, y0, y1, z0, z1, bevel=0.004):
    """Adds a box by its extents to a model; textures are laid in world metres, so that neighbours do not show
    the same patch."""
    mesh = bevel_box(x1 - x0, y1 - y0, z1 - z0, bevel).with_uv_offset(x0 * 0.73 + z0 * 0.41,
                                                                      y0 * 0.37 + z0 * 0.59)
    model.add(material, mesh, translate((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2))


def quad(sx, sy, unit_uv=False, divisions=1):
    """Flat sheet in the XY plane facing +Z, centred; the image's top is at +Y."""
    n = divisions + 1
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, n), np.linspace(0.5, -0.5, n))
    p = np.stack([x * sx, y * sy, np.zeros_like(x)], -1)
    uv = np.stack([x + 0.5, 0.5 - y], -1) if unit_uv else np.stack([x * sx, -y * sy], -1)
    return surface(p, uv, normals=np.broadcast_to((0.0, 0.0, 1.0), p.shape))


def surface(points, uvs, normals=None, closed_i=False, swap=False):
    """Grid of points [i][j]; the front is cross(d/di, d/dj), or the other side with `swap`."""
    ni, nj = points.shape[:2]
    if normals is None:
        di, dj = np.gradient(points, axis=0), np.gradient(points, axis=1)
        if closed_i:
            di[0] = di[-1] = points[1] - points[-2]
        normals = np.cross(di, dj)
        normals = -normals if swap else normals
        normals = normals / np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-12)
    i, j = np.meshgrid(np.arange(ni - 1), np.arange(nj - 1), indexing="ij")
    a = (i * nj + j).ravel()
    b, c, d = a + nj, a + nj + 1, a + 1
    triangles = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], 1).reshape(-1, 3)
    if swap:
        triangles = triangles[:, ::-1]
    flat = points.reshape(-1, 3)
    t = flat[triangles]
    area = np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1)
    return Mesh(flat, normals.reshape(-1, 3), uvs.reshape(-1, 2), triangles[area > 1e-10])


def lathe(profile, segments=24, crease_deg=50.0, unit_uv=False, squash=None):
    """Turns a profile [(radius, y)...] about Y. Where it runs upwards the outside is away from the axis; give
    a closed body from the bottom's centre around to the top's. Corners sharper than the crease stay hard."""
    pts = np.asarray(profile, float)
    d = np.diff(pts, axis=0)
    seg_len = np.maximum(np.linalg.norm(d, axis=1), 1e-12)
    seg_n = np.stack([d[:, 1], -d[:, 0]], -1) / seg_len[:, None]
    arc = np.concatenate([[0], np.cumsum(seg_len)])
    theta = np.linspace(0, 2 * math.pi, segments + 1)
    # The circumference in UV is a round number of tiles of 1 m or a fraction, so that the seam is invisible.
    circumference = max(2 * math.pi * pts[:, 0].max(), 1e-3)
    turns = 1.0 if unit_uv else (max(1, round(circumference)) if circumference > 0.7 else circumference)
    pieces, start = [], 0
    for k in range(1, len(pts)):
        last = k == len(pts) - 1
        if not last and np.dot(seg_n[k - 1], seg_n[k]) > math.cos(math.radians(crease_deg)):
            continue
        run, n2 = pts[start:k + 1], np.zeros((k + 1 - start, 2))
        n2[:-1] += seg_n[start:k]
        n2[1:] += seg_n[start:k]
        n2 /= np.linalg.norm(n2, axis=1, keepdims=True)
        v = arc[start:k + 1] / (arc[-1] if unit_uv else 1.0)
        c, s = np.cos(theta)[:, None], np.sin(theta)[:, None]
        p = np.stack([run[:, 0] * c, np.broadcast_to(run[:, 1], (segments + 1, len(run))), run[:, 0] * -s],
                     -1)
        n = np.stack([n2[:, 0] * c, np.broadcast_to(n2[:, 1], (segments + 1, len(run))), n2[:, 0] * -s], -1)
        uv = np.stack(np.broadcast_arrays((theta / (2 * math.pi) * turns)[:, None],
                                          1.0 - v if unit_uv else -v),
                      -1)
        pieces.append(surface(p, uv, normals=n))
        start = k
    mesh = merge(pieces)
    if squash is not None:
        mesh = mesh.at(np.diag([squash[0], squash[1], squash[2], 1.0]))
    return mesh


def sphere(radius, segments=24, rings=12, unit_uv=False):
    a = np.linspace(-math.pi / 2, math.pi / 2, rings + 1)
    profile = np.stack([np.cos(a) * radius, np.sin(a) * radius], -1)
    profile[0, 0] = profile[-1, 0] = 0.0
    return lathe(profile, segments, 180, unit_uv)


def cylinder(radius, height, segments=20, bevel=0.003, bottom=True):
    """Standing on y = 0, with bevelled rims."""
    b = min(bevel, radius * 0.4, height * 0.4)
    profile = [(0, 0)] if bottom else []
    profile += [(radius - b, 0), (radius, b), (radius, height - b), (radius - b, height), (0, height)]
    return lathe(profile, segments, 60)


def torus(major, minor, segments=48, sides=20):
    """Ring about the Y axis."""
    u = np.linspace(0, 2 * math.pi, segments + 1)[:, None]
    v = np.linspace(0, 2 * math.pi, sides + 1)[None, :]
    ring = major + minor * np.cos(v)
    p = np.stack([ring * np.cos(u), np.broadcast_to(minor * np.sin(v), (segments + 1, sides + 1)),
                  -ring * np.sin(u)], -1)
    n = np.stack(np.broadcast_arrays(np.cos(v) * np.cos(u), np.sin(v), -np.cos(v) * np.sin(u)), -1)
    uv = np.stack(np.broadcast_arrays(u * round(max(1, major * 6)) / (2 * math.pi), -v * minor), -1)
    return surface(p, uv, normals=n)


def sweep(path, radius, sides=8, closed=False, caps=True):
    """Round tube along a polyline of points; `radius` is a number or one per point. Frames are carried along
    by the least rotation, so the tube does not twist."""
    path = np.asarray(path, float)
    count = len(path)
    radius = np.broadcast_to(np.asarray(radius, float), (count,))
    if closed:
        path, radius = np.vstack([path, path[:1]]), np.append(radius, radius[0])
    tangent = np.gradient(path, axis=0)
    if closed:
        tangent[0] = tangent[-1] = path[1] - path[-2]
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    helper = np.array([0.0, 1.0, 0.0]) if abs(tangent[0][1]) < 0.9 else np.array([1.0, 0.0, 0.0])
    normal = np.cross(helper, tangent[0])
    frames = []
    for t in tangent:
        normal = normal - t * np.dot(normal, t)
        normal = normal / np.linalg.norm(normal)
        frames.append((normal, np.cross(t, normal)))
    angle = np.linspace(0, 2 * math.pi, sides + 1)
    n = np.stack([np.outer(np.cos(angle), f[0]) + np.outer(np.sin(angle), f[1]) for f in frames])
    p = path[:, None, :] + n * radius[:, None, None]
    arc = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    uv = np.stack(np.broadcast_arrays((angle * radius.max())[None, :], arc[:, None]), -1)
    pieces = [surface(p, uv, normals=n, swap=True)]
    if caps and not closed:
        for end, sign in ((0, -1), (-1, 1)):
            if radius[end] <= 1e-6:
                continue
            ring = p[end, :-1]
            tri = [(0, k, k + 1) for k in range(1, sides - 1)]
            cap = Mesh(ring, np.broadcast_to(tangent[end] * sign, ring.shape), uv[end, :-1], tri)
            facing = np.dot(np.cross(ring[1] - ring[0], ring[2] - ring[0]), tangent[end] * sign)
            if facing < 0:
                cap.triangles = cap.triangles[:, ::-1]
            pieces.append(cap)
    return merge(pieces)


def rod(start, end, radius, sides=8):
    return sweep([start, end], radius, sides)


def bar(start, end, width, height, bevel=0.003):
    """Bevelled rectangular bar between two points."""
    length = float(np.linalg.norm(np.subtract(end, start)))
    return bevel_box(length, height, width, bevel).at(align_x(start, end))


def prism(polygon, height, bevel=0.003):
    """Convex polygon [(x, z)...], counter-clockwise seen from above, raised from y = 0; bevelled top rim."""
    poly = np.asarray(polygon, float)
    centre = poly.mean(axis=0)
    inner = poly + (centre - poly) / np.linalg.norm(centre - poly, axis=1, keepdims=True) * bevel
    count, positions, normals, uvs, triangles = len(poly), [], [], [], []
    for k in range(count):
        a, b = poly[k], poly[(k + 1) % count]
        side = np.array([-(b - a)[1], 0.0, (b - a)[0]])
        side /= np.linalg.norm(side)
        if np.dot(side[[0, 2]], (a + b) / 2 - centre) < 0:
            side = -side
        base, run = len(positions), float(np.linalg.norm(b - a))
        for q, y in ((a, 0.0), (b, 0.0), (b, height - bevel), (a, height - bevel)):
            positions.append((q[0], y, q[1]))
            normals.append(side)
            uvs.append((0.0 if q is a else run, -y))
        for q in (inner[(k + 1) % count], inner[k]):
            positions.append((q[0], height, q[1]))
            normals.append((0, 1, 0))
            uvs.append((q[0], q[1]))
        triangles += [(base, base + 1, base + 2), (base, base + 2, base + 3), (base + 3, base + 2, base + 4),
                      (base + 3, base + 4, base + 5)]
    base = len(positions)
    for y, n, ring in ((height, 1, inner), (0.0, -1, poly)):
        start = len(positions)
        for q in ring:
            positions.append((q[0], y, q[1]))
            normals.append((0, n, 0))
            uvs.append((q[0], q[1]))
        triangles += [(start, start + k, start + k + 1) for k in range(1, count - 1)]
    return oriented(Mesh(positions, normals, uvs, triangles))


def oriented(mesh):
    """Turns every triangle to the side its vertex normals look to."""
    t, p = mesh.triangles, mesh.positions
    face = np.cross(p[t[:, 1]] - p[t[:, 0]], p[t[:, 2]] - p[t[:, 0]])
    wrong = np.sum(face * mesh.normals[t].sum(axis=1), axis=1) < 0
    t[wrong] = t[wrong][:, ::-1]
    return mesh
