#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/io/curve/curve_files.h>

#include <string>

namespace heddle {

/// Reads curves or meshes with the reader for the suffix. The notes tell what was assumed.
/// @param options  for curve files; others ignore it
/// @throws Error  as the readers; Unsupported: there is no reader for the suffix
[[nodiscard]] Geometry read_geometry(const std::string& path, const CurveReadOptions& options = {});

} // namespace heddle
