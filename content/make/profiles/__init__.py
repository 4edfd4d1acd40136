"""Photometric profiles (LM-63) of luminaires that nobody sells: every type of photometry, symmetry and revision
that readers must know, and the light of the presets. Candela follow from a formula and are scaled so that the
table's flux is the stated share of the lamps' lumens."""
import math


def lobe(width_deg, edge=2.0):
    """Half intensity at half of the beam's full width; larger edges fall more steeply."""
    half = 0.5 * width_deg
    return lambda off_deg: 0.5 ** ((abs(off_deg) / half) ** edge)


class Profile:
    """`shape(vertical_deg, horizontal_deg)` is relative intensity. `efficiency`: of the lamps' lumens."""

    def __init__(self, name, shape, vertical, horizontal, *, lumens=1000, lamps=1, efficiency=0.8, watts=10.0,
                 kind=1, size_m=(0.1, 0.1, 0.0), standard="IESNA:LM-63-2002", tilt=None, ballast=1.0,
                 multiplier=1.0, absolute=False):
        self.name, self.vertical, self.horizontal = name, vertical, horizontal
        self.lumens, self.lamps, self.efficiency, self.watts = lumens, lamps, efficiency, watts
        self.kind, self.size_m, self.standard, self.tilt = kind, size_m, standard, tilt
        self.ballast, self.multiplier, self.absolute = ballast, multiplier, absolute
        rows = [[max(0.0, shape(v, h)) for v in vertical] for h in horizontal]
        scale = efficiency * lumens * lamps / self.flux(rows)
        # What the file's own factors will be multiplied with is taken out; whole candela read better.
        factor = multiplier * ballast * (tilt[1][0] if tilt else 1.0)
        self.rows = [[round(value * scale / factor, 1) for value in row] for row in rows]

    def repeats(self):
        """How often the measured part stands in the whole sphere, horizontally and vertically."""
        first, last = self.horizontal[0], self.horizontal[-1]
        if self.kind == 1:
            return (2.0, 1.0) if first == 90 else (360.0 / last if last > 0 else 1.0, 1.0)
        return (1.0 if first < 0 else 2.0, 1.0 if self.vertical[0] < 0 else 2.0)

    def flux(self, rows):
        """Of intensity that is linear between two angles: trapezoids finer than the table."""
        def plane(row):
            total, steps = 0.0, 16
            for i in range(len(row) - 1):
                a, b = math.radians(self.vertical[i]), math.radians(self.vertical[i + 1])
                for s in range(steps):
                    t = (s + 0.5) / steps
                    angle = a + t * (b - a)
                    area = math.sin(angle) if self.kind == 1 else math.cos(angle)
                    total += (row[i] + t * (row[i + 1] - row[i])) * area * (b - a) / steps
            return total

        planes = [plane(row) for row in rows]
        if len(rows) == 1:
            return planes[0] * 2.0 * math.pi
        total = sum(math.radians(self.horizontal[i + 1] - self.horizontal[i]) * 0.5 * (planes[i] + planes[i + 1])
                    for i in range(len(rows) - 1))
        return total * self.repeats()[0] * self.repeats()[1]

    def text(self):
        lines = [self.standard,
                 "[TEST] made by content/make/profiles",
                 "[TESTLAB] none, a formula",
                 "[ISSUEDATE] 01-JAN-2026",
                 "[MANUFAC] Kilolux",
                 f"[LUMINAIRE] {self.name}"]
        if self.standard.endswith("2019"):
            lines.append("[FILEGENINFO] computed")
        if self.tilt:
            angles, factors = self.tilt
            lines += ["TILT=INCLUDE", "1", str(len(angles)), joined(angles), joined(factors)]
        else:
            lines.append("TILT=NONE")
        lumens = -1 if self.absolute else self.lumens
        generation = "1.00001" if self.standard.endswith("2019") else "1"
        lines.append(f"{self.lamps} {number(lumens)} {number(self.multiplier)} {len(self.vertical)} "
                     f"{len(self.horizontal)} {self.kind} 2 {joined(self.size_m)}")
        lines.append(f"{number(self.ballast)} {generation} {number(self.watts)}")
        for values in (self.vertical, self.horizontal, *self.rows):
            lines += wrapped(values)
        return "\r\n".join(lines) + "\r\n"


def number(value):
    return f"{value:.6g}"


def joined(values):
    return " ".join(number(v) for v in values)


def wrapped(values, width=100):
    """Lines within the 132 characters that old readers take."""
    lines, line = [], ""
    for value in values:
        word = number(value)
        if len(line) + len(word) + 1 > width:
            lines.append(line)
            line = ""
        line += (" " if line else "") + word
    return [*lines, line]


def steps(first, last, step):
    return [first + i * step for i in range(int(round((last - first) / step)) + 1)]


