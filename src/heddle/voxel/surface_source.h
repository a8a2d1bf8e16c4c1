#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/geometry.h>
#include <heddle/voxel/texture_filter.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace heddle {

/// A hit of `scan_triangle`, to be shaded.
struct SurfaceHit {
    std::int32_t axis = 0;
    std::int32_t i = 0, j = 0, k = 0; ///< global subvoxel index
    float b0 = 1.0f, b1 = 0.0f, b2 = 0.0f;
};

/// What a surface is at one hit. The maps' values are multipliers: 1 where there is no map.
struct SurfaceSample {
    bool covered = true;   ///< false: cut away by alpha, nothing else is set
    Vec3f normal{};        ///< unit, world axes; axial, either side
    Vec3f tangent{};       ///< unit, at right angles to `normal`; (0, 0, 0) where isotropic
    Vec3f albedo{1, 1, 1}; ///< linear, in [0, 1]
    float roughness = 1.0f;
    float metalness = 1.0f;
    float anisotropy = 1.0f;
};

/// A material with its maps ready to be read. Null where there is none.
struct SurfaceMaps {
    const Material* material = nullptr;
    const FilteredTexture* albedo = nullptr;
    const FilteredTexture* normal = nullptr;
    const FilteredTexture* metal_rough = nullptr;
    const FilteredTexture* anisotropy = nullptr;
    const FilteredTexture* height = nullptr;
    bool anisotropic = false;
    float rotation_cos = 1.0f, rotation_sin = 0.0f;
};

/// What the hits of one triangle share.
struct TriangleSetup {
    const SurfaceMaps* maps = nullptr;
    Vec3f face_normal{};   ///< unit, counter-clockwise side
    Vec3d normal{};        ///< the same, as `hit_weight` takes it
    bool constant = false; ///< every hit gives {true, face_normal}: no need to call `sample`
    bool smooth = false;   ///< vertex normals vary
    bool textured = false; ///< `uv` holds
    bool displaced = false;
    std::int32_t run =
        1; ///< neighbouring hits of a row that one sample, at their middle, stands for
    std::array<Vec3f, 3> normals{};
    std::array<Vec3f, 3> tangents{};
    float handedness = 1.0f; ///< bitangent = handedness x cross(normal, tangent)
    std::array<Uv, 3> uv{};
    float footprint_uv = 0.0f; ///< square root of the uv area that a sample stands for
    float albedo_level = 0.0f;
    float metal_rough_level = 0.0f;
    float anisotropy_level = 0.0f;
};

/// Height over a mesh, in scene units along the normal, as its height map and material give it:
/// offset + scale x height, averaged over the mesh's mean footprint. Copies are cheap.
struct HeightLookup {
    const FilteredTexture* map = nullptr;
    float level = 0.0f;
    float scale = 0.0f;
    float offset = 0.0f;

    [[nodiscard]] float operator()(Uv uv) const {
        return offset + scale * map->filtered(uv, level).r;
    }
};

/// Gives the directions and map values of surface hits: built once for a geometry and a voxel size,
/// then read by any number of threads.
///
/// Colour, roughness, metalness and strength are means over the footprint of a hit (trilinear, in
/// linear light; colour weighted by alpha). Directions are not: a mean normal has lost the spread
/// that the voxel's second moment is there to keep. So where the footprint exceeds a texel, normal
/// maps and anisotropy directions are read at a random point of it, at the finest level.
/// Alpha: the covered fraction c of the footprint (of a mask, exactly 0 or 1 below a texel) covers
/// the column if c exceeds a hash of the hit's position: right in the mean at any footprint.
/// Random numbers are hashes of (seed, i, j, k, axis). float + - * / sqrt only: the same everywhere.
class SurfaceSampler {
public:
    /// @param geometry       must outlive the sampler, unchanged
    /// @param subvoxel_size  scene units per axis, > 0
    /// @param run            >= 1: so many neighbouring hits may share a sample, whose footprint is
    ///                       theirs together; on materials that alpha cuts each has its own
    /// @throws Error         InvalidArgument: a texture with less bytes than its size says, or an
    ///                       index (material, texture) that is out of range
    SurfaceSampler(const Geometry& geometry,
                   Vec3d subvoxel_size,
                   std::uint64_t seed,
                   std::int32_t run = 1);

    /// @param triangle  index into `mesh.triangles`
    [[nodiscard]] TriangleSetup setup(const Mesh& mesh, std::size_t triangle) const;
    [[nodiscard]] SurfaceSample sample(const TriangleSetup& setup, const SurfaceHit& hit) const;
    /// The same on a displaced triangle: `micro_normal` (unit) takes the place of the interpolated
    /// normal, and of the normal map, which holds the same relief.
    [[nodiscard]] SurfaceSample
    sample(const TriangleSetup& setup, const SurfaceHit& hit, Vec3f micro_normal) const;

    /// True if every hit of the mesh gives {true, face normal}: TriangleSetup::constant.
    [[nodiscard]] bool is_constant(const Mesh& mesh) const;
    /// True if the mesh's material has a height map that moves its surface.
    [[nodiscard]] bool is_displaced(const Mesh& mesh) const;
    /// @param mesh  an element of the geometry's meshes, with is_displaced(mesh)
    [[nodiscard]] HeightLookup height_of(const Mesh& mesh) const;

    /// Memory that the averaged textures take, in bytes.
    [[nodiscard]] std::int64_t bytes() const;
    /// Upper bound of `bytes`, before anything is built.
    [[nodiscard]] static std::int64_t predict_bytes(const Geometry& geometry);

private:
    struct Stored {
        std::int32_t texture;
        TexelWeight weight;
        float threshold;
        bool levels;
        std::unique_ptr<FilteredTexture> filtered;
    };

    const FilteredTexture*
    stored(std::int32_t texture, TexelWeight weight, float threshold, bool levels);
    SurfaceMaps make_maps(const Material& material);
    void set_texture(TriangleSetup& t, double area) const;
    void set_tangents(TriangleSetup& t, const Mesh& mesh, std::size_t triangle) const;
    [[nodiscard]] bool covers(const SurfaceHit& hit, float alpha) const;
    [[nodiscard]] Uv point_in_footprint(const TriangleSetup& t,
                                        const SurfaceHit& hit,
                                        Uv uv,
                                        float texels_per_uv) const;
    [[nodiscard]] SurfaceSample
    shade(const TriangleSetup& t, const SurfaceHit& hit, Vec3f normal, bool mapped_normal) const;
    void set_frame(const TriangleSetup& t,
                   const SurfaceHit& hit,
                   Uv uv,
                   bool mapped_normal,
                   SurfaceSample& s) const;

    const Geometry* geometry_;
    Vec3d subvoxel_size_;
    std::uint64_t seed_;
    std::int32_t run_;
    std::vector<Stored> stored_;
    std::vector<SurfaceMaps> maps_;    ///< per material
    std::vector<float> height_levels_; ///< per mesh
};

/// Largest distance that the material's height map moves a point, in scene units; 0 without a map.
/// @throws Error  InvalidArgument: the texture's size does not match its bytes
[[nodiscard]] double max_displacement(const Material& material, const Texture& height_map);

} // namespace heddle
