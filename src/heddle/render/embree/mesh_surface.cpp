#include <heddle/render/embree/mesh_surface.h>

#include <heddle/base/error.h>
#include <heddle/surface/surface_frame.h>

namespace heddle {
namespace {

void check_mesh(const Mesh& mesh) {
    const std::size_t n = mesh.positions.size();
    const auto fits = [&](std::size_t size) { return size == 0 || size == n; };
    bool inside = fits(mesh.normals.size()) && fits(mesh.tangents.size()) && fits(mesh.uvs.size());
    for (const auto& corners : mesh.triangles) {
        for (const std::uint32_t c : corners) inside = inside && c < n;
    }
    if (!inside) {
        throw Error(ErrorCode::InvalidArgument,
                    str("a mesh of ", n, " vertices names others or has arrays of other lengths"),
                    "give vertex arrays one length and triangles indices below it");
    }
}

template <typename T>
Corners<T> corners_of(const T* values, const MeshView& mesh, std::uint32_t triangle) {
    const Corners<std::uint32_t>& c = mesh.triangles[triangle];
    return {values[c[0]], values[c[1]], values[c[2]]};
}

/// Interpolates the values of a triangle's corners at a point.
template <typename T>
T value_at(const Corners<T>& corners, TrianglePoint at) {
    return interpolate(corners, 1.0f - at.u - at.v, at.u, at.v);
}

Uv uv_at(const MeshView& mesh, TrianglePoint at) {
    return value_at(corners_of(mesh.uvs, mesh, at.triangle), at);
}

SurfaceDirection tangent_at(const MeshView& mesh, TrianglePoint at, Vec3f face_normal) {
    if (mesh.tangents != nullptr) {
        const CornerTangents tangents = corner_tangents(mesh, at.triangle);
        return {value_at(tangents.direction, at), tangents.handedness};
    }
    const Corners<Uv> uv =
        mesh.uvs != nullptr ? corners_of(mesh.uvs, mesh, at.triangle) : Corners<Uv>{};
    return direction_of_u(mesh, at.triangle, uv, face_normal);
}

SurfaceFrame frame_at(const MeshView& mesh, TrianglePoint at) {
    const Vec3f face = to_float(normalize(doubled_area(mesh, at.triangle)));
    const Vec3f normal =
        mesh.normals == nullptr
            ? face
            : normalize(value_at(corners_of(mesh.normals, mesh, at.triangle), at), face);
    return frame_of(normal, tangent_at(mesh, at, face));
}

bool displaces(const Material& m) {
    return m.height_map >= 0 && moves_surface(m);
}

} // namespace

MeshSurfaces::MeshSurfaces(const Geometry& geometry) : maps_(geometry, MapReading::Point) {
    for (const Mesh& mesh : geometry.meshes) {
        check_mesh(mesh);
        if (displaces(geometry.materials[mesh.material])) {
            throw Error(ErrorCode::Unsupported,
                        str("material '", geometry.materials[mesh.material].name,
                            "' displaces its surface by a height map, which is not traced"),
                        "leave the height map out, or render its volume");
        }
        meshes_.push_back(mesh_view(mesh));
    }
}

bool MeshSurfaces::has_alpha(std::size_t mesh) const {
    return maps_of(meshes_[mesh]).alpha_mode != AlphaMode::Opaque;
}

float MeshSurfaces::alpha(std::size_t mesh, TrianglePoint at) const {
    const MeshView& view = meshes_[mesh];
    const SurfaceMaps& maps = maps_of(view);
    if (view.uvs == nullptr || maps.albedo == nullptr) return coverage_of(maps, false, 1.0f);
    const Uv uv = uv_at(view, at);
    const bool mask = maps.alpha_mode == AlphaMode::Mask;
    return coverage_of(maps, true,
                       mask ? maps.albedo->coverage_at_point(uv) : maps.albedo->at_point(uv).a);
}

MeshSample MeshSurfaces::sample(std::size_t mesh, TrianglePoint at) const {
    const MeshView& view = meshes_[mesh];
    const SurfaceMaps& maps = maps_of(view);
    const SurfaceFrame f = frame_at(view, at);
    MeshSample s;
    s.normal = f.normal;
    FrameDirection d;
    if (view.uvs != nullptr) {
        const Uv uv = uv_at(view, at);
        if (maps.albedo != nullptr) {
            const Rgba c = maps.albedo->filtered(uv, 0.0f);
            s.albedo = {c.r, c.g, c.b};
        }
        if (maps.metal_rough != nullptr) {
            const Rgba c = maps.metal_rough->at_point(uv);
            s.roughness = c.g;
            s.metalness = c.b;
        }
        if (maps.normal != nullptr) {
            s.normal = normal_from_map(f, maps, maps.normal->at_point(uv));
        }
        if (maps.anisotropy != nullptr) {
            const Rgba c = maps.anisotropy->at_point(uv);
            s.anisotropy = c.b;
            d = direction_in_frame(c);
        }
    }
    s.tangent = normalize(turned_direction(f, maps, d.x, d.y), f.tangent);
    return s;
}

} // namespace heddle
