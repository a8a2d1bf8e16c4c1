#pragma once

#include <heddle/render/path.h>
#include <heddle/scene/scene.h>

#include <cstdint>

namespace heddle {

/// Names all that a picture's samples depend on: what the scene says, whichever files said it;
/// sizes and times of the files that it names; the options. Neither film nor samples: a checkpoint
/// may go on to more of them.
/// @param geometry  StageOptions::geometry
[[nodiscard]] std::uint64_t
hash_of_scene(const Scene& scene, const PathOptions& options, bool geometry);

} // namespace heddle
