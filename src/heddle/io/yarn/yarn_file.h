#pragma once

#include <heddle/geom/yarn.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace heddle {

/// A yarn and what had to be assumed about it, one sentence each, for the user to see.
struct YarnFile {
    YarnType yarn;
    std::vector<std::string> notes;
};

/// Loads a slice's RGBA image from a path; throws an Error of its own.
using LoadTexture = std::function<Texture(const std::string& path)>;

/// Fraction of a ply's section that fibers fill where a file names no fiber radius: as in a staple
/// yarn of ordinary twist; loose ones have less, tight ones up to 0.6.
inline constexpr float kDefaultFill = 0.45f;

/// Reads a yarn: a preset's name, a fit of Zhao 2016 (`.txt`), or Heddle's own form (`.toml`).
///
/// Fits name no fiber radius, and a TOML file may leave it out: it is then chosen so that the
/// fibers fill `kDefaultFill` of a ply's section, r = sqrt(fill ellipse_long ellipse_short /
/// fibers_per_ply), or what a slice's alpha says, and a note tells. A fit's sampling settings
/// (aabb_*, z_step_*, fly_step_size) are read and ignored.
/// @param preset_or_path  one of `list_presets()`, or a path that ends in .txt or .toml
/// @param load_texture    for the image of a slice yarn, called with its path taken relative to the
///                        TOML file; may be empty, then a slice yarn is an error
/// @throws NotFound: no such preset or file; BadFile with path and line: what cannot be read, a key
///         that is unknown, missing or given twice, a value out of range; all problems in one text
[[nodiscard]] YarnFile read_yarn(const std::string& preset_or_path,
                                 const LoadTexture& load_texture = {});

/// Reads Heddle's TOML form from memory.
/// @param path  for messages, and the place that the slice's path is relative to
/// @throws as `read_yarn`
[[nodiscard]] YarnFile
parse_yarn_toml(const std::string& text, const std::string& path, const LoadTexture& load = {});

/// Reads the text of a fit of Zhao 2016, "Fitting procedural yarn models": lines `key: value`.
/// @param path  for messages; its stem becomes the yarn's name
/// @throws as `read_yarn`
[[nodiscard]] YarnFile parse_yarn_fit(const std::string& text, const std::string& path);

/// The yarn in Heddle's TOML form: reading it gives every number of its model back, bit for bit. A
/// slice's image is written as its name.
[[nodiscard]] std::string write_yarn_toml(const YarnType& yarn);

/// Names of the built-in yarns, ascending: "cotton", "silk", "wool".
[[nodiscard]] std::vector<std::string> list_presets();

/// Makes `total` the fibers of the whole yarn, spread evenly over its plies, and scales the fibers'
/// radius so that they fill the yarn as before.
/// @param total  in [1, 10^6]; 1 for a solid yarn
/// @return  a note where `total` is not a multiple of the plies and was rounded to one, else empty
/// @throws InvalidArgument: `total` out of range
std::string set_fiber_count(YarnType& yarn, std::int64_t total);

} // namespace heddle
