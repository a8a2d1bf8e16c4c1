#pragma once

#include <heddle/geom/geometry.h>

#include <filesystem>

namespace heddle {

/// Writes the meshes of `geometry` as one .glb file with its textures as PNG inside: base colour,
/// alpha, normal map, metallic-roughness, KHR_materials_anisotropy. read_gltf returns the same
/// meshes and materials.
/// @throws InvalidArgument: there is no triangle, or something that glTF cannot hold (curves,
///         height maps, more than 4 GiB); NotFound or CannotWrite: the file cannot be written
void write_glb(const Geometry& geometry, const std::filesystem::path& path);

} // namespace heddle
