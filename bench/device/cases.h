#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/voxelize/voxelize.h>

#include <string>
#include <vector>

// What the pipeline of the device is compared on: made by our own generators, so that a bare machine
// needs no data.

namespace heddle::check {

/// One voxelization.
struct Case {
    std::string name;
    Geometry geometry;
    VoxelizeOptions options;
    std::int64_t batches = 1;
};

/// Every generator, three yarn models, flyaways, voxels that are no cubes, a region, 1, 8 and 64 batches.
[[nodiscard]] std::vector<Case> parity_cases();

/// The smallest of them, for compute-sanitizer.
[[nodiscard]] std::vector<Case> small_cases();

/// Cloth of about so many nodes of fibers.                                [Fabre26, table 3]
/// @param nodes    of yarn x fibers of a yarn
/// @param fibers   of a yarn
[[nodiscard]] Geometry cloth(const std::string& shape, double nodes, int fibers);

/// A round body with waves, of about so many triangles, without maps.
[[nodiscard]] Geometry body(int triangles);

} // namespace heddle::check
