#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/material.h>

#include <string>
#include <vector>

namespace heddle {

/// Rewrites a .vdb of Heddle with other materials. No grid is decoded: all bytes except the
/// materials' metadata are copied, and the offsets of the grids in the file are adjusted, so
/// content_hash stays the same. Memory: a few MiB.
/// @param path       a file that read_infos accepts
/// @param materials  as many as the file has, by material id; texture indices are not stored
/// @param output     replaced when the new file is complete (see OutputFile); may be `path`
/// @throws Error     as read_infos; InvalidArgument: another number of materials; CannotWrite;
///                   Cancelled. The old file then stays.
void replace_materials(const std::string& path,
                       const std::vector<Material>& materials,
                       const std::string& output,
                       Progress& progress);

} // namespace heddle
