#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/mesh.h>

#include <vector>

namespace heddle {

/// Returns area-weighted vertex normals, shared by all vertices with the same position. A mesh
/// without normals is displaced along them.
/// @return  one unit vector per vertex; +z if all its triangles have no area
[[nodiscard]] std::vector<Vec3f> average_normals(const Mesh& mesh);

} // namespace heddle
