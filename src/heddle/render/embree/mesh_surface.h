#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/surface/surface_maps.h>

#include <cstdint>
#include <vector>

namespace heddle {

/// A point of a triangle, given by the weights of its second and third corner.
struct TrianglePoint {
    std::uint32_t triangle = 0;
    float u = 0.0f, v = 0.0f;
};

/// The properties of a mesh at a point, in object space. Values of maps are multipliers, 1 without
/// a map.
struct MeshSample {
    Vec3f normal;  ///< shading normal, unit, on the side of the vertex normals
    Vec3f tangent; ///< direction of anisotropy, not zero; roughly perpendicular to `normal`
    Vec3f albedo{1.0f, 1.0f, 1.0f};
    float roughness = 1.0f;
    float metalness = 1.0f;
    float anisotropy = 1.0f;
};

/// The meshes of a geometry with their maps, which are read bilinearly at the finest level.
/// Immutable, so any number of threads may use it.
class MeshSurfaces {
public:
    /// @param geometry  must outlive this, unchanged
    /// @throws Error    InvalidArgument: an index is out of range, or a texture has too few texels;
    ///                  Unsupported: a height map displaces the mesh
    explicit MeshSurfaces(const Geometry& geometry);

    /// Returns true if alpha may cut holes into the mesh.
    [[nodiscard]] bool has_alpha(std::size_t mesh) const;
    /// Returns the alpha at a point: 0 or 1 for masks.
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
