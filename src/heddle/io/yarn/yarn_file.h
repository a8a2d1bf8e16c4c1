#pragma once

#include <heddle/geom/yarn.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace heddle {

/// A yarn, and what had to be assumed about it, one sentence each, to show to the user.
struct YarnFile {
    YarnType yarn;
    std::vector<std::string> notes;
};

/// Loads the RGBA image of a slice from a path; throws its own Error.
using LoadTexture = std::function<Texture(const std::string& path)>;

/// Default fraction of a ply's section that is filled by fibers, used if a file gives no fiber
/// radius: as in a staple yarn of ordinary twist; loose yarns have less, tight ones up to 0.6.
inline constexpr float kDefaultFill = 0.45f;

/// Reads a yarn: the name of a preset, a fit of Zhao 2016 (`.txt`), or Heddle's format (`.toml`).
///
/// Fits have no fiber radius, and a TOML file may omit it. It is then chosen so that the fibers
/// fill `kDefaultFill` of a ply's section, r = sqrt(fill ellipse_long ellipse_short /
/// fibers_per_ply), or the area that the alpha of a slice gives; a note says so. The sampling
/// settings of a fit (aabb_*, z_step_*, fly_step_size) are read and ignored.
/// @param preset_or_path  one of `list_presets()`, or a path that ends in .txt or .toml
/// @param load_texture    loads the image of a slice yarn; its path is relative to the TOML file;
///                        may be empty, then a slice yarn is an error
/// @throws NotFound: no such preset or file; BadFile with path and line: a text that cannot be
///         read, a key that is unknown, missing or given twice, a value out of range; all at once
[[nodiscard]] YarnFile read_yarn(const std::string& preset_or_path,
                                 const LoadTexture& load_texture = {});

/// Reads Heddle's TOML format from memory.
/// @param path  for messages; the path of a slice is relative to it
/// @throws as `read_yarn`
[[nodiscard]] YarnFile
parse_yarn_toml(const std::string& text, const std::string& path, const LoadTexture& load = {});

/// Reads the text of a fit of Zhao 2016, "Fitting procedural yarn models": lines of `key: value`.
/// @param path  for messages; its stem becomes the yarn's name
/// @throws as `read_yarn`
[[nodiscard]] YarnFile parse_yarn_fit(const std::string& text, const std::string& path);

/// The yarn in Heddle's TOML format: reading it returns every number of its model bit for bit. The
/// image of a slice is written as its name.
[[nodiscard]] std::string write_yarn_toml(const YarnType& yarn);

/// Names of the built-in yarns, ascending: "cotton", "silk", "wool".
[[nodiscard]] std::vector<std::string> list_presets();

/// Makes `total` the number of fibers of the whole yarn, spread evenly over its plies, and scales
/// the radius of the fibers so that they fill the same area as before.
/// @param total  in [1, 10^6]; 1 for a solid yarn
/// @return  a note if `total` was rounded to a multiple of the number of plies, else empty
/// @throws InvalidArgument: `total` is out of range
std::string set_fiber_count(YarnType& yarn, std::int64_t total);

} // namespace heddle
