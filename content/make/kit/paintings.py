"""Abstract pictures, each from its own small program: linear colour maps of (height, width, 3) and heights of
the paint for a normal map. None copies an existing work."""
import math

import numpy as np

from .noise import fbm, mix, rng, smoothstep


def _grid(size):
    x = (np.arange(size) + 0.5) / size
    return np.meshgrid(x, x)


def _canvas(size, seed):
    x, y = _grid(size)
    weave = 0.5 + 0.25 * (np.sin(x * math.pi * 2 * 128) + np.sin(y * math.pi * 2 * 128))
    return weave * 0.6 + 0.4 * fbm(size, 40, 2, seed)


def fields(size=512, seed=1):
    """Stacked soft fields of colour on a warm ground."""
    x, y = _grid(size)
    wobble = 0.012 * fbm(size, 6, 4, seed)
    cloud = fbm(size, (5, 8), 5, seed + 1)
    picture = np.broadcast_to((0.30, 0.045, 0.025), (size, size, 3)) * (1 + 0.15 * cloud)[..., None]
    for k, (top, bottom, color) in enumerate(((0.07, 0.43, (0.80, 0.33, 0.06)),
                                              (0.47, 0.62, (0.05, 0.05, 0.12)),
                                              (0.66, 0.93, (0.50, 0.08, 0.05)))):
        edge = 0.018
        mask = (smoothstep(0.07 - edge, 0.07 + edge, x + wobble) *
                smoothstep(0.93 + edge, 0.93 - edge, x + wobble) *
                smoothstep(top - edge, top + edge, y + wobble) *
                smoothstep(bottom + edge, bottom - edge, y - wobble))
        brush = fbm(size, (3, 24), 4, seed + 10 + k)
        picture = mix(picture, np.asarray(color) * (1 + 0.22 * brush[..., None] + 0.15 * cloud[..., None]),
                      mask * 0.94)
    return np.clip(picture, 0.01, 0.9), _canvas(size, seed)


def circles(size=512, seed=2, aspect=1.0):
    """Overlapping discs and arcs that change colour where they cross, on a pale ground."""
    x, y = _grid(size)
    x = x * aspect
    r = rng(seed)
    grain = fbm(size, 30, 3, seed)
    picture = np.broadcast_to((0.74, 0.70, 0.60), (size, size, 3)) * (1 + 0.05 * grain[..., None])
    palette = [(0.03, 0.12, 0.32), (0.72, 0.12, 0.05), (0.85, 0.52, 0.06), (0.04, 0.28, 0.27),
               (0.06, 0.05, 0.06),
               (0.60, 0.25, 0.30)]
    for k in range(13):
        cx, cy, radius = r.uniform(0.1, 0.9) * aspect, r.uniform(0.1, 0.9), r.uniform(0.05, 0.26)
        d = np.hypot(x - cx, y - cy)
        mask = smoothstep(radius + 0.002, radius - 0.002, d)
        if k % 3 == 1:
            mask = mask * smoothstep(radius * 0.72 - 0.002, radius * 0.72 + 0.002, d)
        if k % 4 == 2:
            turn = r.uniform(0, 6.28)
            mask = mask * smoothstep(-0.002, 0.002, (x - cx) * math.cos(turn) + (y - cy) * math.sin(turn))
        color = np.asarray(palette[k % len(palette)])
        picture = mix(picture, mix(color * np.ones(3), picture * color * 1.6, np.full((size, size), 0.35)),
                      mask)
    for _ in range(7):
        turn, off = r.uniform(0, math.pi), r.uniform(0.2, 0.8)
        d = np.abs((x - 0.5 * aspect) * math.cos(turn) + (y - 0.5) * math.sin(turn) + off - 0.5)
        picture = mix(picture, (0.02, 0.02, 0.025), smoothstep(0.004, 0.0025, d) * (grain > -0.5))
    return np.clip(picture, 0.01, 0.9), _canvas(size, seed)


def marble(size=512, seed=3):
    """Poured paint: folded noise in ink blue, sea green, bone and gold."""
    a, b = fbm(size, 3, 4, seed), fbm(size, 3, 4, seed + 1)
    x, y = _grid(size)
    # The noise is read through itself twice, which folds it like liquid.
    def read(field, u, v):
        i = np.floor(np.mod(v, 1) * size).astype(int) % size
        j = np.floor(np.mod(u, 1) * size).astype(int) % size
        return field[i, j]
    field = fbm(size, 4, 6, seed + 2)
    a2 = read(a, x + 0.22 * a, y + 0.22 * b)
    b2 = read(b, x + 0.3 * b, y + 0.2 * a2)
    f = read(field, x + 0.35 * a2, y + 0.35 * b2)
    bands = 0.5 + 0.5 * np.sin(9 * f + 4 * a2)
    picture = mix((0.015, 0.05, 0.13), (0.06, 0.30, 0.32), bands)
    picture = mix(picture, (0.80, 0.74, 0.62), smoothstep(0.62, 0.95, 0.5 + 0.5 * np.sin(14 * f - 3 * b2)))
    picture = mix(picture, (0.72, 0.42, 0.10), smoothstep(0.035, 0.0, np.abs(np.sin(7 * f + 2 * b2))))
    return np.clip(picture, 0.01, 0.9), 1.5 * bands + 0.3 * _canvas(size, seed)


