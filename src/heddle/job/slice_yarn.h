#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/yarn.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// How the cross-section of a yarn is drawn as an image. Nothing is required.
struct SliceYarnOptions {
    std::int32_t size = 256;              ///< texels along each side, 1 to 4096
    std::optional<std::int64_t> fibers{}; ///< fibers in the yarn; none: those of the yarn file
    std::uint64_t seed = 0;               ///< of the fibers' random positions
};

/// A yarn of the model Slice.
struct SlicedYarn {
    YarnType yarn{};
    std::vector<std::string> notes{}; ///< what was assumed or left out
};

/// Paths of a slice image and the files that belong to it.
struct SliceFiles {
    std::string image{};                    ///< .png: albedo in RGB, coverage by fibers in alpha
    std::optional<std::string> yarn_file{}; ///< .toml: the yarn type that uses the image
    std::optional<std::string> occlusion{}; ///< .png: ambient light that reaches each texel
    std::optional<std::string> mipmaps{};   ///< .png: all mipmap levels side by side
};

/// Draws the cross-section of a procedural yarn as an image.
/// @param yarn    preset, or path of a yarn file
/// @throws Error  as read_yarn, set_fiber_count and make_slice; Cancelled
[[nodiscard]] SlicedYarn
slice_yarn(const std::string& yarn, const SliceYarnOptions& options, Progress& progress);

/// Returns an image of all mipmap levels of a slice side by side, the largest first.
[[nodiscard]] Texture mipmap_sheet(const Texture& slice);

/// Draws the cross-section of a yarn and writes the files.
/// @throws OptionError  a path has another suffix
/// @throws Error        as slice_yarn; CannotWrite
SlicedYarn slice_yarn_to_files(const std::string& yarn,
                               const SliceFiles& files,
                               const SliceYarnOptions& options,
                               Progress& progress);

} // namespace heddle::job
