#pragma once

// Includes the main headers of all rooms. A program that needs only one room includes that room's
// headers instead.

// The core.
#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/base/progress.h>
#include <heddle/device/voxelize_device.h>
#include <heddle/geom/generate.h>
#include <heddle/geom/geometry.h>
#include <heddle/lod/build_levels.h>
#include <heddle/lod/rebuild_levels.h>
#include <heddle/sggx/pack.h>
#include <heddle/sggx/sggx.h>
#include <heddle/voxel/leaf_voxels.h>
#include <heddle/voxel/voxel_level.h>
#include <heddle/voxelize/voxelize.h>

// The rooms above the core: files and pictures. An install of the core alone does not have them.
#if __has_include(<heddle/io/vdb/write_vdb.h>)
#include <heddle/io/geometry/apply_yarn.h>
#include <heddle/io/geometry/read_geometry.h>
#include <heddle/io/gltf/write_glb.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/job/edit_materials.h>
#include <heddle/job/generate_geometry.h>
#include <heddle/job/inspect_file.h>
#include <heddle/job/level/measure_levels.h>
#include <heddle/job/level/rebuild_levels.h>
#include <heddle/job/render/export_volume.h>
#include <heddle/job/render/preview_volume.h>
#include <heddle/job/render/render_scene.h>
#include <heddle/job/slice_yarn.h>
#include <heddle/job/voxelize/voxelize_frames.h>
#include <heddle/job/voxelize/voxelize_vol.h>
#include <heddle/preview/preview.h>
#include <heddle/stage/render_job.h>
#endif
