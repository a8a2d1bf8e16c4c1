#pragma once

#include <heddle/io/file/test_files.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/scene/scene.h>
#include <heddle/stage/stage.h>
#include <heddle/voxel/test_grid.h>

#include <memory>
#include <string>

namespace heddle::testing {

/// Returns a slab of 32 x 32 x 4 voxels of size 0.1, centered in x and y, with all levels: 4096,
/// 512, 64, 16 and 4 voxels.
inline VoxelLevels make_slab(const std::vector<Material>& materials) {
    VoxelLevels levels;
    for (int level = 0; level < 5; ++level) {
        VoxelMap voxels;
        const int side = 16 >> level, deep = std::max(1, 4 >> level);
        for (int x = -side; x < side; ++x) {
            for (int y = -side; y < side; ++y) {
                for (int z = 0; z < deep; ++z) {
                    const auto material =
                        static_cast<std::uint8_t>(x < 0 ? 0 : materials.size() - 1);
                    voxels[{x, y, z}] = {{20000, 20000, 20000, 20000},
                                         {{needle({1.0f, 0.0f, 0.0f}), 255, material}}};
                }
            }
        }
        auto grid = std::make_unique<MemoryLevel>();
        grid->info().name = "slab";
        grid->info().lattice = lattice_of_level({{0.1, 0.1, 0.1}, 8}, level);
        grid->info().level = level;
        grid->info().lod = "moments";
        grid->info().materials = materials;
        grid->blocks = make_blocks(voxels);
        count_voxels(*grid);
        levels.push_back(std::move(grid));
    }
    return levels;
}

inline Material named(const std::string& name, Vec3f albedo = {0.5f, 0.5f, 0.5f}) {
    Material material;
    material.name = name;
    material.kind = MaterialKind::Fiber;
    material.albedo = albedo;
    return material;
}

/// Writes the slab as a .vdb into the folder; returns a scene of it without a camera.
inline Scene slab_scene(const TempFolder& folder,
                        const std::vector<Material>& materials = {named("wool")}) {
    const std::string path = folder.file("slab.vdb");
    Progress progress;
    write_vdb(make_slab(materials), path, progress);
    Scene scene;
    SceneObject& object = scene.objects.emplace_back();
    object.name = "slab";
    object.volume = path;
    object.instances.resize(1);
    scene.width = 24;
    scene.height = 16;
    return scene;
}

/// Returns a camera in front of the slab whose pixels are `voxels` voxels wide on it.
inline SceneCamera camera_at(const Scene& scene, double voxels) {
    SceneCamera camera;
    const double pixel =
        2.0 * std::tan(0.5 * camera.view_angle_deg * 3.14159265 / 180.0) / scene.height;
    camera.eye = {0, 0, 0.4 + 0.1 * voxels / pixel};
    return camera;
}

/// Returns the finest level that was read; -1: none.
inline int finest_read(const Stage& stage) {
    const TraversalLevels& levels = stage.scene().volumes.at(0).pyramid();
    for (std::size_t l = 0; l < levels.size(); ++l) {
        if (levels[l]) return static_cast<int>(l);
    }
    return -1;
}

} // namespace heddle::testing
