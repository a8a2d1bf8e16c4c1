#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/mesh.h>

#include <vector>

namespace heddle {

/// Area-weighted vertex normals, joined over vertices with the same position: what a mesh without
/// normals is displaced along.
/// @return  one unit vector per vertex; +z for a vertex without a triangle that has an area
[[nodiscard]] std::vector<Vec3f> average_normals(const Mesh& mesh);

} // namespace heddle
