#include <heddle/job/voxelize/voxelize_options.h>

#include <heddle/job/levels.h>
#include <heddle/job/option_error.h>

namespace heddle::job {
namespace {

void refuse(bool wrong, const char* sentence) {
    if (wrong) throw OptionError(sentence);
}

void check_backend(const VoxelizeJobOptions& o) {
    if (o.backend == Backend::Raster) {
        refuse(o.device == DeviceChoice::Cuda,
               "`device` cuda cannot be used with `backend` raster");
        refuse(o.device_memory_bytes.has_value(),
               "`device_memory` cannot be used with `backend` raster");
        refuse(o.fit == FitMode::Last, "`fit` last cannot be used with `backend` raster");
        return;
    }
    refuse(o.composition.has_value(), "`composition` needs `backend` raster");
    refuse(o.slice_spacing.has_value(), "`slice_spacing` needs `backend` raster");
    refuse(o.raster_path.has_value(), "`raster_path` needs `backend` raster");
    refuse(o.device == DeviceChoice::Cpu && o.device_memory_bytes,
           "`device_memory` cannot be used with `device` cpu");
}

} // namespace

void check_voxelize_options(const VoxelizeJobOptions& o) {
    refuse(o.voxel_size && o.voxels,
           "`voxel_size` and `voxels` both set the resolution; give one of them");
    refuse(o.fill_memory && (o.voxels || o.voxel_size),
           "`fill_memory` chooses the resolution; leave out `voxels` and `voxel_size`");
    refuse(o.bounds && o.bounds->empty(),
           "`bounds`: the first corner must be the lower one on every axis");
    refuse(o.samples > 0 && o.coverage != CoverageMode::Mask,
           "`samples` needs `coverage` mask; columns are computed without random samples");
    refuse(
        o.lod == LodMethod::Naive && (o.footprints != 0 || o.correlation),
        "`footprints` and `correlation` cannot be used with `lod` naive, which averages coverage");
    refuse(o.memory_bytes && *o.memory_bytes <= 0, "`memory` must be above 0");
    refuse(o.device_memory_bytes && *o.device_memory_bytes <= 0, "`device_memory` must be above 0");
    refuse(o.slice_spacing && !(*o.slice_spacing > 0.0), "`slice_spacing` must be above 0");
    (void)lod_options(o.lod, o.levels, o.seed);
    check_backend(o);
}

VoxelizeOptions voxelizer_options(const VoxelizeJobOptions& o) {
    check_voxelize_options(o);
    VoxelizeOptions options;
    options.voxel_size = o.voxel_size.value_or(Vec3d{});
    options.voxels = o.voxels.value_or(512);
    options.bounds = o.bounds;
    options.subvoxels = o.subvoxels;
    options.max_lobes = o.lobes;
    options.coverage = o.coverage;
    options.fit = o.fit;
    options.footprints = o.footprints;
    options.occupancy = o.occupancy;
    options.correlation = o.correlation;
    options.samples = o.samples;
    options.keep_sums = o.keep_masks;
    options.memory_bytes = o.memory_bytes.value_or(0);
    options.seed = o.seed;
    options.spool_dir = o.spool_dir.value_or(".");
    options.command = o.command;
    return options;
}

raster::RasterOptions raster_options(const VoxelizeJobOptions& o) {
    return {.composition = o.composition.value_or(raster::Composition::Accumulate),
            .slice_spacing = o.slice_spacing.value_or(0.0),
            .path = o.raster_path.value_or(raster::RasterPath::Auto)};
}

} // namespace heddle::job
