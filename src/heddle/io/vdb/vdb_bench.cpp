#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/base/parallel.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/predict_vdb.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/test_grid.h>
#include <heddle/io/vdb/write_vdb.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

// heddle_io_vdb_bench MILLION_VOXELS [OUT.vdb]: seconds and bytes of writing and reading back voxels
// like those of a cloth: a sheet of leaves, 35 % of each active, fiber directions that wander.

namespace heddle {
namespace {

VoxelBlock make_block(int bx, int bz, int side, std::uint64_t seed) {
    VoxelBlock block;
    for (int x = 0; x < 4; ++x) {
        for (int y = 0; y < 2; ++y) { // two leaves thick
            for (int z = 0; z < 4; ++z) {
                VoxelLeaf leaf;
                leaf.origin = {(bx - side / 2) * 32 + x * 8, y * 8, (bz - side / 2) * 32 + z * 8};
                leaf.first_voxel = static_cast<std::uint32_t>(block.coverage.size());
                leaf.first_lobe = static_cast<std::uint32_t>(block.lobes.size());
                CounterRandom random{seed,
                                     hash64(1, static_cast<std::uint64_t>(leaf.origin.x),
                                            static_cast<std::uint64_t>(leaf.origin.z * 64 + y))};
                const float centre = 2.0f + 4.0f * random.uniform();
                const float angle = 6.28f * random.uniform();
                for (int i = 0; i < 512; ++i) {
                    const float across = static_cast<float>((i >> 3) & 7) - centre;
                    if (across * across + random.uniform() * 2.0f > 3.2f) continue;
                    leaf.active[static_cast<std::size_t>(i >> 6)] |= std::uint64_t{1} << (i & 63);
                    const float turn = angle + 0.4f * random.uniform();
                    const Vec3f d = normalize(Vec3f{std::cos(turn), 0.3f * across, std::sin(turn)});
                    const auto c = [&] {
                        return static_cast<std::uint16_t>(
                            65535 * (static_cast<int>(random.uniform() * 65.0f)) / 64);
                    };
                    testing::push_voxel(block, {c(), c(), c(), c()},
                                        {{testing::needle(d), 255, 0}});
                }
                block.leaves.push_back(leaf);
            }
        }
    }
    return block;
}

VoxelGrid make_cloth(double voxels) {
    VoxelGrid grid;
    grid.about.name = "cloth";
    Material m;
    m.kind = MaterialKind::Fiber;
    grid.about.materials.push_back(m);
    const double per_block = static_cast<double>(make_block(0, 0, 1, 1).coverage.size());
    const int side = static_cast<int>(std::sqrt(voxels / per_block)) + 1;
    grid.blocks.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    parallel_chunks(grid.blocks.size(), 1, [&](std::size_t i, std::size_t) {
        const int n = static_cast<int>(i);
        grid.blocks[i] = make_block(n / side, n % side, side, 5);
    });
    testing::count_voxels(grid);
    return grid;
}

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

void run(double million, const std::string& path) {
    const VoxelGrid grid = make_cloth(million * 1e6);
    std::size_t leaves = 0;
    std::int64_t bytes = 0;
    for (const VoxelBlock& b : grid.blocks) {
        leaves += b.leaves.size();
        bytes += b.byte_count();
    }
    const auto voxels = static_cast<double>(grid.about.voxel_count);
    std::printf("%.2f M voxels, %.2f M leaves, fill %.2f, source %.1f MiB, peak %.1f MiB\n",
                voxels * 1e-6, static_cast<double>(leaves) * 1e-6,
                voxels / 512.0 / static_cast<double>(leaves),
                static_cast<double>(bytes) / 1048576.0,
                static_cast<double>(peak_resident_bytes()) / 1048576.0);
    Progress progress;
    double t = now();
    write_vdb(grid, path, progress);
    const auto size = static_cast<double>(std::filesystem::file_size(path));
    std::printf("write %.2f s, %.2f bytes a voxel, peak %.1f MiB\n", now() - t, size / voxels,
                static_cast<double>(peak_resident_bytes()) / 1048576.0);
    const VdbBytes predicted = predict_vdb_bytes(static_cast<std::int64_t>(leaves),
                                                 grid.about.voxel_count, grid.about.lobe_count, {});
    std::printf("predicted: %.2f bytes a voxel, memory %.1f MiB over the source\n",
                static_cast<double>(predicted.file) / voxels,
                static_cast<double>(predicted.memory) / 1048576.0);
    t = now();
    const std::string hash = content_hash(path);
    std::printf("content_hash %s in %.2f s\n", hash.c_str(), now() - t);
    t = now();
    const bool same = read_vdb(path)->about.voxel_count == grid.about.voxel_count;
    std::printf("read %.2f s (%s), peak %.1f MiB\n", now() - t, same ? "same count" : "WRONG",
                static_cast<double>(peak_resident_bytes()) / 1048576.0);
}

} // namespace
} // namespace heddle

int main(int argc, char** argv) {
    try {
        heddle::run(argc > 1 ? std::atof(argv[1]) : 5.0, argc > 2 ? argv[2] : "bench.vdb");
    } catch (const heddle::Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
