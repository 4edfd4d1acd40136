"""Everything in the museum room is made of these."""
from kit import paintings
from kit.material import Material
from kit.noise import normals_from_height
from kit.surfaces import (brushed_metal, glazed_clay, leaf, plaster, polished_concrete, rough_concrete, soil,
                          wood,
                          woven)

FLOOR = polished_concrete()
WALL = plaster()
CEILING = plaster("ceiling", 512, 35, (0.62, 0.62, 0.61), 0.0003)
CONCRETE = rough_concrete()
PLINTH = Material("plinth paint", (0.74, 0.735, 0.72), 0.55)
OAK = wood("oak", (0.36, 0.22, 0.11))
OAK_FRAME = wood("oak frame", (0.42, 0.27, 0.14), 256, 43)
# Satin, not mirrors: with direct light alone a mirror shows nothing but the lamps.
BRASS = brushed_metal("brass", (0.887, 0.69, 0.37), 0.40)
POLISHED_BRASS = brushed_metal("satin brass", (0.887, 0.69, 0.37), 0.34, 256, 57)
STEEL = brushed_metal("steel", (0.56, 0.57, 0.58), 0.4, 256, 53)
BLACK_METAL = Material("black metal", (0.022, 0.022, 0.024), 0.42)
BLACK_FRAME = Material("black frame", (0.03, 0.028, 0.026), 0.35)
RUBBER = Material("shadow gap", (0.04, 0.04, 0.042), 0.7)
PLASTER_CAST = plaster("plaster cast", 256, 37, (0.80, 0.785, 0.75), 0.0005)
CLAY = glazed_clay("glazed clay", (0.05, 0.24, 0.23), (0.22, 0.10, 0.035))
CELADON = glazed_clay("celadon", (0.42, 0.52, 0.40), (0.50, 0.42, 0.26), 256, 63, 0.10)
OXBLOOD = glazed_clay("oxblood", (0.30, 0.028, 0.018), (0.05, 0.01, 0.02), 256, 65, 0.09)
POT = rough_concrete("pot", 256, 25, 0.22)
SOIL = soil()
LEAF = leaf("fig leaf", (0.06, 0.16, 0.035))
PALM_LEAF = leaf("palm leaf", (0.05, 0.17, 0.055), 256, 85)
BARK = Material("bark", (0.16, 0.11, 0.07), 0.9)
VELVET = woven("rope", (0.20, 0.018, 0.03), 128, 73, 24, 0.05, 0.8)
PAPER = Material("paper", (0.80, 0.79, 0.75), 0.8)
GLASS = Material("glass", (0.80, 0.90, 0.88), 0.03, alpha=0.10, alpha_mode="BLEND")


def painted(name, picture, relief_m, size_m, roughness):
    """Canvas under paint; UV 0..1 over the picture."""
    colors, height = picture
    return Material(name, (1, 1, 1), roughness, color_map=colors,
                    normal_map=normals_from_height(height * relief_m, size_m))


PICTURES = {
    "fields": painted("fields", paintings.fields(), 0.0007, 2.2, 0.62),
    "circles": painted("circles", paintings.circles(aspect=0.8), 0.0005, 1.6, 0.55),
    "marble": painted("marble", paintings.marble(), 0.0012, 1.5, 0.32),
    "strokes": painted("strokes", paintings.strokes(), 0.0011, 2.0, 0.42),
    "shards": painted("shards", paintings.shards(), 0.0006, 1.5, 0.5),
}
