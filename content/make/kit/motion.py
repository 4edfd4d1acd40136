"""Keys for glTF animations: closed paths through points, turns, steps (glTF 2.0, sections 3.11 and Appendix
C)."""
import numpy as np

from .gltf import Channel
from .transform import to_trs


def smooth_keys(times_s, points, closed=True):
    """Cubic keys whose tangents are the slopes between neighbours (Catmull-Rom); a closed path's last point
    is its first."""
    t, p = np.asarray(times_s, float), np.asarray(points, float)
    slope = np.zeros_like(p)
    slope[1:-1] = (p[2:] - p[:-2]) / (t[2:] - t[:-2])[:, None]
    if closed:
        slope[0] = slope[-1] = (p[1] - p[-2]) / ((t[1] - t[0]) + (t[-1] - t[-2]))
    return [(s, v, s) for s, v in zip(slope, p)]


def path(node, times_s, points, interpolation="LINEAR"):
    """Translation through points."""
    values = smooth_keys(times_s, points) if interpolation == "CUBICSPLINE" else points
    return Channel(node, "translation", times_s, values, interpolation)


def turn(node, times_s, matrices, interpolation="LINEAR"):
    """Rotation through those of matrices; each key takes the sign nearest to the one before it."""
    quaternions = []
    for m in matrices:
        q = to_trs(m)[1]
        quaternions.append(-q if quaternions and np.dot(q, quaternions[-1]) < 0 else q)
    if interpolation == "CUBICSPLINE":
        quaternions = smooth_keys(times_s, quaternions, closed=False)
    return Channel(node, "rotation", times_s, quaternions, interpolation)
