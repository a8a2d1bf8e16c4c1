#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/surface/surface_maps.h>
#include <heddle/surface/surface_op.h>
#include <heddle/voxel/lattice_units.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heddle {

/// What all threads read of a geometry's surfaces: its triangles as one list, its maps with their
/// averages, and the normals that height maps move points along. Made once for a voxel size, then
/// read by any number of threads.
class SurfaceSource {
public:
    /// @param geometry       must outlive it, unchanged
    /// @param subvoxel_size  scene units per axis, > 0
    /// @param run            >= 1: so many neighbouring hits may share a sample, whose footprint is
    ///                       theirs together; on materials that alpha cuts each has its own
    /// @throws Error         InvalidArgument: a texture with less bytes than its size says, or an
    ///                       index (material, texture) that is out of range
    SurfaceSource(const Geometry& geometry,
                  Vec3d subvoxel_size,
                  std::uint64_t seed,
                  std::int32_t run = 1);
    /// As the voxelizer has it.
    SurfaceSource(const Geometry& geometry, const LatticeUnits& units, std::uint64_t seed);
    SurfaceSource(const SurfaceSource&) = delete; // its views point into it
    SurfaceSource& operator=(const SurfaceSource&) = delete;
    ~SurfaceSource() = default;

    /// Valid while this lives.
    [[nodiscard]] const SurfaceView& view() const { return view_; }
    /// @param mesh  an element of the geometry's meshes
    [[nodiscard]] const MeshView& view_of(const Mesh& mesh) const {
        return meshes_[static_cast<std::size_t>(&mesh - geometry_.meshes.data())];
    }
    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    /// Its averaged textures, in the order in which the views of textures lie.
    [[nodiscard]] std::size_t texture_count() const { return maps_.texture_count(); }
    [[nodiscard]] const FilteredTexture& texture(std::size_t i) const { return maps_.texture(i); }

    /// Memory that the averaged textures take, in bytes.
    [[nodiscard]] std::int64_t bytes() const { return maps_.bytes(); }
    /// Upper bound of the bytes that it takes, before anything is built.
    [[nodiscard]] static std::int64_t predict_bytes(const Geometry& geometry);

private:
    void add_mesh(const Mesh& mesh);

    const Geometry& geometry_;
    GeometryMaps maps_;
    std::vector<std::vector<Vec3f>> normals_; ///< per mesh; empty unless displaced without its own
    std::vector<MeshView> meshes_;
    std::vector<std::uint64_t> first_;
    SurfaceView view_;
};

/// Largest distance that the material's height map moves a point, in scene units; 0 without a map.
/// @throws Error  InvalidArgument: the texture's size does not match its bytes
[[nodiscard]] double max_displacement(const Material& material, const Texture& height_map);
/// How far height maps move the mesh's points at most, scene units: a rounding more than the
/// largest height, which is computed in float.
[[nodiscard]] double max_displacement(const Geometry& geometry, const Mesh& mesh);

} // namespace heddle
