#pragma once

#include <cstdint>

namespace heddle {

/// Directions of one material that were pooled: integers, so that no order of adding shows.
struct DirectionSums {
    std::int64_t moment[6]{}; ///< sum of weight x d d^T: xx yy zz xy xz yz; its trace is the weight
    std::int64_t weight = 0;
    std::uint32_t material = 0;
    bool normals = false; ///< directions are normals (a surface's), else tangents (a fiber's)
};

} // namespace heddle
