// What panels do to the desk, see desk.h.
#include "ui/desk.h"

#include "renderer/document/light_shapes.h"
#include "ui/file_tasks.h"
#include "ui/light_actions.h"
#include "ui/light_place.h"
#include "ui/reference_image.h"

#include <algorithm>
#include <utility>

namespace kilolux {

namespace {

constexpr double kNoticeS = 6.0;

void tell(Desk& desk, const std::optional<Error>& error) {
    if (error) notify(desk, Notice::Kind::Error, error->message);
}

// The document has a new version: lights that are gone are no longer selected, and the renderer learns of it.
void documentChanged(Desk& desk) {
    const Scene& scene = desk.session->scene();
    for (std::vector<std::uint64_t>* lights : {&desk.selection, &desk.solo, &desk.locked})
        std::erase_if(*lights, [&](std::uint64_t id) { return findLight(scene, id) < 0; });
    desk.renderThread->setInputTime(desk.inputMs);
    desk.renderThread->setLights(withSolo(scene, desk.solo), desk.session->version());
    const double ev100 =
        scene.hasExposure ? scene.exposureEv100 : desk.meteredEv100.value_or(desk.exposureEv100);
    if (ev100 != desk.exposureEv100) {
        desk.exposureEv100 = ev100;
        desk.renderThread->setExposureEv100(ev100);
    }
    if (const std::optional<Error> warning = desk.session->takeWarning())
        notify(desk, Notice::Kind::Warning, warning->message);
}

// Of what the camera frames: a sphere about the selected lights, or about the scene.
std::pair<glm::dvec3, double> framedSphere(const Desk& desk) {
    const Scene& scene = desk.session->scene();
    const Bounds bounds = worldBounds(scene);
    if (desk.selection.empty())
        return {0.5 * (bounds.min + bounds.max), 0.5 * glm::length(bounds.max - bounds.min)};
    std::vector<glm::dvec3> points;
    double radiusM = 0.0;
    for (const std::uint64_t id : desk.selection) {
        const LightDef& def = defOf(scene, id);
        points.push_back(positionOf(scene, id));
        // Of a flat light its size, of the others their radius; a point gets some surroundings.
        const bool flat = shapeOf(def.type).isFlat;
        radiusM =
            std::max({radiusM, flat ? std::max(def.widthM, def.heightM) : def.radiusM + def.lengthM, 0.5});
    }
    glm::dvec3 center(0.0);
    for (const glm::dvec3& point : points)
        center += point / double(points.size());
    double spreadM = 0.0;
    for (const glm::dvec3& point : points)
        spreadM = std::max(spreadM, glm::length(point - center));
    return {center, spreadM + 1.5 * radiusM};
}

} // namespace

bool Desk::isSelected(std::uint64_t light) const {
    return std::binary_search(selection.begin(), selection.end(), light);
}

bool applyEdits(Desk& desk, const Result<Edits>& edits, std::string name, std::string mergeKey) {
    if (!desk.session) return false;
    if (!edits) return tell(desk, Error{edits.error()}), false;
    if (edits.value().empty()) return true;
    if (const auto error = desk.session->apply(std::move(name), edits.value(), std::move(mergeKey)))
        return tell(desk, error), false;
    documentChanged(desk);
    return true;
}

void endDrag(Desk& desk) {
    if (desk.session) desk.session->seal();
}

void cancelDrag(Desk& desk) {
    if (!desk.session) return;
    tell(desk, desk.session->cancel());
    documentChanged(desk);
}

bool undo(Desk& desk) {
    if (!desk.session || !desk.session->history().canUndo()) return false;
    const std::optional<Error> error = desk.session->undo();
    tell(desk, error);
    documentChanged(desk);
    return !error;
}

bool redo(Desk& desk) {
    if (!desk.session || !desk.session->history().canRedo()) return false;
    const std::optional<Error> error = desk.session->redo();
    tell(desk, error);
    documentChanged(desk);
    return !error;
}

void select(Desk& desk, const std::vector<std::uint64_t>& lights, Selecting how) {
    std::vector<std::uint64_t> result =
        how == Selecting::Replace ? std::vector<std::uint64_t>{} : desk.selection;
    for (const std::uint64_t light : lights) {
        const auto at = std::lower_bound(result.begin(), result.end(), light);
        const bool there = at != result.end() && *at == light;
        if (!there) {
            result.insert(at, light);
        } else if (how == Selecting::Toggle) {
            result.erase(at);
        }
    }
    desk.selection = std::move(result);
}

void forgetLights(Desk& desk) {
    desk.selection.clear();
    desk.solo.clear();
    desk.locked.clear();
    desk.lightList.reset();
    desk.properties.reset();
    desk.gizmo.reset();
    desk.probe.reset();
    desk.viewPanel.reset();
    forgetReference(desk);
}

void showTab(Desk& desk, RightTab tab) {
    desk.wantedTab = tab;
    desk.panels.all = desk.panels.properties = true;
}

void setSolo(Desk& desk, std::vector<std::uint64_t> lights) {
    if (!desk.session) return;
    desk.solo = std::move(lights);
    desk.renderThread->setInputTime(desk.inputMs);
    desk.renderThread->setLights(withSolo(desk.session->scene(), desk.solo), desk.session->version());
}

void frameSelection(Desk& desk) {
    if (!desk.session) return;
    const auto [center, radiusM] = framedSphere(desk);
    desk.camera.frame(center, radiusM, desk.viewport.aspect());
    moveCamera(desk);
}

void moveCamera(Desk& desk) {
    desk.renderThread->setInputTime(desk.inputMs);
    desk.renderThread->setCamera(desk.camera.camera(), Renderer::CameraChange::Move);
}

void cutCamera(Desk& desk, const Camera& camera) {
    desk.camera.lookThrough(camera, desk.camera.pivotDistanceM());
    desk.renderThread->setInputTime(desk.inputMs);
    desk.renderThread->setCamera(desk.camera.camera(), Renderer::CameraChange::Cut);
}

void setView(Desk& desk, std::string view) {
    if (view == desk.view) return;
    desk.view = std::move(view);
    desk.renderThread->setInputTime(desk.inputMs);
    desk.renderThread->setView(desk.view);
}

void setExposure(Desk& desk, double ev100) {
    if (!desk.session) return;
    if (applyEdits(desk,
                   setField(desk.session->scene(), EditTarget::Scene, 0, "exposureEv100", EditValue(ev100)),
                   "Exposure", "exposure"))
        desk.exposureEv100 = ev100;
}

void setSettings(Desk& desk, const Settings& settings) {
    if (settings == desk.settings) return;
    desk.settings = settings;
    desk.renderThread->setInputTime(desk.inputMs);
    desk.renderThread->setSettings(settings);
}

void notify(Desk& desk, Notice::Kind kind, std::string text) {
    const bool repeated = !desk.notices.empty() && desk.notices.back().text == text;
    if (repeated) desk.notices.pop_back();
    desk.notices.push_back({kind, std::move(text), desk.nowS + kNoticeS});
    constexpr std::size_t kMost = 4;
    if (desk.notices.size() > kMost) desk.notices.erase(desk.notices.begin());
}

} // namespace kilolux
