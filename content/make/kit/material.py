"""What a surface is made of, and the colour of hot things. Colours are linear Rec. 709."""
from dataclasses import dataclass
from typing import Optional

import numpy as np


@dataclass(eq=False)
class Material:
    name: str
    color: tuple = (0.8, 0.8, 0.8)
    roughness: float = 0.6
    metallic: float = 0.0
    color_map: Optional[np.ndarray] = None      # linear (h, w, 3), or (h, w, 4) with alpha
    roughness_map: Optional[np.ndarray] = None  # (h, w), absolute values
    metallic_map: Optional[np.ndarray] = None   # (h, w), absolute values
    normal_map: Optional[np.ndarray] = None     # (h, w, 3) unit vectors, see noise.normals_from_height
    emission_nit: tuple = (0.0, 0.0, 0.0)
    emission_map: Optional[np.ndarray] = None   # linear (h, w, 3), multiplied by emission_nit
    tile_m: float = 1.0                         # metres that one repeat of the textures covers
    alpha: float = 1.0
    alpha_mode: str = "OPAQUE"
    double_sided: bool = False


def luminance(rgb):
    return float(np.dot(rgb, (0.2126, 0.7152, 0.0722)))


def kelvin(temperature_k):
    """Linear colour of a black body, luminance 1, relative to 6500 K = white (Planckian locus as a cubic by
    Kim et al., US patent 7024034; channels outside the gamut are cut at 0)."""
    def rgb(t):
        if t < 4000:
            x = -0.2661239e9 / t ** 3 - 0.2343589e6 / t ** 2 + 0.8776956e3 / t + 0.179910
        else:
            x = -3.0258469e9 / t ** 3 + 2.1070379e6 / t ** 2 + 0.2226347e3 / t + 0.240390
        if t < 2222:
            y = -1.1063814 * x ** 3 - 1.34811020 * x ** 2 + 2.18555832 * x - 0.20219683
        elif t < 4000:
            y = -0.9549476 * x ** 3 - 1.37418593 * x ** 2 + 2.09137015 * x - 0.16748867
        else:
            y = 3.0817580 * x ** 3 - 5.87338670 * x ** 2 + 3.75112997 * x - 0.37001483
        xyz = np.array([x / y, 1.0, (1 - x - y) / y])
        m = np.array([[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560],
                      [0.0556434, -0.2040259, 1.0572252]])
        return np.maximum(m @ xyz, 0.0)
    color = rgb(temperature_k) / rgb(6500.0)
    return color / luminance(color)
