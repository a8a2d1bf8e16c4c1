#pragma once

#include <heddle/cli/terminal/report.h>
#include <heddle/job/inspect_file.h>

#include <vector>

namespace heddle::cli {

/// Adds rows for curves and meshes, and for the work of voxelizing them.
void report_geometry(Report& report, const job::GeometryInfo& info);

/// Adds rows for a .vdb that Heddle wrote.
void report_volume(Report& report, const job::VolumeInfo& volume);

/// Adds a row with the names and kinds of materials.
void report_material_names(Report& report, const std::vector<Material>& materials);

} // namespace heddle::cli
