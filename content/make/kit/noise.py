"""Tileable noise on square pictures. Every function returns floats of shape (size, size) that repeat."""
import numpy as np


def rng(seed):
    return np.random.Generator(np.random.PCG64(seed))


def perlin(size, cells, seed):
    """Gradient noise with `cells` lattice cells a side, about -1..1 (Perlin 2002)."""
    cells_x, cells_y = cells if isinstance(cells, tuple) else (cells, cells)
    angle = rng(seed).random((cells_y, cells_x)) * 2 * np.pi
    gx, gy = np.cos(angle), np.sin(angle)
    x = (np.arange(size) + 0.5) / size * cells_x
    y = (np.arange(size) + 0.5) / size * cells_y
    x, y = np.meshgrid(x, y)
    ix, iy = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = x - ix, y - iy

    def corner(dx, dy):
        a, b = (iy + dy) % cells_y, (ix + dx) % cells_x
        return gx[a, b] * (fx - dx) + gy[a, b] * (fy - dy)

    sx, sy = fx ** 3 * (fx * (fx * 6 - 15) + 10), fy ** 3 * (fy * (fy * 6 - 15) + 10)
    top = corner(0, 0) * (1 - sx) + corner(1, 0) * sx
    bottom = corner(0, 1) * (1 - sx) + corner(1, 1) * sx
    return (top * (1 - sy) + bottom * sy) * 1.5


def fbm(size, cells, octaves, seed, gain=0.5):
    total, amplitude, norm = np.zeros((size, size)), 1.0, 0.0
    cx, cy = cells if isinstance(cells, tuple) else (cells, cells)
    for k in range(octaves):
        if max(cx, cy) * 2 > size:
            break
        total += amplitude * perlin(size, (cx, cy), seed + 101 * k)
        norm += amplitude
        amplitude *= gain
        cx, cy = cx * 2, cy * 2
    return total / norm


def worley(size, cells, seed):
    """Distances to the nearest and second nearest of jittered points, in cells (Worley 1996), and the
    nearest point's own random number."""
    r = rng(seed)
    px, py, value = r.random((cells, cells)), r.random((cells, cells)), r.random((cells, cells))
    x = (np.arange(size) + 0.5) / size * cells
    x, y = np.meshgrid(x, x)
    ix, iy = np.floor(x).astype(int), np.floor(y).astype(int)
    first, second = np.full((size, size), 9.0), np.full((size, size), 9.0)
    own = np.zeros((size, size))
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            a, b = (iy + dy) % cells, (ix + dx) % cells
            d = np.hypot(ix + dx + px[a, b] - x, iy + dy + py[a, b] - y)
            nearer = d < first
            second = np.where(nearer, first, np.minimum(second, d))
            own = np.where(nearer, value[a, b], own)
            first = np.where(nearer, d, first)
    return first, second, own


def smoothstep(lo, hi, x):
    t = np.clip((x - lo) / (hi - lo), 0, 1)
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    """Blends two pictures or colours by a mask; colours widen the mask by one axis."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    if t.ndim == 2 and (a.shape[-1:] == (3,) or b.shape[-1:] == (3,)):
        t = t[..., None]
    return a * (1 - t) + b * t


def normals_from_height(height_m, size_m):
    """Tangent-space normal map of a repeating height field; `size_m` is the side the picture covers. Green
    points along -V (up the picture), as glTF has it. Rounded to 1/64, which the eye does not see and the
    compressor does."""
    n = height_m.shape[0]
    step = size_m / n
    dx = (np.roll(height_m, -1, 1) - np.roll(height_m, 1, 1)) / (2 * step)
    dy = (np.roll(height_m, -1, 0) - np.roll(height_m, 1, 0)) / (2 * step)
    v = np.stack([-dx, dy, np.ones_like(dx)], -1)
    v /= np.linalg.norm(v, axis=-1, keepdims=True)
    return np.round(v * 64) / 64
