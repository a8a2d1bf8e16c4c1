#pragma once

#include <heddle/render/path.h>
#include <heddle/scene/scene.h>

#include <cstdint>

namespace heddle {

/// Returns a hash of all inputs on which a picture's samples depend: the contents of the scene,
/// sizes and times of the files that it names, and the options. The film and the number of samples
/// are left out, so that a checkpoint can be continued with more samples.
/// @param geometry  StageOptions::geometry
[[nodiscard]] std::uint64_t
hash_of_scene(const Scene& scene, const PathOptions& options, bool geometry);

} // namespace heddle
