#pragma once

#include <heddle/base/progress.h>
#include <heddle/render/camera.h>
#include <heddle/render/path.h>
#include <heddle/render/picture.h>

#include <cstdint>

namespace heddle {

/// Adds samples to every pixel, on all threads, until each has `samples`.
///
/// Each sample depends only on the seed, the pixel and its number, so a picture that is rendered in
/// passes, resumed, or on any number of threads has the same bits.
/// @param samples  per pixel, in total
/// @throws Error   Cancelled: the picture then holds no sample of the unfinished pass
void render_pass(const PathScene& scene,
                 const Camera& camera,
                 const PathOptions& options,
                 std::uint64_t seed,
                 std::uint32_t samples,
                 Picture& picture,
                 Progress& progress);

} // namespace heddle