def strokes(size=512, seed=4, count=1500):
    """Short thick brush strokes that follow a flow, from a dark foot to a burning sky."""
    r = rng(seed)
    flow = fbm(size, 3, 3, seed)
    x, y = _grid(size)
    picture = np.broadcast_to((0.05, 0.06, 0.09), (size, size, 3)).copy()
    height = np.zeros((size, size))
    for k in range(count):
        cx, cy = r.uniform(0, 1), r.uniform(0, 1)
        f = flow[min(int(cy * size), size - 1), min(int(cx * size), size - 1)]
        turn = 2.2 * f + 0.25
        long, wide = r.uniform(0.02, 0.06), r.uniform(0.004, 0.009)
        lo_x, hi_x = int(max(0, (cx - 0.07) * size)), int(min(size, (cx + 0.07) * size))
        lo_y, hi_y = int(max(0, (cy - 0.07) * size)), int(min(size, (cy + 0.07) * size))
        px, py = x[lo_y:hi_y, lo_x:hi_x] - cx, y[lo_y:hi_y, lo_x:hi_x] - cy
        u, v = px * math.cos(turn) + py * math.sin(turn), -px * math.sin(turn) + py * math.cos(turn)
        v = v + 6 * u * u * r.uniform(-1, 1)
        mask = smoothstep(1.0, 0.75, np.maximum(np.abs(u) / long, np.abs(v) / wide))
        tone = cy + 0.35 * f + r.uniform(-0.12, 0.12)
        sky = np.array([0.85, 0.48, 0.10]) if tone < 0.35 else np.array([0.62, 0.16, 0.07])
        sky = np.array([0.09, 0.16, 0.36]) if tone < 0.12 else sky
        color = sky if tone < 0.55 else np.array([0.06, 0.13, 0.12])
        color = np.array([0.02, 0.035, 0.06]) if tone > 0.85 else color
        color = np.clip(color * r.uniform(0.7, 1.35), 0, 0.85)
        bristle = 0.5 + 0.5 * np.sin(v / wide * 9 + r.uniform(0, 6))
        part = picture[lo_y:hi_y, lo_x:hi_x]
        picture[lo_y:hi_y, lo_x:hi_x] = mix(part, color * (0.85 + 0.15 * bristle[..., None]), mask)
        h = height[lo_y:hi_y, lo_x:hi_x]
        height[lo_y:hi_y, lo_x:hi_x] = mix(h, 1.0 + 0.8 * bristle, mask) if mask.size else h
    return np.clip(picture, 0.01, 0.9), height


def shards(size=512, seed=5, count=34):
    """Hard-edged facets by repeated cuts, graded from cold to warm, with thin bright seams."""
    x, y = _grid(size)
    r = rng(seed)
    code, seam = np.zeros((size, size), np.int64), np.zeros((size, size))
    for k in range(9):
        turn, off = r.uniform(0, math.pi), r.uniform(-0.38, 0.38)
        d = (x - 0.5) * math.cos(turn) + (y - 0.5) * math.sin(turn) - off
        code = code * 2 + (d > 0)
        seam = np.maximum(seam, smoothstep(0.0045, 0.002, np.abs(d)))
    value = ((code * 2654435761) % 4294967296) / 4294967296.0
    cold, warm = np.array([0.03, 0.09, 0.20]), np.array([0.78, 0.46, 0.20])
    pale = np.array([0.72, 0.70, 0.66])
    lean = np.clip(0.25 + 0.9 * (x - y) + 0.7 * (value - 0.5), 0, 1)
    picture = mix(cold, warm, lean)
    picture = mix(picture, pale, (value > 0.8).astype(float) * 0.8)
    picture = picture * (0.82 + 0.3 * ((value * 7) % 1))[..., None]
    picture = mix(picture, (0.80, 0.76, 0.68), seam * 0.8)
    return np.clip(picture * (1 + 0.05 * fbm(size, 30, 3, seed)[..., None]), 0.01, 0.9), _canvas(size, seed)


def waves(size=512, seed=6):
    """For the video wall: slow luminous waves in blue and rose; meant as emission."""
    x, y = _grid(size)
    base = fbm(size, 3, 3, seed)
    total = np.zeros((size, size, 3))
    for k, color in enumerate(((0.05, 0.22, 0.85), (0.08, 0.55, 0.75), (0.65, 0.16, 0.42), (0.9, 0.5, 0.35))):
        line = 0.25 + 0.17 * k + 0.10 * np.sin(2 * np.pi * (x * (1 + k % 2) + 0.21 * k)) + 0.12 * base
        d = y - line
        glow = np.exp(-np.maximum(d, 0) * (7 + 2 * k)) * smoothstep(-0.02, 0.015, d)
        fine = 0.75 + 0.25 * np.sin(160 * d + 20 * base)
        total += (glow * fine)[..., None] * np.asarray(color)
    return np.clip(total * 0.8 + np.array([0.004, 0.012, 0.035]), 0, 1)
