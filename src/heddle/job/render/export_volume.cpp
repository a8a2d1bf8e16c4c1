#include <heddle/job/render/export_volume.h>

#include <heddle/base/memory.h>
#include <heddle/flake/flake_field.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/job/option_error.h>
#include <heddle/job/phase_clock.h>
#include <heddle/job/write_output.h>

namespace heddle::job {
namespace {

void check_export_options(const ExportOptions& o) {
    if (o.to == ExportFormat::Mitsuba06) {
        if (o.pad)
            throw OptionError("`pad` cannot be used with `to` mitsuba06, whose blocks are sparse");
        if (o.block_samples == 1) {
            throw OptionError(
                "`block_samples`: neighbouring blocks share a layer of samples, so the minimum is 2; 0 = a single block");
        }
        return;
    }
    if (o.stddev) throw OptionError("`stddev` needs `to` mitsuba06");
    if (o.block_samples) {
        throw OptionError("`block_samples` needs `to` mitsuba06");
    }
    if (o.pad && !(*o.pad >= 1.0)) {
        throw OptionError(str("`pad` is ", *o.pad, "; it must be >= 1"));
    }
}

void write_blocks(const VoxelLevel& voxels,
                  const std::string& folder,
                  const ExportOptions& options,
                  ExportReport& report,
                  Progress& progress) {
    const Mitsuba06Options asked{.stddev = options.stddev.value_or(0.3),
                                 .block_samples = options.block_samples.value_or(64)};
    write_output([&] { report.files = write_mitsuba06(voxels, folder, asked, progress); });
    if (report.files->no_fiber == 0) return;
    take_notes(report.notes,
               {str(report.files->no_fiber,
                    " voxels hold only surfaces and are written without a direction")},
               progress);
}

void write_grids(const FlakeField& field,
                 const std::string& folder,
                 const ExportOptions& options,
                 ExportReport& report,
                 Progress& progress) {
    report.box = plan_mitsuba(field, options.pad.value_or(1.0));
    write_output([&] { write_mitsuba(field, *report.box, folder, progress); });
}

FlakeField field_of(const VoxelLevel& voxels) {
    std::vector<Vec3f> albedo;
    for (const Material& material : voxels.info().materials) albedo.push_back(material.albedo);
    return {voxels, albedo};
}

void finish_report(ExportReport& report, PhaseClock& clock) {
    clock.finish();
    report.seconds = clock.seconds();
    report.peak_bytes = peak_resident_bytes();
}

} // namespace

ExportReport export_volume(const VoxelLevel& voxels,
                           const std::string& folder,
                           const ExportOptions& options,
                           Progress& progress) {
    PhaseClock clock(progress);
    check_export_options(options);
    ExportReport report;
    clock.check();
    if (options.to == ExportFormat::Mitsuba06)
        write_blocks(voxels, folder, options, report, clock);
    else
        write_grids(field_of(voxels), folder, options, report, clock);
    finish_report(report, clock);
    return report;
}

ExportReport export_volume(const std::string& path,
                           const std::string& folder,
                           const ExportOptions& options,
                           Progress& progress) {
    PhaseClock clock(progress);
    check_export_options(options);
    clock.begin("read", "files", 1);
    std::unique_ptr<MemoryLevel> grid = read_vdb(path, options.level);
    ExportReport report;
    if (options.to == ExportFormat::Mitsuba06) {
        write_blocks(*grid, folder, options, report, clock);
    } else {
        if (grid->info().voxel_count == 0) {
            throw Error(ErrorCode::BadFile, "holds no voxels", "export a volume that has voxels",
                        {.path = path});
        }
        const FlakeField field = field_of(*grid);
        grid.reset(); // the field holds its own copy of the data
        clock.check();
        write_grids(field, folder, options, report, clock);
    }
    finish_report(report, clock);
    return report;
}

} // namespace heddle::job
