#pragma once

#include <heddle/geom/texture.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace heddle {

/// The image that a mesh file in `folder` calls `name`: the file as named; else of that file name
/// beside the mesh; else, in both places, of the same stem with another suffix (.png .jpg .jpeg).
///
/// What was found elsewhere, or not found, or broken, is said in `notes`. A grey image becomes RGB
/// (with alpha: RGBA), so that every map has the channels that glTF speaks of.
/// @return nothing where there is no such image or it cannot be read
[[nodiscard]] std::optional<Texture> find_image(const std::filesystem::path& folder,
                                                const std::string& name,
                                                std::vector<std::string>& notes);

/// Repeats a grey channel three times: 1 channel becomes 3, 2 become 4.
void widen_grey(Texture& image);

} // namespace heddle
