#pragma once

#include <heddle/base/error.h>
#include <heddle/geom/geometry.h>

#include <string>

namespace heddle {

/// The most materials of a geometry: a voxel's lobe stores its material in a byte.
inline constexpr std::size_t kMaxMaterials = 256;

/// Adds `material` and returns its index.
/// @throws Unsupported: more than kMaxMaterials
inline std::uint32_t add_material(Geometry& geometry, Material material, const std::string& path) {
    if (geometry.materials.size() == kMaxMaterials)
        throw Error(ErrorCode::Unsupported,
                    str("uses more than ", kMaxMaterials, " materials, the limit of a volume"),
                    "merge materials or split the file", {.path = path});
    geometry.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(geometry.materials.size() - 1);
}

/// Adds `texture` and returns its index.
inline std::int32_t add_texture(Geometry& geometry, Texture texture) {
    geometry.textures.push_back(std::move(texture));
    return static_cast<std::int32_t>(geometry.textures.size() - 1);
}

} // namespace heddle
