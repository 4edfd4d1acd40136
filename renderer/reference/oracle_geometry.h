// Triangles of the oracle. Embree (robust mode) proposes hits in single precision, relative to the scene's
// middle; a filter decides in double precision, on the document's own positions, whether each one counts: in
// front of the origin, before the end, on the visible side, not cut out by its alpha mask. The origin's own
// plane never counts, so no offset along the normal is needed.
#pragma once

#include "renderer/reference/oracle.h"
#include "renderer/reference/oracle_material.h"

#include <embree3/rtcore.h>

namespace kilolux::oracle {

class OracleGeometry {
  public:
    explicit OracleGeometry(const Scene& scene);
    ~OracleGeometry();
    OracleGeometry(const OracleGeometry&) = delete;
    OracleGeometry& operator=(const OracleGeometry&) = delete;

    std::optional<OracleHit> nearest(const glm::dvec3& originWs, const glm::dvec3& directionWs,
                                     double minDistanceM) const;
    bool occluded(const glm::dvec3& originWs, const glm::dvec3& directionWs, double lengthM,
                  std::optional<std::uint8_t> channels) const;

  private:
    struct Part { // one primitive of one node; the index is Embree's geometry id
        std::shared_ptr<const Mesh> mesh;
        int primitiveIndex;
        int node;
        int material;
        bool doubleSided;
        bool masked; // alpha decides point by point
        double cutoff;
        double side; // -1 where the node mirrors
        std::uint8_t channels;
        glm::dmat4 worldFromNode;
        glm::dmat3 normalMatrix; // inverse transpose

        const Primitive& primitive() const { return mesh->primitives[primitiveIndex]; }
    };
    struct Triangle {
        glm::dvec3 corner[3];
        glm::dvec3 normal; // not normalized, on the front side
    };
    struct Query;

    void addPart(const Scene& scene, int node, int primitiveIndex);
    Triangle triangle(const Part& part, std::uint32_t index) const;
    bool accepts(const Query& query, std::uint32_t partIndex, std::uint32_t triangleIndex) const;
    OracleHit describe(const Query& query, const Part& part, std::uint32_t triangleIndex) const;
    static void filter(const RTCFilterFunctionNArguments* arguments);
    RTCRay makeRay(const Query& query, double& shiftM) const;

    MaterialReader materials_;
    std::vector<Part> parts_;
    glm::dvec3 anchorWs_{0.0};
    double reachM_ = 1.0; // largest coordinate relative to the anchor
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

} // namespace kilolux::oracle
