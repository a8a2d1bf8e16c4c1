#pragma once

#include <tiny_obj_loader.h>
#include <filesystem>
#include <vector>

namespace heddle {

/// Checks that the parser's faces and lines use existing vertices, uv and normals. The text was
/// checked before (read_obj_text); this catches what the parser understood differently.
/// @param path  for messages
/// @param path  for the message
/// @throws BadFile
void check_obj_indices(const tinyobj::attrib_t& attrib,
                       const std::vector<tinyobj::shape_t>& shapes,
                       const std::filesystem::path& path);

} // namespace heddle
