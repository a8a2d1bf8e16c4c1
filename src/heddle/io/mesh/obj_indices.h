#pragma once

#include <tiny_obj_loader.h>
#include <filesystem>
#include <vector>

namespace heddle {

/// Checks that what the parser made of faces and lines names vertices, uv and normals that there are.
/// The text was checked before (read_obj_text); where the parser understood it otherwise, this ends it.
/// @param path  for the message
/// @throws BadFile
void check_obj_indices(const tinyobj::attrib_t& attrib,
                       const std::vector<tinyobj::shape_t>& shapes,
                       const std::filesystem::path& path);

} // namespace heddle
