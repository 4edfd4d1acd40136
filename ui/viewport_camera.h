// The camera of the viewport: flies, orbits about a pivot, dollies, pans and frames, without rolling. Pure
// maths; the window feeds it.
#pragma once

#include "renderer/document/scene.h"

#include <glm/glm.hpp>

namespace kilolux {

class ViewportCamera {
  public:
    // Stands where `camera` stands, with its lens. The pivot lies `pivotM` metres ahead.
    void lookThrough(const Camera& camera, double pivotM);
    // The document's form of it, without a name or node.
    Camera camera() const;

    glm::dvec3 eyeWs() const { return eyeWs_; }
    glm::dvec3 pivotWs() const;
    double pivotDistanceM() const { return pivotM_; }

    // Turns the head by angles in radians: yaw to the right, pitch up; up to straight up and down.
    void look(double yawRad, double pitchRad);
    // The same about the pivot, which keeps its place in the picture.
    void orbit(double yawRad, double pitchRad);
    // Metres to the right, up and ahead in the camera's own frame; the pivot comes along.
    void move(const glm::dvec3& stepM);
    // Moves towards the pivot so that its distance is multiplied by `factor`; a lens without perspective
    // zooms instead. Never closer than 1 cm: a view must not turn over.
    void dolly(double factor);
    // Moves across the view so that what lies at the pivot's depth follows the pointer.
    void pan(glm::dvec2 pixels, double viewportHeightPx);
    // Shows a sphere whole from the present direction, in a picture of this shape (width / height).
    void frame(const glm::dvec3& centerWs, double radiusM, double aspect);

  private:
    glm::dmat3 axes() const; // right, up, back

    Camera lens_;
    glm::dvec3 eyeWs_{0.0, 1.6, 5.0};
    double yawRad_ = 0.0;   // to the right of -Z, about +Y
    double pitchRad_ = 0.0; // up
    double rollRad_ = 0.0;  // of the camera that was looked through
    double pivotM_ = 3.0;
};

} // namespace kilolux
