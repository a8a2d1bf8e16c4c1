#pragma once

#include <heddle/base/vec.h>

#include <cstdint>
#include <string>

namespace heddle {

enum class MaterialKind : std::uint8_t {
    Fiber,  ///< its lobes are distributions of tangents
    Surface ///< its lobes are distributions of normals
};

enum class AlphaMode : std::uint8_t {
    Opaque, ///< alpha is ignored
    Mask,   ///< alpha below `alpha_cutoff` cuts a hole
    Blend   ///< alpha is the probability that a column's centre line is covered
};

/// A material's constants, and the textures of the geometry that modulate them (-1: none).
///
/// Texture channels follow glTF 2.0: base colour RGBA; metallic-roughness G = roughness, B =
/// metalness; normal map xyz; anisotropy (KHR_materials_anisotropy) RG = direction, B = strength.
struct Material {
    std::string name;
    MaterialKind kind = MaterialKind::Surface;
    Vec3f albedo{0.8f, 0.8f, 0.8f};   ///< linear RGB in [0, 1]
    float roughness = 0.5f;           ///< glTF roughness, in [0, 1]
    float metalness = 0.0f;           ///< in [0, 1]
    float anisotropy = 0.0f;          ///< strength in [0, 1]; > 0: the voxelizer stores tangents
    float anisotropy_rotation = 0.0f; ///< radians, counter-clockwise from the mesh's tangent
    AlphaMode alpha_mode = AlphaMode::Opaque;
    float alpha = 1.0f; ///< multiplies the texture's alpha
    float alpha_cutoff = 0.5f;
    float normal_scale = 1.0f; ///< multiplies the normal map's x and y
    /// displacement at height-map value 1, scene units, along the normal
    float height_scale = 0.0f;
    float height_offset = 0.0f; ///< displacement at height-map value 0, scene units
    /// mean radius of the fibers that have this material, scene units; 0: unknown
    float fiber_radius = 0.0f;
    std::int32_t albedo_map = -1;
    std::int32_t normal_map = -1;
    std::int32_t metal_rough_map = -1;
    std::int32_t anisotropy_map = -1;
    std::int32_t height_map = -1;
};

} // namespace heddle
