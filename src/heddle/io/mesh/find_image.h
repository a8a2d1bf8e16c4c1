#pragma once

#include <heddle/geom/texture.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace heddle {

/// Finds and reads the image that a mesh file in `folder` calls `name`: at the given path, else by
/// its file name beside the mesh, else in both with another suffix of an image (.png .jpg .jpeg).
///
/// Notes say if it was found elsewhere, or not found, or cannot be read. A grey image becomes RGB
/// (with alpha: RGBA), so that every map has the channels of glTF.
/// @return nothing if there is no such image or it cannot be read
[[nodiscard]] std::optional<Texture> find_image(const std::filesystem::path& folder,
                                                const std::string& name,
                                                std::vector<std::string>& notes);

/// Repeats a grey channel three times: 1 channel becomes 3, 2 become 4.
void widen_grey(Texture& image);

} // namespace heddle
