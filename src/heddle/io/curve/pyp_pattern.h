#pragma once

#include <heddle/base/vec.h>

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// A step from a vertex to the next one along its yarn, which may be in a neighbouring tile.
struct PypStep {
    std::int64_t vertex = -1; ///< -1: the yarn ends here
    std::int64_t dx = 0;      ///< in tiles
    std::int64_t dy = 0;
};

/// A periodic yarn pattern: the contents of one tile of a .pyp file.
struct PypPattern {
    double px = 0.0; ///< period along x, scene units
    double py = 0.0;
    float radius = 0.0f; ///< scene units; <= 0: the file gives none
    std::vector<Vec3f> vertices;
    std::vector<PypStep> next;                 ///< per vertex
    std::vector<PypStep> previous;             ///< per vertex, the same edges in reverse
    std::vector<std::string> unknown_sections; ///< names of the sections that were skipped
};

/// Parses a .pyp file: sections *pattern, *Q (vertices x y z twist) and *E (edges v0 v1 dx dy).
///
/// The twist and the sections RL, RK, RT, RefD1 and RefT (simulation state) are ignored.
/// @throws Error  as read_pyp, with the line
[[nodiscard]] PypPattern parse_pyp_pattern(const std::string& path);

} // namespace heddle
