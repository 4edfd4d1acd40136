"""A stroke font: letters as polylines in a box 0..1 (x right, y up), painted as masks or swept as neon
tubes."""
import math

import numpy as np


def _arc(cx, cy, rx, ry, a0, a1, n=9):
    t = np.radians(np.linspace(a0, a1, n))
    return [(cx + rx * math.cos(a), cy + ry * math.sin(a)) for a in t]


GLYPHS = {
    "A": [[(0, 0), (0.5, 1), (1, 0)], [(0.2, 0.38), (0.8, 0.38)]],
    "B": [[(0, 0), (0, 1), (0.55, 1)] + _arc(0.6, 0.76, 0.34, 0.24, 90, -90) + [(0, 0.52)],
          [(0.6, 0.52)] + _arc(0.64, 0.26, 0.36, 0.26, 90, -90) + [(0, 0)]],
    "C": [_arc(0.5, 0.5, 0.5, 0.5, 45, 315, 15)],
    "D": [[(0, 0), (0, 1), (0.45, 1)] + _arc(0.45, 0.5, 0.55, 0.5, 90, -90) + [(0, 0)]],
    "E": [[(1, 1), (0, 1), (0, 0), (1, 0)], [(0, 0.52), (0.8, 0.52)]],
    "F": [[(1, 1), (0, 1), (0, 0)], [(0, 0.52), (0.8, 0.52)]],
    "G": [_arc(0.5, 0.5, 0.5, 0.5, 45, 340, 15) + [(1, 0.45), (0.6, 0.45)]],
    "H": [[(0, 0), (0, 1)], [(1, 0), (1, 1)], [(0, 0.52), (1, 0.52)]],
    "I": [[(0.5, 0), (0.5, 1)]],
    "K": [[(0, 0), (0, 1)], [(1, 1), (0, 0.42)], [(0.3, 0.6), (1, 0)]],
    "L": [[(0, 1), (0, 0), (0.9, 0)]],
    "M": [[(0, 0), (0, 1), (0.5, 0.4), (1, 1), (1, 0)]],
    "N": [[(0, 0), (0, 1), (1, 0), (1, 1)]],
    "O": [_arc(0.5, 0.5, 0.5, 0.5, 0, 360, 21)],
    "P": [[(0, 0), (0, 1), (0.6, 1)] + _arc(0.62, 0.74, 0.36, 0.26, 90, -90) + [(0, 0.48)]],
    "R": [[(0, 0), (0, 1), (0.6, 1)] + _arc(0.62, 0.74, 0.36, 0.26, 90, -90) + [(0, 0.48)],
          [(0.45, 0.48), (1, 0)]],
    "S": [_arc(0.5, 0.75, 0.45, 0.25, 30, 270, 10) + _arc(0.5, 0.25, 0.47, 0.25, 90, -150, 10)],
    "T": [[(0, 1), (1, 1)], [(0.5, 1), (0.5, 0)]],
    "U": [[(0, 1), (0, 0.4)] + _arc(0.5, 0.4, 0.5, 0.4, 180, 360) + [(1, 1)]],
    "V": [[(0, 1), (0.5, 0), (1, 1)]],
    "W": [[(0, 1), (0.25, 0), (0.5, 0.65), (0.75, 0), (1, 1)]],
    "Y": [[(0, 1), (0.5, 0.5), (1, 1)], [(0.5, 0.5), (0.5, 0)]],
    "2": [_arc(0.5, 0.72, 0.46, 0.28, 160, -40, 9) + [(0, 0), (1, 0)]],
    "4": [[(0.75, 0), (0.75, 1), (0, 0.3), (1, 0.3)]],
    "8": [_arc(0.5, 0.75, 0.4, 0.25, 0, 360, 15), _arc(0.5, 0.25, 0.48, 0.26, 0, 360, 15)],
    "!": [[(0.5, 1), (0.5, 0.3)], [(0.5, 0.04), (0.5, 0)]],
    " ": [],
}


def strokes(word, width=0.62, gap=0.28, vertical=False):
    """Polylines of a word with letters 1 high and its extent (width, height); vertical words run
    downwards."""
    lines, x, y = [], 0.0, 0.0
    for letter in word:
        narrow = width * (0.35 if letter in "I!" and not vertical else 1.0)
        for line in GLYPHS[letter]:
            p = np.array(line, float)
            if letter in "I!":
                p[:, 0] = 0.5
            lines.append(p * (narrow, 1.0) + (x, y))
        if vertical:
            y -= 1.0 + gap
        else:
            x += narrow + gap
    if vertical:
        height = len(word) * (1 + gap) - gap
        return [p + (0, height - 1.0) for p in lines], (width, height)
    return lines, (x - gap, 1.0)


def mask(word, width_px, height_px, margin=0.14, weight=0.16, vertical=False):
    """Antialiased picture (height, width) of the word as large as fits, and the distance to its strokes in
    letter heights."""
    lines, (w, h) = strokes(word, vertical=vertical)
    scale = min(width_px * (1 - 2 * margin) / w, height_px * (1 - 2 * margin) / h)
    x0, y0 = (width_px - w * scale) / 2, (height_px - h * scale) / 2
    x, y = np.meshgrid(np.arange(width_px) + 0.5, np.arange(height_px) + 0.5)
    distance = np.full((height_px, width_px), 1e9)
    for line in lines:
        p = np.stack([x0 + line[:, 0] * scale, height_px - y0 - line[:, 1] * scale], -1)
        for a, b in zip(p[:-1], p[1:]):
            d = b - a
            t = np.clip(((x - a[0]) * d[0] + (y - a[1]) * d[1]) / max(np.dot(d, d), 1e-9), 0, 1)
            distance = np.minimum(distance, np.hypot(x - a[0] - t * d[0], y - a[1] - t * d[1]))
    return np.clip(0.5 + scale * weight / 2 - distance, 0, 1), distance / scale
