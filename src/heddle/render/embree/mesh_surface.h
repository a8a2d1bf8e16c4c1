#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/surface/surface_maps.h>

#include <cstdint>
#include <vector>

namespace heddle {

/// A point of a triangle: weights of its second and third corner.
struct TrianglePoint {
    std::uint32_t triangle = 0;
    float u = 0.0f, v = 0.0f;
};

/// What a mesh is at a point. Object space; the maps' values are multipliers, 1 without a map.
struct MeshSample {
    Vec3f normal;  ///< shading normal, unit; side of the vertex normals
    Vec3f tangent; ///< direction of anisotropy, not zero; about at right angles to `normal`
    Vec3f albedo{1.0f, 1.0f, 1.0f};
    float roughness = 1.0f;
    float metalness = 1.0f;
    float anisotropy = 1.0f;
};

/// The meshes of a geometry with their maps ready to be read, bilinear at the finest level. Never
/// changes: any number of threads.
class MeshSurfaces {
public:
    /// @param geometry  must outlive this, unchanged
    /// @throws Error    InvalidArgument: an index out of range, a texture shorter than its size;
    ///                  Unsupported: a height map that displaces
    explicit MeshSurfaces(const Geometry& geometry);

    /// Whether alpha may cut the mesh.
    [[nodiscard]] bool has_alpha(std::size_t mesh) const;
    /// Covered fraction at a point: 0 or 1 for masks.
    [[nodiscard]] float alpha(std::size_t mesh, TrianglePoint at) const;
    [[nodiscard]] MeshSample sample(std::size_t mesh, TrianglePoint at) const;
    [[nodiscard]] std::int64_t byte_count() const { return maps_.bytes(); }

private:
    [[nodiscard]] const SurfaceMaps& maps_of(const MeshView& mesh) const {
        return maps_.materials()[mesh.material];
    }

    GeometryMaps maps_;
    std::vector<MeshView> meshes_;
};

} // namespace heddle
