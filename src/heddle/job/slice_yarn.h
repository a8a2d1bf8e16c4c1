#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/yarn.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// How a yarn's section becomes an image. Nothing is required.
struct SliceYarnOptions {
    std::int32_t size = 256;              ///< texels along each side, 1 to 4096
    std::optional<std::int64_t> fibers{}; ///< in all of the yarn; none: what the model says
    std::uint64_t seed = 0;               ///< of the fibers' places
};

/// A yarn of the model Slice, and what was assumed or left out.
struct SlicedYarn {
    YarnType yarn{};
    std::vector<std::string> notes{};
};

/// Where a slice and what belongs to it go.
struct SliceFiles {
    std::string image{};                    ///< .png: RGB albedo, alpha the fibers' share
    std::optional<std::string> yarn_file{}; ///< .toml: the yarn of that slice
    std::optional<std::string> occlusion{}; ///< .png: how much light from around reaches each texel
    std::optional<std::string> mipmaps{};   ///< .png: the sizes below side by side
};

/// The section of a procedural yarn as an image.
/// @param yarn    preset, or path of a yarn file
/// @throws Error  as read_yarn, set_fiber_count and make_slice; Cancelled
[[nodiscard]] SlicedYarn
slice_yarn(const std::string& yarn, const SliceYarnOptions& options, Progress& progress);

/// All sizes of a slice side by side, the largest first.
[[nodiscard]] Texture mipmap_sheet(const Texture& slice);

/// The same into files.
/// @throws OptionError  a path of another suffix
/// @throws Error        as slice_yarn; CannotWrite
SlicedYarn slice_yarn_to_files(const std::string& yarn,
                               const SliceFiles& files,
                               const SliceYarnOptions& options,
                               Progress& progress);

} // namespace heddle::job
