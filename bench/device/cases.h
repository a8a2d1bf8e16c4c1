#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/voxelize/voxelize.h>

#include <string>
#include <vector>

// Inputs on which the device pipeline is compared: made by our own generators, so that a bare
// machine needs no data.

namespace heddle::check {

/// One voxelization.
struct Case {
    std::string name;
    Geometry geometry;
    VoxelizeOptions options;
    std::int64_t batches = 1;
};

/// Every generator, three yarn models, flyaways, non-cubic voxels, a region, 1, 8 and 64 batches.
[[nodiscard]] std::vector<Case> parity_cases();

/// The smallest of them, for compute-sanitizer.
[[nodiscard]] std::vector<Case> small_cases();

/// Cloth with about this number of fiber nodes.                            [Fabre26, table 3]
/// @param nodes    nodes of all yarns x fibers per yarn
/// @param fibers   fibers per yarn
[[nodiscard]] Geometry cloth(const std::string& shape, double nodes, int fibers);

/// A round body with waves and about this number of triangles, without maps.
[[nodiscard]] Geometry body(int triangles);

} // namespace heddle::check
