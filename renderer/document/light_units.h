// Photometry of light definitions: from the typed (value, unit) to what shading uses, to luminous flux, and
// back; and from colour temperature to colour.
//
// Sources are Lambert emitters of one luminance L. With the axial intensity I [cd], radius r, length l
// between a tube's end caps: sphere, spot and disk L = I / (pi r^2), rectangle L = I / (w h), tube L = I / (2
// r l + pi r^2). Flux: sphere 4 pi I; tube pi L (2 pi r l + 4 pi r^2); rectangle and disk pi I; a spot's
// lumens are those that leave its cone, so a narrower cone concentrates them: I * 2 pi * integral of the
// cone's falloff over cos(angle). Lux of a local light is its illuminance 1 m away on the axis, lux of a
// directional light the illuminance of a surface that faces it, and its luminance E / (pi sin^2(a)) over a
// disk of the angular radius a. EV100: 0.125 * 2^EV nit.
//
// With a photometric profile as the light's shape the axial intensity is that at the profile's maximum, and
// lumens are those of the whole profile; its candela times the multiplier stand in place of the typed
// intensity where the light says so. Masks, doors, light functions and source textures take light away: the
// units are those of the light without them.
#pragma once

#include "renderer/document/scene.h"

namespace kilolux {

// Whether the unit means something for this type and size: no lumens or candela of a directional light, no
// luminance (nit, EV100) of a source without area.
bool unitApplies(const LightDef& def, LightUnit unit);

// The definition's intensity in candela; in lux for a directional light. 0 where its unit does not apply.
double baseIntensity(const LightDef& def);

// Whether the light has a profile that could be read and gives light, and whether that is its shape.
bool usesProfile(const LightDef& def);
bool isShapedByProfile(const LightDef& def);

// The value that the definition's intensity has in another unit; 0 where that does not apply.
double intensityIn(const LightDef& def, LightUnit unit);

// What `def` would have to be typed as in `unit` to emit `baseValue` candela (lux for a directional light).
double fromBaseIntensity(const LightDef& def, double baseValue, LightUnit unit);

// Luminous flux for a white tint, shaping by the cone included, range left out; 0 for a directional light.
double fluxLumen(const LightDef& def);

// One-sided for rectangle and disk, the whole surface for sphere, spot and tube.
double emitterAreaM2(const LightDef& def);

// A black body's colour in linear Rec. 709 with luminance 1 and no negative channel, 1000 to 40000 K (clamped
// to that). Planck's law is integrated over the colour matching functions as fitted by Wyman, Sloan and
// Shirley, Simple Analytic Approximations to the CIE XYZ Color Matching Functions, JCGT 2(2) 2013;
// chromaticity is within 0.004 in x and y of the tabulated 1931 observer from 2000 K on, within 0.012 below.
// The locus is adapted (Bradford) so that 6500 K is exactly white, as artists expect.
glm::dvec3 temperatureColor(double temperatureK);

// The CIE 1931 chromaticity (x, y) that temperatureColor starts from, before adaptation.
glm::dvec2 blackBodyChromaticity(double temperatureK);

// Tint times temperature times exposure: what the intensity is multiplied by, per channel.
glm::dvec3 emittedColor(const LightDef& def);

double luminanceOf(const glm::dvec3& linearRec709);

} // namespace kilolux
