#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/material.h>

#include <string>
#include <vector>

namespace heddle {

/// Writes a .vdb of Heddle's again with other materials. No grid is decoded: all bytes but the
/// materials' metadata are copied, and the grids' places in the file moved by what that grew, so
/// content_hash stays. Memory: a few MiB.
/// @param path       a file that read_infos takes
/// @param materials  as many as it has, by material id; texture indices are not kept
/// @param output     replaced when the new file is whole (see OutputFile); may be `path`
/// @throws Error     as read_infos; InvalidArgument: another number of materials; CannotWrite;
///                   Cancelled. The old file then stays.
void replace_materials(const std::string& path,
                       const std::vector<Material>& materials,
                       const std::string& output,
                       Progress& progress);

} // namespace heddle
