#include <heddle/job/render/preview_volume.h>

#include <heddle/io/image/image.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/job/write_output.h>

namespace heddle::job {
namespace {

PreviewImage draw(const std::string& path,
                  int level,
                  const PreviewOptions& options,
                  std::int64_t& voxels,
                  Progress& progress) {
    progress.begin("read", "files", 1);
    const std::unique_ptr<MemoryLevel> grid = read_vdb(path, level);
    progress.check();
    voxels = grid->info().voxel_count;
    return render_preview(*grid, options, progress);
}

} // namespace

PreviewImage preview_volume(const std::string& path,
                            int level,
                            const PreviewOptions& options,
                            Progress& progress) {
    std::int64_t voxels = 0;
    return draw(path, level, options, voxels, progress);
}

PreviewReport preview_volume_to_file(const std::string& path,
                                     const std::string& output,
                                     int level,
                                     const PreviewOptions& options,
                                     Progress& progress) {
    PhaseClock clock(progress);
    check_output(output, ".png");
    PreviewReport report;
    const PreviewImage image = draw(path, level, options, report.voxels, clock);
    clock.begin("write", "files", 1);
    write_output([&] { write_png(output, image.width, image.height, 4, image.rgba); });
    clock.finish();
    report.width = image.width;
    report.height = image.height;
    report.phases = clock.phases();
    return report;
}

} // namespace heddle::job
