#include "ui/luminaires.h"

#include "renderer/document/light_shapes.h"
#include "ui/change_builder.h"
#include "ui/light_fields.h"

namespace kilolux {

namespace {

using enum LightType;

// Lumens leave the luminaire: the share of the lamps' that its profile lets out.
constexpr Luminaire kLuminaires[] = {
    {"LED bulb, 8.5 W", Sphere, 806, 2700, 0.03, 0, 0, 0, ""},
    {"Opal globe", Sphere, 605, 2700, 0.125, 0, 0, 0, "globe.ies"},
    {"Candle", Sphere, 12, 1900, 0.008, 0, 0, 0, ""},
    {"Downlight, 36\u00b0", Disk, 1032, 3000, 0, 0, 0.09, 0, "downlight_36.ies"},
    {"Downlight, wide", Disk, 1800, 3000, 0, 0, 0.15, 0, "downlight_70.ies"},
    {"Track spot, 15\u00b0", Disk, 1080, 3000, 0, 0, 0.07, 0, "track_spot_15.ies"},
    {"Wall washer", Rect, 1872, 3000, 0, 0, 0.12, 0.12, "wall_washer.ies"},
    {"Linear pendant", Rect, 3486, 4000, 0, 0, 1.2, 0.06, "batwing_linear.ies"},
    {"Ceiling panel, 600 mm", Rect, 3600, 4000, 0, 0, 0.6, 0.6, "panel_absolute.ies"},
    {"Fluorescent tube, 36 W", Tube, 3350, 4000, 0.013, 1.2, 0, 0, ""},
    {"High bay", Disk, 16940, 5000, 0, 0, 0.4, 0, "tilted_lamp.ies"},
    {"Street light", Rect, 7920, 3000, 0, 0, 0.5, 0.25, "street_light.ies"},
    {"Bollard", Sphere, 495, 3000, 0.06, 0, 0, 0, "bollard_ring.ies"},
    {"Floodlight", Rect, 9720, 5000, 0, 0, 0.3, 0.3, "floodlight_b.ies"},
};

} // namespace

std::span<const Luminaire> luminaires() {
    return kLuminaires;
}

Result<Edits> editsForLuminaire(const Scene& scene, std::span<const std::uint64_t> lights,
                                const Luminaire& luminaire, const std::string& profileUri, Sharing sharing) {
    ChangeBuilder builder(scene);
    const auto set = [&](const char* field, const EditValue& value) {
        const Result<Edits> edits = editsForValue(builder.scene(), lights, field, value, sharing);
        if (edits) builder.take(edits.value());
        return edits;
    };
    const bool isFlat = shapeOf(luminaire.type).isFlat;
    std::vector<std::pair<const char*, EditValue>> values = {{"type", luminaire.type}};
    if (!isFlat) values.emplace_back("radiusM", luminaire.radiusM);
    if (luminaire.type == Tube) values.emplace_back("lengthM", luminaire.lengthM);
    if (isFlat) values.emplace_back("widthM", luminaire.widthM);
    if (luminaire.type == Rect) values.emplace_back("heightM", luminaire.heightM);
    values.emplace_back("iesProfile", profileUri);
    values.emplace_back("iesUse", std::string(profileUri.empty() ? "none" : "shape"));
    values.emplace_back("iesIntensity", false);
    values.emplace_back("unit", LightUnit::Lumen);
    values.emplace_back("intensity", luminaire.lumens);
    values.emplace_back("temperatureK", luminaire.temperatureK);
    for (const auto& [field, value] : values)
        if (const Result<Edits> edits = set(field, value); !edits) return Error{edits.error()};
    return builder.finish();
}

} // namespace kilolux
