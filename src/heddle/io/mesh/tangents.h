#pragma once

#include <heddle/geom/mesh.h>

namespace heddle {

/// Gives every triangle three vertices of its own, with the triangle's normal; a triangle without
/// area gets (0, 0, 1). Tangents are dropped.
void set_flat_normals(Mesh& mesh);

/// Fills Mesh::tangents by MikkTSpace's definition   [Mikkelsen 2008, "Simulation of wrinkled
/// surfaces revisited", appendix].
///
/// The triangles' uv derivatives, projected onto the vertex's tangent plane, normalized and
/// weighted by the angle at the vertex, are summed over the triangles that meet there by edges with equal
/// position, normal, uv and handedness. A vertex that several such groups share is split. As v
/// runs down the image, the handedness is that of (u, 1 - v): the bitangent points up in the image,
/// which is what glTF's normal maps mean by +y. Triangles without uv area take the frame of a
/// neighbour at the same vertex; where there is none, a direction at right angles to the normal.
/// The same input gives the same bits.
/// @param mesh  its uvs may be empty (every frame is then an arbitrary one); without normals it
///              gets flat ones first
void set_tangents(Mesh& mesh);

} // namespace heddle
