#pragma once

#include <heddle/cli/terminal/report.h>
#include <heddle/job/inspect_file.h>

#include <vector>

namespace heddle::cli {

/// Rows on curves and meshes, and on what voxelizing them would take.
void report_geometry(Report& report, const job::GeometryInfo& info);

/// Rows on a .vdb of Heddle's.
void report_volume(Report& report, const job::VolumeInfo& volume);

/// A row on materials in short.
void report_material_names(Report& report, const std::vector<Material>& materials);

} // namespace heddle::cli