def profiles():
    """By file name."""
    ahead = steps(0, 90, 2.5)
    whole = steps(0, 180, 5)
    spot15, spot36, flood = lobe(15, 1.6), lobe(36), lobe(70, 3.0)

    def washer(v, h):
        """Up one wall, which stands at horizontal 0."""
        return lobe(60, 2.5)(v - 35 * math.cos(math.radians(h))) * (0.35 + 0.65 * max(0.0, math.cos(math.radians(h))))

    def batwing(v, h):
        across = math.sin(math.radians(h)) ** 2
        return (1.0 - across) * max(0.0, math.cos(math.radians(v))) + across * (
            lobe(50)(v - 35) + 0.45 * lobe(40)(v))

    def street(v, h):
        """Along the street, which runs across 90 degrees, and to its front side."""
        along = abs(math.cos(math.radians(h)))
        front = 0.55 + 0.45 * math.sin(math.radians(h))
        return lobe(40)(v - (30 + 35 * along)) * (0.3 + 0.7 * along) * front * (1.0 if v <= 85 else 0.0)

    def globe(v, _):
        return 0.7 + 0.3 * math.cos(math.radians(v)) if v < 165 else 0.25

    def floodlight(v, h):
        return lobe(50, 2.4)(h - 12) * lobe(90, 2.6)(v)

    def headlamp(v, h):
        """Vertical angles go to the sides, horizontal ones up and down: flat and wide, cut off above."""
        return lobe(44)(v) * lobe(9, 1.4)(h + 2.0) * (1.0 if h <= 1 else 0.08)

    def ring(v, _):
        return lobe(36)(v - 62) + 0.08 * max(0.0, math.cos(math.radians(v)))

    return {
        "downlight_36.ies": Profile("Downlight, 36 degrees", lambda v, h: spot36(v), ahead, [0], lumens=1200,
                                    efficiency=0.86, watts=12.5, size_m=(-0.09, -0.09, 0.0)),
        "downlight_70.ies": Profile("Downlight, wide", lambda v, h: flood(v), ahead, [0], lumens=2000,
                                    efficiency=0.9, watts=19, size_m=(-0.15, -0.15, 0.0)),
        "track_spot_15.ies": Profile("Track spot, 15 degrees", lambda v, h: spot15(v), steps(0, 30, 1) + [45, 60, 90],
                                     [0], lumens=1500, efficiency=0.72, watts=17, size_m=(-0.07, -0.07, 0.0)),
        "wall_washer.ies": Profile("Wall washer", washer, ahead, steps(0, 180, 15), lumens=2400, efficiency=0.78,
                                   watts=24, size_m=(0.12, 0.12, 0.0)),
        "batwing_linear.ies": Profile("Linear pendant, batwing", batwing, ahead, steps(0, 90, 15), lumens=4200,
                                      efficiency=0.83, watts=38, size_m=(0.06, 1.2, 0.0),
                                      standard="IES:LM-63-2019"),
        "street_light.ies": Profile("Street light", street, steps(0, 90, 5), steps(90, 270, 15), lumens=9000,
                                    efficiency=0.88, watts=70, size_m=(0.25, 0.5, 0.0), standard="IESNA:LM-63-1995"),
        "globe.ies": Profile("Opal globe", globe, whole, [0], lumens=806, efficiency=0.75, watts=8.5,
                             size_m=(-0.25, -0.25, -0.25), standard="IESNA91"),
        "bollard_ring.ies": Profile("Bollard", ring, whole, [0], lumens=900, efficiency=0.55, watts=11,
                                    size_m=(-0.12, -0.12, 0.1)),
        "floodlight_b.ies": Profile("Floodlight, type B", floodlight, steps(-90, 90, 5), steps(-90, 90, 5),
                                    lumens=12000, efficiency=0.81, watts=100, kind=2, size_m=(0.3, 0.3, 0.0)),
        "headlamp_a.ies": Profile("Headlamp, type A", headlamp, steps(0, 90, 2.5), steps(-90, -15, 15) + steps(-10, 10, 1)
                                  + steps(15, 90, 15), lumens=1100, efficiency=0.6, watts=15, kind=3,
                                  size_m=(0.2, 0.08, 0.0)),
        "tilted_lamp.ies": Profile("High bay, tilt included", lambda v, h: lobe(80, 2.2)(v), ahead, [0],
                                   lumens=22000, efficiency=0.77, watts=250, size_m=(-0.4, -0.4, 0.0), ballast=0.95,
                                   multiplier=1.1, tilt=([0, 45, 90], [1.0, 0.95, 0.9]),
                                   standard="IESNA:LM-63-1995"),
        "panel_absolute.ies": Profile("Panel, absolute photometry", lambda v, h: math.cos(math.radians(v)), ahead, [0],
                                      lumens=3600, efficiency=1.0, watts=30, size_m=(0.6, 0.6, 0.0), absolute=True,
                                      standard="IES:LM-63-2019"),
    }
