"""Lights as the tool's document knows them, and how each is written to glTF: KHR_lights_punctual for points,
spots and suns, EXT_lights_area for rectangles and disks, and node extras under `kilolux` for what those
extensions lack. Tubes, which no extension has, are points to other readers. Units and the emitters'
radiances follow the renderer's light model: Lambert sources of constant radiance, lumens of a spot are what
leaves its cone."""
import math
from dataclasses import dataclass
from typing import Optional

import numpy as np

from .material import kelvin


@dataclass(frozen=True)
class Light:
    name: str
    type: str  # sphere, spot, tube, rect, disk, directional
    intensity: float
    unit: str  # lumen, candela, lux, nit
    color: tuple = (1.0, 1.0, 1.0)
    temperature_k: Optional[float] = None
    range_m: Optional[float] = None
    radius_m: float = 0.0
    length_m: float = 0.0
    width_m: float = 1.0   # disk: the diameter
    height_m: float = 1.0
    inner_rad: float = 0.0
    outer_rad: float = math.pi / 4
    angular_diameter_rad: float = 0.0
    door_angle_rad: Optional[float] = None
    door_length_m: Optional[float] = None
    ray_end_bias_m: float = 0.0
    # Further properties by their names in extras.md, and files that go into the scene's own: the text of a profile,
    # pictures (h, w, 3) by property.
    shaping: tuple = ()       # pairs
    profile: Optional[str] = None
    pictures: tuple = ()      # pairs of a property and the pixels' bytes, already encoded

    def rgb(self):
        """Tint times temperature, what one unit of intensity is multiplied by."""
        tint = np.array(self.color, float)
        return tint if self.temperature_k is None else tint * kelvin(self.temperature_k)

    def area_m2(self):
        """The area that the radiance is defined by: I = radiance x area on the axis."""
        r = self.radius_m
        return {"sphere": math.pi * r * r, "spot": math.pi * r * r,
                "tube": 2 * r * self.length_m + math.pi * r * r, "rect": self.width_m * self.height_m,
                "disk": math.pi * self.width_m ** 2 / 4}[self.type]

    def candela(self):
        """On-axis intensity before the tint (directional: lux)."""
        if self.unit in ("candela", "lux"):
            return self.intensity
        if self.unit == "nit":
            return self.intensity * self.area_m2()
        if self.type == "sphere":
            return self.intensity / (4 * math.pi)
        if self.type == "spot":
            ci, co = math.cos(self.inner_rad), math.cos(self.outer_rad)
            return self.intensity / (2 * math.pi * ((1 - ci) + (ci - co) / 3))
        return self.luminance_nit() * self.area_m2()

    def luminance_nit(self):
        """Radiance of the source, which its visible face should show, before the tint."""
        if self.unit == "nit":
            return self.intensity
        if self.unit == "lumen" and self.type == "tube":
            r = self.radius_m
            return self.intensity / (math.pi * (2 * math.pi * r * self.length_m + 4 * math.pi * r * r))
        if self.unit == "lumen" and self.type in ("rect", "disk"):
            return self.intensity / (math.pi * self.area_m2())
        return self.candela() / self.area_m2()

    def face_nit(self, share=1.0):
        """Emission of a fixture's face, coloured."""
        return tuple(float(v) for v in self.rgb() * self.luminance_nit() * share)

    def extras(self):
        """The `kilolux` object of the node's extras."""
        out = {}
        if self.type == "tube":
            out.update(type="tube", lengthM=self.length_m)
        if self.type in ("tube", "sphere", "spot") and self.radius_m > 0:
            out["radiusM"] = self.radius_m
        if self.type in ("rect", "disk") and self.range_m is not None:
            out["rangeM"] = self.range_m
        out.update(intensity=self.intensity,
                   unit={"lumen": "lm", "candela": "cd"}.get(self.unit, self.unit))
        optional = {"temperatureK": self.temperature_k, "barnDoorAngleRad": self.door_angle_rad,
                    "barnDoorLengthM": self.door_length_m,
                    "angularDiameterRad": self.angular_diameter_rad or None,
                    "rayEndBiasM": self.ray_end_bias_m or None}
        out.update({k: v for k, v in optional.items() if v is not None})
        out.update(self.shaping)
        return {k: round(v, 6) if isinstance(v, float) else v for k, v in out.items()}

    def punctual(self):
        """KHR_lights_punctual definition, or None."""
        if self.type in ("rect", "disk"):
            return None
        out = {"name": self.name, "type": {"sphere": "point", "tube": "point"}.get(self.type, self.type),
               "color": [round(c, 6) for c in self.color], "intensity": round(self.candela(), 4)}
        if self.range_m is not None and self.type != "directional":
            out["range"] = self.range_m
        if self.type == "spot":
            out["spot"] = {"innerConeAngle": round(self.inner_rad, 6),
                           "outerConeAngle": round(self.outer_rad, 6)}
        return out

    def area(self):
        """EXT_lights_area definition, or None."""
        if self.type not in ("rect", "disk"):
            return None
        out = {"name": self.name, "type": self.type, "color": [round(c, 6) for c in self.color],
               "intensity": round(self.luminance_nit(), 4)}
        out["size"] = round(self.height_m if self.type == "rect" else self.width_m, 6)
        if self.type == "rect":
            out["rect"] = {"aspect": round(self.width_m / self.height_m, 6)}
        return out
