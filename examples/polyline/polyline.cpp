// A polyline in memory becomes voxels, and its voxels are read back: the start of a plug-in.
#include <heddle/heddle.h>

#include <cstdio>

int main() {
    heddle::Geometry geometry;
    geometry.materials.push_back({.name = "thread", .kind = heddle::MaterialKind::Fiber});
    geometry.curves.push_back({.basis = heddle::Basis::Linear,
                               .points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5f}},
                               .first = {0, 3},
                               .default_radius = 0.05f});
    heddle::VoxelizeOptions options;
    options.voxels = 32; // along the longest axis
    heddle::Progress progress;
    const heddle::VoxelizePlan plan = heddle::plan_voxelize(geometry, options, progress);
    const auto voxels = heddle::voxelize(geometry, options, plan, progress);
    std::int64_t count = 0;
    heddle::for_each_voxel(*voxels, [&](const heddle::BlockVoxel& voxel) {
        if (++count > 1) return;
        std::printf("first voxel: %d %d %d, occupancy %g, lobes %zu\n", voxel.at.x, voxel.at.y,
                    voxel.at.z, voxel.coverage().occupancy / 65535.0, voxel.lobes().size());
    });
    std::printf("%lld voxels\n", static_cast<long long>(count));
}
