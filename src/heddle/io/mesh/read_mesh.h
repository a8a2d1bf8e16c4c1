#pragma once

#include <heddle/geom/geometry.h>

#include <filesystem>

namespace heddle {

/// Reads the triangles and polylines of a Wavefront .obj file with its .mtl materials.
///
/// One Mesh per material that faces use; polygons are triangulated; `l` lines become one CurveSet
/// of Basis::Linear without radius. v is flipped so that it runs down the image, as everywhere in
/// heddle. A mesh keeps its normals if all its corners have one. Tangents are made if the material
/// has a normal map or anisotropy.
/// @throws NotFound, BadFile with the line; Unsupported: more than 256 materials; OutOfMemory
[[nodiscard]] Geometry read_obj(const std::filesystem::path& path);

/// Reads the triangles and polylines of a .ply file: ascii, binary little and big endian.
///
/// Reads `vertex` (x y z [nx ny nz] [u v | s t | texture_u texture_v] [radius]), `face`
/// (vertex_indices or vertex_index), `tristrips` and `edge` (vertex1 vertex2, joined into chains);
/// skips all other elements. v is flipped as for .obj.
/// @throws NotFound, BadFile with byte or line; OutOfMemory
[[nodiscard]] Geometry read_ply(const std::filesystem::path& path);

/// Makes `height` the height map of every material: a surface point moves along its normal by
/// offset + scale x height, scene units.
/// @param height  the first channel is used, 0 to 1
/// @throws InvalidArgument for an empty texture, a scale or offset that is not finite, or meshes
///         without uv
void set_height_map(Geometry& geometry, Texture height, float scale, float offset);

} // namespace heddle
