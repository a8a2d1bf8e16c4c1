#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/io/curve/curve_files.h>

#include <string>

namespace heddle {

/// Reads curves or meshes: the reader is chosen by the suffix. What was assumed is in the notes.
/// @param options  of curve files; others ignore it
/// @throws Error  as the readers; Unsupported: no reader for the suffix
[[nodiscard]] Geometry read_geometry(const std::string& path, const CurveReadOptions& options = {});

} // namespace heddle
