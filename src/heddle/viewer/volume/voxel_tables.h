#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/bounds.h>
#include <heddle/opengl/buffer.h>
#include <heddle/opengl/context.h>
#include <heddle/viewer/volume/measure_voxels.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle::viewer {

/// Pointers to the levels, for functions that take levels of any origin.
[[nodiscard]] std::vector<const VoxelLevel*> sources_of(const VoxelLevels& levels);

/// All levels of a volume in the driver's memory, each like a preview::PreviewVolume: 12 bytes per
/// voxel, and the tiles of the LeafTable, by which kVoxelTableGlsl finds leaves. Tiles are in a box
/// of cells, where a shader reads one word: in a hash table all lanes of a wave would wait for the
/// longest search. Needs a current Context while it lives.
class VoxelTables {
public:
    /// Predicts the bytes before any are allocated. If they exceed a storage block, the finest
    /// levels are left out, as few as possible. Reads each block twice, or once for a level that is
    /// left out.
    ///
    /// @param levels         finest first; edges of voxels double from one to the next, once or
    ///                       more often; may be empty; not stored
    /// @param storage_bytes  largest storage block to plan for; 0: the driver's
    /// @throws Error  InvalidArgument: edges do not double, more than 24 levels; OutOfMemory: not
    ///                even the coarsest fits; Device: too few storage blocks; Cancelled
    VoxelTables(const opengl::Context& context,
                std::span<const VoxelLevel* const> levels,
                std::int64_t storage_bytes,
                Progress& progress);

    /// Binds storage blocks 8 to 13 and uniform block 8.
    void bind() const;

    [[nodiscard]] bool empty() const { return bounds_.empty(); } ///< no voxel in any level
    [[nodiscard]] int level_count() const { return static_cast<int>(bytes_.size()); }
    /// The finest level that fits; finer ones are not stored.
    [[nodiscard]] int first_level() const { return first_; }
    /// By level, including those that are left out.
    [[nodiscard]] std::span<const VoxelTableBytes> bytes() const { return bytes_; }
    /// The bounds of the voxels of all levels that fit, and of the finest of them, scene units.
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }
    [[nodiscard]] const Bounds& finest_bounds() const { return finest_bounds_; }
    /// The origin of points in shaders, scene units.
    [[nodiscard]] const Vec3d& middle() const { return middle_; }
    /// The edges of a block, scene units.
    [[nodiscard]] Vec3d block_size() const;
    /// Occupied blocks of 32^3 voxels of level 0, even if that is left out: ascending x, then y,
    /// then z.
    [[nodiscard]] std::span<const Vec3i> blocks() const { return blocks_; }

private:
    struct LevelTable;
    void plan(std::span<const VoxelLevel* const> levels, std::int64_t most, Progress& progress);
    void fill(std::span<const VoxelLevel* const> levels, Progress& progress);
    void write_levels(std::vector<LevelTable>& levels);

    Vec3d voxel_size_{1.0, 1.0, 1.0}; ///< of level 0
    Bounds bounds_, finest_bounds_;
    Vec3d middle_;
    int first_ = 0;
    std::vector<VoxelTableBytes> bytes_;
    std::vector<Vec3i> blocks_;
    /// cells, leaf table, leaves, three words of voxels, levels
    std::vector<opengl::Buffer> buffers_;
};

} // namespace heddle::viewer
