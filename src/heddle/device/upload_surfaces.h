#pragma once

#include <heddle/device/upload_array.h>
#include <heddle/executor/array.h>
#include <heddle/surface/surface_source.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace heddle {

/// A SurfaceView for an executor, and the arrays that it points to.
struct DeviceSurfaces {
    /// The arrays of one mesh; those that it does not have are empty.
    struct Mesh {
        executor::Array<Vec3f> positions, normals, move_normals;
        executor::Array<Tangent> tangents;
        executor::Array<Uv> uvs;
        executor::Array<std::array<std::uint32_t, 3>> triangles;
    };
    /// The arrays of one averaged texture.
    struct Texture {
        executor::Array<std::uint8_t> image;
        executor::Array<std::uint16_t> decode;
        std::vector<executor::Array<Texel>> averages;
        executor::Array<TextureLevel> levels;
    };
    std::vector<Mesh> mesh_parts;
    std::vector<Texture> texture_parts;
    executor::Array<TextureView> textures;
    executor::Array<SurfaceMaps> materials;
    executor::Array<MeshView> meshes;
    executor::Array<std::uint64_t> first_triangle;
    SurfaceView view; ///< valid while this lives, even if it is moved
};

namespace upload_detail {

template <typename Exec>
DeviceSurfaces::Texture upload_texture(Exec& exec, TextureView& view) {
    DeviceSurfaces::Texture part;
    std::vector<TextureLevel> levels(view.levels, view.levels + view.level_count);
    const auto size_of = [](const TextureLevel& l) {
        return static_cast<std::size_t>(l.width) * static_cast<std::size_t>(l.height);
    };
    replace(exec, part.image, view.texels,
            size_of(levels[0]) * static_cast<std::size_t>(view.channels));
    replace(exec, part.decode, view.decode, 256);
    for (TextureLevel& level : levels)
        replace(exec, part.averages.emplace_back(), level.texels, size_of(level));
    view.levels = levels.data();
    replace(exec, part.levels, view.levels, levels.size());
    exec.wait(); // `levels` must live until it is copied
    return part;
}

template <typename Exec>
DeviceSurfaces::Mesh upload_mesh(Exec& exec, MeshView& view, std::size_t triangles) {
    DeviceSurfaces::Mesh part;
    const std::size_t n = view.vertex_count;
    const bool own_normals = view.move_normals == view.normals;
    replace(exec, part.positions, view.positions, n);
    replace(exec, part.normals, view.normals, n);
    replace(exec, part.tangents, view.tangents, n);
    replace(exec, part.uvs, view.uvs, n);
    replace(exec, part.triangles, view.triangles, triangles);
    if (own_normals) {
        view.move_normals = view.normals;
    } else {
        replace(exec, part.move_normals, view.move_normals, n);
    }
    return part;
}

/// Points a view of one of the source's textures to its copy.
inline void
point_to_copy(const SurfaceSource& source, const TextureView* copies, const TextureView*& map) {
    if (map == nullptr) return;
    std::size_t i = 0;
    while (&source.texture(i).view() != map) ++i;
    map = copies + i;
}

} // namespace upload_detail

/// Uploads the meshes, the materials and the textures with their averages to arrays of `exec`.
/// @throws Error  OutOfMemory, Device
template <typename Exec>
[[nodiscard]] DeviceSurfaces upload_surfaces(Exec& exec, const SurfaceSource& source) {
    using namespace upload_detail;
    DeviceSurfaces out;
    out.view = source.view();
    std::vector<TextureView> textures;
    for (std::size_t i = 0; i < source.texture_count(); ++i) {
        TextureView& view = textures.emplace_back(source.texture(i).view());
        out.texture_parts.push_back(upload_texture(exec, view));
    }
    const TextureView* copies = textures.data();
    replace(exec, out.textures, copies, textures.size());
    std::vector<SurfaceMaps> materials(out.view.materials,
                                       out.view.materials + out.view.material_count);
    for (SurfaceMaps& m : materials) {
        for (const TextureView** map :
             {&m.albedo, &m.normal, &m.metal_rough, &m.anisotropy, &m.height})
            point_to_copy(source, copies, *map);
    }
    out.view.materials = materials.data();
    replace(exec, out.materials, out.view.materials, materials.size());
    std::vector<MeshView> meshes(out.view.meshes, out.view.meshes + out.view.mesh_count);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const std::size_t n = out.view.first_triangle[m + 1] - out.view.first_triangle[m];
        out.mesh_parts.push_back(upload_mesh(exec, meshes[m], n));
    }
    out.view.meshes = meshes.data();
    replace(exec, out.meshes, out.view.meshes, meshes.size());
    replace(exec, out.first_triangle, out.view.first_triangle, out.view.mesh_count + 1);
    exec.wait(); // local data must live until they are copied
    return out;
}

} // namespace heddle
