#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/preview/preview.h>
#include <heddle/voxel/test_grid.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

// heddle_preview_bench helix|MILLION_VOXELS OUT.ppm [COLOR 0-4] [FROM x y z] [FOV]: prints seconds
// and bytes, and writes a picture.

namespace heddle {
namespace {

void run(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "helix";
    const MemoryLevel grid = what == "helix" ? testing::make_helix()
                                             : testing::make_cloth(std::atof(what.c_str()) * 1e6);
    PreviewOptions options;
    if (argc > 3) options.color = static_cast<PreviewColor>(std::atoi(argv[3]));
    if (argc > 6) options.from = Vec3d{std::atof(argv[4]), std::atof(argv[5]), std::atof(argv[6])};
    if (argc > 7) options.field_of_view = std::atof(argv[7]);
    const double before = static_cast<double>(peak_resident_bytes());
    const auto start = std::chrono::steady_clock::now();
    Progress progress;
    const PreviewImage image = render_preview(grid, options, progress);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    std::printf("%.2f M voxels: %.2f s, %.1f MiB over the voxels\n",
                static_cast<double>(grid.info().voxel_count) * 1e-6, time.count(),
                (static_cast<double>(peak_resident_bytes()) - before) / 1048576.0);
    if (argc < 3) return;
    std::ofstream out(argv[2], std::ios::binary);
    out << "P6\n" << image.width << ' ' << image.height << "\n255\n";
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        out.write(reinterpret_cast<const char*>(image.rgba.data() + i), 3);
    }
}

} // namespace
} // namespace heddle

int main(int argc, char** argv) {
    try {
        heddle::run(argc, argv);
    } catch (const heddle::Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
