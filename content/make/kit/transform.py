"""4x4 matrices (column vectors, metres, radians) for placing parts and nodes."""
import math

import numpy as np


def identity():
    return np.eye(4)


def translate(x, y, z):
    m = np.eye(4)
    m[:3, 3] = (x, y, z)
    return m


def scale(x, y=None, z=None):
    y = x if y is None else y
    z = x if z is None else z
    return np.diag([x, y, z, 1.0])


def rotate(axis, angle_rad):
    """Right-handed rotation about an axis through the origin (Rodrigues)."""
    a = np.asarray(axis, float)
    a = a / np.linalg.norm(a)
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    k = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    m = np.eye(4)
    m[:3, :3] = np.eye(3) * c + s * k + (1 - c) * np.outer(a, a)
    return m


def rotate_x(angle_rad):
    return rotate((1, 0, 0), angle_rad)


def rotate_y(angle_rad):
    return rotate((0, 1, 0), angle_rad)


def rotate_z(angle_rad):
    return rotate((0, 0, 1), angle_rad)


def look_at(eye, target, up=(0, 1, 0)):
    """World from local of something at `eye` that looks down its local -Z at `target` (camera, light)."""
    eye = np.asarray(eye, float)
    back = eye - np.asarray(target, float)
    back /= np.linalg.norm(back)
    right = np.cross(up, back)
    if np.linalg.norm(right) < 1e-6:
        right = np.array([1.0, 0.0, 0.0])
    right /= np.linalg.norm(right)
    m = np.eye(4)
    m[:3, 0], m[:3, 1], m[:3, 2], m[:3, 3] = right, np.cross(back, right), back, eye
    return m


def align_x(start, end):
    """Places a part built along local X, centred, between two points; local Y is kept as upright as it
    can."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    x = end - start
    x /= np.linalg.norm(x)
    up = np.array([0.0, 1.0, 0.0]) if abs(x[1]) < 0.95 else np.array([0.0, 0.0, 1.0])
    z = np.cross(x, up)
    z /= np.linalg.norm(z)
    m = np.eye(4)
    m[:3, 0], m[:3, 1], m[:3, 2], m[:3, 3] = x, np.cross(z, x), z, (start + end) / 2
    return m


def apply(m, point):
    return m[:3, :3] @ np.asarray(point, float) + m[:3, 3]


def to_trs(m):
    """Translation, unit quaternion (x, y, z, w) and scale of a matrix without shear; mirrors scale x."""
    t = m[:3, 3]
    s = np.linalg.norm(m[:3, :3], axis=0)
    if np.linalg.det(m[:3, :3]) < 0:
        s[0] = -s[0]
    r = m[:3, :3] / s
    w = math.sqrt(max(0.0, 1 + r[0, 0] + r[1, 1] + r[2, 2])) / 2
    x = math.sqrt(max(0.0, 1 + r[0, 0] - r[1, 1] - r[2, 2])) / 2
    y = math.sqrt(max(0.0, 1 - r[0, 0] + r[1, 1] - r[2, 2])) / 2
    z = math.sqrt(max(0.0, 1 - r[0, 0] - r[1, 1] + r[2, 2])) / 2
    big = int(np.argmax([w, x, y, z]))
    # The other three follow from the largest, which keeps their signs and their precision.
    if big == 0:
        x, y, z = (r[2, 1] - r[1, 2]) / (4 * w), (r[0, 2] - r[2, 0]) / (4 * w), (r[1, 0] - r[0, 1]) / (4 * w)
    elif big == 1:
        w, y, z = (r[2, 1] - r[1, 2]) / (4 * x), (r[1, 0] + r[0, 1]) / (4 * x), (r[0, 2] + r[2, 0]) / (4 * x)
    elif big == 2:
        w, x, z = (r[0, 2] - r[2, 0]) / (4 * y), (r[1, 0] + r[0, 1]) / (4 * y), (r[2, 1] + r[1, 2]) / (4 * y)
    else:
        w, x, y = (r[1, 0] - r[0, 1]) / (4 * z), (r[0, 2] + r[2, 0]) / (4 * z), (r[2, 1] + r[1, 2]) / (4 * z)
    q = np.array([x, y, z, w])
    return t, q / np.linalg.norm(q), s
