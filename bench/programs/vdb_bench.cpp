#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/predict_vdb.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/voxel/test_grid.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>

// heddle_vdb_bench MILLION_VOXELS [OUT.vdb]: seconds and bytes of writing and reading voxels like
// those of cloth: a sheet of leaves, 35 % of each active, with fiber directions that vary slowly.

namespace heddle {
namespace {

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

void run(double million, const std::string& path) {
    const MemoryLevel grid = testing::make_cloth(million * 1e6);
    std::size_t leaves = 0;
    std::int64_t bytes = 0;
    for (const VoxelBlock& b : grid.blocks) {
        leaves += b.leaves.size();
        bytes += b.byte_count();
    }
    const auto voxels = static_cast<double>(grid.info().voxel_count);
    std::printf("%.2f M voxels, %.2f M leaves, fill %.2f, source %.1f MiB, peak %.1f MiB\n",
                voxels * 1e-6, static_cast<double>(leaves) * 1e-6,
                voxels / 512.0 / static_cast<double>(leaves),
                static_cast<double>(bytes) / 1048576.0,
                static_cast<double>(peak_resident_bytes()) / 1048576.0);
    Progress progress;
    double t = now();
    const std::clock_t work = std::clock();
    write_vdb(grid, path, progress);
    const auto size = static_cast<double>(std::filesystem::file_size(path));
    std::printf("write %.2f s (%.2f s of CPU), %.2f bytes a voxel, peak %.1f MiB\n", now() - t,
                static_cast<double>(std::clock() - work) / CLOCKS_PER_SEC, size / voxels,
                static_cast<double>(peak_resident_bytes()) / 1048576.0);
    const VdbBytes predicted = predict_vdb_bytes(
        static_cast<std::int64_t>(leaves), grid.info().voxel_count, grid.info().lobe_count, {});
    std::printf("predicted: %.2f bytes a voxel, memory %.1f MiB over the source\n",
                static_cast<double>(predicted.file) / voxels,
                static_cast<double>(predicted.memory) / 1048576.0);
    t = now();
    const std::string hash = content_hash(path);
    std::printf("content_hash %s in %.2f s\n", hash.c_str(), now() - t);
    t = now();
    const bool same = read_vdb(path)->info().voxel_count == grid.info().voxel_count;
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
