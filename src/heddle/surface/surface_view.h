#pragma once

#include <heddle/base/offset_search.h>
#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/geom/material.h>
#include <heddle/geom/mesh.h>
#include <heddle/surface/texture_view.h>

#include <array>
#include <cstdint>

namespace heddle {

/// A mesh and the number of a triangle in it.
struct TriangleId {
    std::uint32_t mesh;
    std::uint32_t triangle;
};

/// A material with its maps ready to be read. A map that it does not have is null.
struct SurfaceMaps {
    const TextureView* albedo = nullptr;
    const TextureView* normal = nullptr;
    const TextureView* metal_rough = nullptr;
    const TextureView* anisotropy = nullptr;
    const TextureView* height = nullptr; ///< null also if it moves nothing
    float rotation_cos = 1.0f, rotation_sin = 0.0f;
    float alpha = 1.0f; ///< multiplies the texture's alpha
    float alpha_cutoff = 0.5f;
    float normal_scale = 1.0f;
    float height_scale = 0.0f, height_offset = 0.0f;
    AlphaMode alpha_mode = AlphaMode::Opaque;
    bool anisotropic = false;
};
static_assert(sizeof(SurfaceMaps) == 72, "the same on host and device");

/// The height over a mesh by its height map and material, in scene units along the normal: offset +
/// scale x height, averaged over the mesh's mean footprint. It is cheap to copy.
struct HeightLookup {
    const TextureView* map = nullptr;
    float level = 0.0f;
    float scale = 0.0f;
    float offset = 0.0f;

    [[nodiscard]] HEDDLE_HD float operator()(Uv uv) const {
        return offset + scale * map->filtered(uv, level).r;
    }
};

/// How the hits of a mesh are evaluated.
enum class SurfaceKind : std::uint8_t {
    Constant, ///< every hit of a triangle is covered and has its face's normal
    Shaded,   ///< normals or maps are read
    Displaced ///< a height map moves the surface
};

/// A Mesh as pointers and numbers. Arrays that it does not have are null.
struct MeshView {
    const Vec3f* positions = nullptr;
    const Vec3f* normals = nullptr;
    const Tangent* tangents = nullptr;
    const Uv* uvs = nullptr;
    const std::array<std::uint32_t, 3>* triangles = nullptr;
    const Vec3f* move_normals = nullptr; ///< directions of the displacement; displaced meshes only
    std::uint64_t vertex_count = 0;
    double displacement = 0.0; ///< largest distance that a height map moves points, scene units
    float height_level = 0.0f; ///< level of the height map for the mesh's mean footprint
    std::uint32_t material = 0;
    SurfaceKind kind = SurfaceKind::Constant;
};
static_assert(sizeof(MeshView) == 80, "the same on host and device");

/// All surfaces of a geometry as numbered triangles: the data of a SurfaceSource as pointers.
struct SurfaceView {
    const MeshView* meshes = nullptr;
    const std::uint64_t* first_triangle = nullptr; ///< of each mesh, and the end
    const SurfaceMaps* materials = nullptr;
    std::uint64_t mesh_count = 0;
    std::uint64_t triangle_count = 0;
    std::uint64_t seed = 0;
    Vec3d subvoxel_size; ///< scene units
    std::uint32_t material_count = 0;
    std::int32_t run = 1; ///< neighbouring hits that share a sample, on materials without alpha

    [[nodiscard]] HEDDLE_HD TriangleId place(std::uint64_t triangle) const {
        const std::uint64_t mesh = range_of(first_triangle, mesh_count, triangle);
        return {static_cast<std::uint32_t>(mesh),
                static_cast<std::uint32_t>(triangle - first_triangle[mesh])};
    }
    /// Returns the height over a mesh.
    /// @param mesh  a displaced mesh
    [[nodiscard]] HEDDLE_HD HeightLookup height_of(const MeshView& mesh) const {
        const SurfaceMaps& maps = materials[mesh.material];
        return {maps.height, mesh.height_level, maps.height_scale, maps.height_offset};
    }
};
static_assert(sizeof(SurfaceView) == 80, "the same on host and device");

} // namespace heddle
