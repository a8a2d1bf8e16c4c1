#pragma once

#include <heddle/geom/geometry.h>

#include <filesystem>

namespace heddle {

/// Writes the meshes of `geometry` as one .glb file with its textures as PNG inside: base colour,
/// alpha, normal map, metallic-roughness, KHR_materials_anisotropy. read_gltf gives the same meshes
/// and materials back.
/// @throws InvalidArgument where there is no triangle, or something that glTF cannot hold (curves,
///         height maps, more than 4 GiB); NotFound or CannotWrite where it cannot be written
void write_glb(const Geometry& geometry, const std::filesystem::path& path);

} // namespace heddle
