#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/surface/surface_maps.h>
#include <heddle/surface/surface_op.h>
#include <heddle/voxel/lattice_units.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heddle {

/// A geometry's surfaces, ready to be voxelized: its triangles as one list, its maps with their
/// averages, and the normals that height maps move points along. It is made for a voxel size, and
/// any number of threads may read it.
class SurfaceSource {
public:
    /// @param geometry       must outlive this, unchanged
    /// @param subvoxel_size  scene units per axis, > 0
    /// @param run            >= 1: number of neighbouring hits that may share a sample with their
    ///                       joint footprint; materials with alpha have one sample per hit
    /// @throws Error         InvalidArgument: a texture with fewer bytes than its size requires, or
    ///                       an index (material, texture) that is out of range
    SurfaceSource(const Geometry& geometry,
                  Vec3d subvoxel_size,
                  std::uint64_t seed,
                  std::int32_t run = 1);
    /// Makes it for the voxelizer's subvoxel size and run.
    SurfaceSource(const Geometry& geometry, const LatticeUnits& units, std::uint64_t seed);
    SurfaceSource(const SurfaceSource&) = delete; // its views point into it
    SurfaceSource& operator=(const SurfaceSource&) = delete;
    ~SurfaceSource() = default;

    /// Returns a view that is valid while this lives.
    [[nodiscard]] const SurfaceView& view() const { return view_; }
    /// Returns the view of a mesh.
    /// @param mesh  an element of the geometry's meshes
    [[nodiscard]] const MeshView& view_of(const Mesh& mesh) const {
        return meshes_[static_cast<std::size_t>(&mesh - geometry_.meshes.data())];
    }
    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    /// These return its averaged textures, in the order of the texture views.
    [[nodiscard]] std::size_t texture_count() const { return maps_.texture_count(); }
    [[nodiscard]] const FilteredTexture& texture(std::size_t i) const { return maps_.texture(i); }

    /// Returns the memory of the averaged textures, in bytes.
    [[nodiscard]] std::int64_t bytes() const { return maps_.bytes(); }
    /// Returns an upper bound of its memory in bytes, without building anything.
    [[nodiscard]] static std::int64_t predict_bytes(const Geometry& geometry);

private:
    void add_mesh(const Mesh& mesh);

    const Geometry& geometry_;
    GeometryMaps maps_;
    std::vector<std::vector<Vec3f>> normals_; ///< per mesh; only if displaced without its own
    std::vector<MeshView> meshes_;
    std::vector<std::uint64_t> first_;
    SurfaceView view_;
};

/// Returns the largest distance that the material's height map moves a point, in scene units; 0
/// without a map.
/// @throws Error  InvalidArgument: the texture's size does not match its bytes
[[nodiscard]] double max_displacement(const Material& material, const Texture& height_map);
/// Returns the largest distance that height maps move the mesh's points, in scene units. It allows
/// for the rounding of heights, which are computed in float.
[[nodiscard]] double max_displacement(const Geometry& geometry, const Mesh& mesh);

} // namespace heddle
