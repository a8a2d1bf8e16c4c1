#pragma once

#include <heddle/geom/mesh.h>

namespace heddle {

/// Gives every triangle three vertices of its own, with the triangle's normal; a triangle without
/// area gets the normal (0, 0, 1). Tangents are dropped.
void set_flat_normals(Mesh& mesh);

/// Fills Mesh::tangents by MikkTSpace's definition   [Mikkelsen 2008, "Simulation of wrinkled
/// surfaces revisited", appendix].
///
/// The uv derivatives of triangles, projected onto the vertex's tangent plane, normalized and
/// weighted by the angle at the vertex, are summed over the triangles that are connected there by
/// edges with equal position, normal, uv and handedness. A vertex that several of these groups
/// share is split. As v runs down the image, the handedness is that of (u, 1 - v): the bitangent
/// points up in the image, which is +y of glTF's normal maps. Triangles without uv area take the
/// frame of a neighbour at the same vertex or, if there is none, a direction perpendicular to the
/// normal. The same input gives the same bits.
/// @param mesh  may have no uvs (every frame is then arbitrary); without normals, flat normals are
///              made first
void set_tangents(Mesh& mesh);

} // namespace heddle
