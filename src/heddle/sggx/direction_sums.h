#pragma once

#include <cstdint>

namespace heddle {

/// The exact second moment of the directions that were pooled into a lobe, with material and kind.
struct DirectionSums {
    std::int64_t moment[6]{};   ///< sum of weight x d d^T: xx yy zz xy xz yz
    std::int64_t weight = 0;    ///< sum of weights; > 0 for a lobe that exists
    std::uint32_t material = 0; ///< id
    bool normals = false;       ///< directions are normals of a surface; else tangents of fibers
    friend bool operator==(const DirectionSums&, const DirectionSums&) = default;
};

} // namespace heddle
