#pragma once

#include <heddle/geom/bounds.h>
#include <heddle/voxelize/block/gather_options.h>

#include <cstdint>
#include <optional>
#include <string>

namespace heddle {

/// The user's options for the voxelizer. All have defaults.
struct VoxelizeOptions {
    Vec3d voxel_size{};           ///< scene units per axis; all 0: derived from `voxels`
    std::int64_t voxels = 0;      ///< voxels along the longest axis; 0: 512
    std::optional<Bounds> bounds; ///< scene units; only voxels that it touches are made
    std::int32_t subvoxels = 8;   ///< per voxel axis: 1, 2, 4 or 8
    std::int32_t max_lobes = 3;   ///< K, 1 to 8
    CoverageMode coverage = CoverageMode::Columns;
    FitMode fit = FitMode::Moments;
    std::int32_t footprints = 0;   ///< cells per axis of the stored footprints: 0, 4 or 8
    bool occupancy = true;         ///< the result has VoxelFields::occupancy
    bool correlation = false;      ///< a BlockVisitor computes the correlation of neighbours; then
                                   ///< all blocks stay in memory
    std::int64_t samples = 0;      ///< per span, with CoverageMode::Mask; 0: two per subvoxel
    bool keep_sums = false;        ///< the result has VoxelFields::masks
    std::int64_t memory_bytes = 0; ///< limit of the peak resident size; 0: half of the free memory
    std::uint64_t seed = 0;
    std::int64_t writer_bytes = 0;          ///< memory for writing the result: a fixed part
    std::int64_t writer_bytes_per_leaf = 0; ///< and a part per leaf (io/vdb/predict_vdb.h)
    std::string spool_dir = ".";            ///< folder for finished blocks if memory is short
    std::string command;                    ///< command line that is stored in the result

    [[nodiscard]] GatherOptions gather() const { return {coverage, fit, samples}; }
};

} // namespace heddle
