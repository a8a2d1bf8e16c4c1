#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxel/voxel_grid.h>

#include <string>

namespace heddle {

/// Writes the voxels of one object as a .vdb: the grids that docs/format.md lists, level 0.
///
/// No tree is built: masks are kept (88 bytes a leaf), values are encoded leaf by leaf from the
/// source's blocks on all threads and written in the order in which a tree would write them. The
/// source is walked once to count, once per grid, and once more per grid that lacks some voxels.
/// The bytes of a grid depend on neither thread count nor block size; the file's UUID is random.
/// @param path    replaced when the file is whole (see OutputFile)
/// @throws Error  NotFound: the folder is not there; CannotWrite: it cannot be written to, or the
///                disk is full; Cancelled. The old file stays and nothing half-written is left.
void write_vdb(const VoxelSource& source, const std::string& path, Progress& progress);

} // namespace heddle
