// Completes the attributes of a triangle list that a file leaves out or gets wrong.
#pragma once

#include "renderer/document/scene.h"

namespace kilolux {

// Removes triangles whose corners coincide or lie on a line (exactly). Returns how many.
std::size_t dropDegenerateTriangles(Primitive& primitive);

// glTF 2.0, section 3.7.2.1: without normals, a primitive is flat shaded. Vertices are split per triangle.
void makeFlatNormals(Primitive& primitive);

// Normalizes normals; those that are zero or not finite become the mean of their triangles' normals by angle.
void repairNormals(Primitive& primitive);

// Tangents for normal mapping from normals and one texture coordinate set (`useUv1`: uv1), as the
// angle-weighted mean of the triangles' dP/du in each vertex's normal plane, the weighting of Mikkelsen,
// Simulation of Wrinkled Surfaces Revisited (2008), section 2. A vertex on the seam of a mirrored texture is
// split in two. w is the sign for which cross(normal, tangent) * w points up in the texture, glTF's +Y
// (towards falling v).
enum class UvSet { Uv0, Uv1 };
void makeTangents(Primitive& primitive, UvSet uvSet);

// Normalizes tangents and makes them perpendicular to the normals; w becomes -1 or 1.
void repairTangents(Primitive& primitive);

void updateBounds(Primitive& primitive);

} // namespace kilolux
