#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxel/voxel_level.h>

#include <string>

namespace heddle {

/// Writes an object's levels as one .vdb: the grids that docs/format.md lists, level by level.
///
/// No tree is built: masks are kept in memory (88 bytes per leaf), values are encoded leaf by leaf
/// from the source's blocks on all threads and written in the order of a tree. A source is visited
/// once to count, once per grid, and once more per lobe and grid that lack some voxels. The bytes
/// of a grid depend on neither thread count nor block size; the file's UUID is random.
/// @param levels  finest first, at least one and at most 28
/// @param path    replaced when the file is complete (see OutputFile)
/// @throws Error  NotFound: the folder does not exist; CannotWrite: it is not writable, or the disk
///                is full; Cancelled; Internal: levels out of order or off their lattice, or a
///                block whose arrays do not fit its fields. The old file then stays and no partial
///                file is left.
void write_vdb(const VoxelLevels& levels, const std::string& path, Progress& progress);

/// The same for an object of one level.
/// @param source  level 0
void write_vdb(const VoxelLevel& source, const std::string& path, Progress& progress);

} // namespace heddle
