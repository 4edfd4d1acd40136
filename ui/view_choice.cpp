#include "ui/view_choice.h"

#include <algorithm>
#include <cassert>

namespace kilolux {

namespace {

struct GroupRow {
    std::string_view title;
    std::vector<std::string_view> views;
};

const std::vector<GroupRow>& groupRows() {
    static const std::vector<GroupRow> rows{
        {"Picture", {"final", "luminance", "illuminance", "stops", "clipping"}},
        {"Light", {"diffuse", "specular", "denoised-diffuse", "denoised-specular", "emissive"}},
        {"Lights", {"lights-in-range", "lights-seen", "seen-share", "list-length", "list-age"}},
        {"Sampling", {"chosen-light", "visibility", "hidden-share", "sample-weight", "reprojection"}},
        {"Denoiser", {"history-length", "deviation", "rejected-history"}},
        {"Surface",
         {"normal", "geometric-normal", "base-color", "roughness", "metallic", "depth", "depth-range",
          "instance", "primitive"}}};
    return rows;
}

} // namespace

std::vector<ViewGroup> viewGroups() {
    std::vector<ViewGroup> groups;
    std::vector<NamedChoice> rest(Renderer::views().begin(), Renderer::views().end());
    for (const GroupRow& row : groupRows()) {
        ViewGroup& group = groups.emplace_back(ViewGroup{row.title, {}});
        for (const std::string_view name : row.views) {
            const auto found = std::find_if(rest.begin(), rest.end(),
                                            [&](const NamedChoice& view) { return view.name == name; });
            assert(found != rest.end());
            group.views.push_back(*found);
            rest.erase(found);
        }
    }
    // One that nobody has sorted in yet.
    if (!rest.empty()) groups.push_back({"Others", std::move(rest)});
    return groups;
}

std::string viewKey(std::string_view view) {
    for (std::size_t i = 0; i < kViewKeys.size(); ++i) {
        if (kViewKeys[i] == (view.empty() ? "final" : view)) return std::to_string(i + 1);
    }
    return "";
}

std::string viewOfPass(std::string_view pass, std::string_view shownView,
                       const std::vector<std::string>& outputs) {
    constexpr std::array<std::array<std::string_view, 2>, 3> kBuffersOnly{{{"cull_coarse", "lights-in-range"},
                                                                           {"cull_fine", "lights-in-range"},
                                                                           {"visible_list", "list-length"}}};
    for (const auto& [name, view] : kBuffersOnly) {
        if (pass == name) return std::string(view);
    }
    const std::string first = "pass:" + std::string(pass);
    if (passOfView(shownView) != pass || outputs.empty()) return first;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        if (shownView == first + "/" + outputs[i]) return first + "/" + outputs[(i + 1) % outputs.size()];
    }
    return first;
}

std::string_view passOfView(std::string_view view) {
    if (!view.starts_with("pass:")) return "";
    view.remove_prefix(5);
    return view.substr(0, view.find('/'));
}

} // namespace kilolux
