#pragma once

#include <heddle/geom/bounds.h>
#include <heddle/voxelize/block/gather_options.h>

#include <cstdint>
#include <optional>
#include <string>

namespace heddle {

/// What the user asks of the voxelizer. Nothing is required.
struct VoxelizeOptions {
    Vec3d voxel_size{};           ///< scene units per axis; all 0: from `voxels`
    std::int64_t voxels = 0;      ///< along the longest axis; 0: 512
    std::optional<Bounds> bounds; ///< scene units; voxels that it touches are kept
    std::int32_t subvoxels = 8;   ///< per voxel axis: 1, 2, 4 or 8
    std::int32_t max_lobes = 3;   ///< K, 1 to 8
    CoverageMode coverage = CoverageMode::Columns;
    FitMode fit = FitMode::Moments;
    std::int32_t footprints = 0; ///< cells per axis of a voxel's face that are kept: 0, 4 or 8
    bool correlation = false;    ///< a BlockVisitor is to find what neighbouring voxels share; all
                                 ///< stays in memory
    std::int64_t samples = 0;    ///< per span, with CoverageMode::Mask; 0: two a subvoxel
    bool keep_sums = false;      ///< VoxelFields::masks stays in the result
    std::int64_t memory_bytes = 0; ///< peak resident size that is kept; 0: half of what is free
    std::uint64_t seed = 0;
    std::int64_t writer_bytes = 0; ///< what the caller will take to write the result, and per leaf
    std::int64_t writer_bytes_per_leaf = 0; ///< (io/vdb/predict_vdb.h says how much); in the plan
    std::string spool_dir = ".";            ///< where finished blocks go when memory is short
    std::string command;                    ///< kept in the result

    [[nodiscard]] GatherOptions gather() const { return {coverage, fit, samples}; }
};

} // namespace heddle
