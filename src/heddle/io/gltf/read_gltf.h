#pragma once

#include <heddle/geom/geometry.h>

#include <filesystem>

namespace heddle {

/// Reads the triangles of the default scene of a .gltf or .glb file, in world space.
///
/// One Mesh per primitive, with all its instances: node transforms and EXT_mesh_gpu_instancing are
/// applied. Materials: metallic-roughness, normal map, alpha, KHR_materials_anisotropy,
/// KHR_texture_transform, the albedo of KHR_materials_pbrSpecularGlossiness. Normals are flat if
/// the file has none (as glTF demands); tangents are made if the material needs them. A map whose
/// image is missing or unreadable is dropped, or replaced by a file of the same stem, with a note.
/// @throws NotFound, BadFile; Unsupported: compressed geometry or more than 256 materials;
///         OutOfMemory
[[nodiscard]] Geometry read_gltf(const std::filesystem::path& path);

} // namespace heddle
