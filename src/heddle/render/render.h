#pragma once

#include <heddle/base/progress.h>
#include <heddle/render/camera.h>
#include <heddle/render/path.h>
#include <heddle/render/picture.h>

#include <cstdint>

namespace heddle {

/// Adds samples [picture's, samples) to every pixel, on all threads.
///
/// A pixel's samples are the same whatever came before them: a picture made in passes, resumed, or
/// on any number of threads has the same bits.
/// @param samples  per pixel, in all
/// @throws Error   Cancelled: the picture then holds no sample of the unfinished pass
void render_pass(const PathScene& scene,
                 const Camera& camera,
                 const PathOptions& options,
                 std::uint64_t seed,
                 std::uint32_t samples,
                 Picture& picture,
                 Progress& progress);

} // namespace heddle
