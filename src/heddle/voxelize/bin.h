#pragma once

#include <heddle/base/progress.h>
#include <heddle/surface/surface_view.h>
#include <heddle/voxel/block_range.h>
#include <heddle/voxelize/block/primitive.h>
#include <heddle/yarn/fiber_source.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// All triangles of a geometry as one numbered list.
class TriangleSource {
public:
    /// @param geometry  must outlive this
    explicit TriangleSource(const Geometry& geometry);
    [[nodiscard]] std::uint64_t count() const { return first_.back(); }
    [[nodiscard]] TriangleId place(std::uint64_t triangle) const {
        const std::uint64_t mesh = range_of(first_.data(), displacement_.size(), triangle);
        return {static_cast<std::uint32_t>(mesh),
                static_cast<std::uint32_t>(triangle - first_[mesh])};
    }
    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    /// Returns the largest distance that height maps move the mesh's points, in scene units.
    [[nodiscard]] double displacement(std::uint32_t mesh) const { return displacement_[mesh]; }

private:
    const Geometry& geometry_;
    std::vector<std::uint64_t> first_; ///< first triangle of each mesh, and the end
    std::vector<double> displacement_; ///< per mesh, scene units
};

/// The primitives that touch each block. They are counted once and then listed batch by batch.
class Bins {
public:
    /// Counts the primitives of all blocks. The arguments must outlive this. @throws Error
    /// Cancelled
    Bins(const FiberSource& fibers,
         const TriangleSource& triangles,
         const LatticeUnits& units,
         const BlockRange& range,
         const Progress& progress);

    [[nodiscard]] const BlockRange& range() const { return range_; }
    /// Returns the numbers of the occupied blocks, ascending.
    [[nodiscard]] const std::vector<std::uint32_t>& blocks() const { return blocks_; }
    /// Returns the number of primitives of a block, by the block's number.
    [[nodiscard]] std::uint64_t entries(std::uint32_t block) const { return counts_[block]; }
    [[nodiscard]] std::uint64_t total_entries() const { return total_; }

    /// The primitives of some blocks, ascending within each block.
    struct Lists {
        std::vector<std::uint64_t> first; ///< offset of each block, and the end
        std::vector<Primitive> primitives;
        [[nodiscard]] std::span<const Primitive> of(std::size_t i) const {
            return std::span(primitives).subspan(first[i], first[i + 1] - first[i]);
        }
    };
    /// Returns the primitives of the chosen blocks.
    /// @param chosen  block numbers from blocks(), ascending
    /// @throws Error  Cancelled
    [[nodiscard]] Lists fill(std::span<const std::uint32_t> chosen, const Progress& progress) const;
    [[nodiscard]] std::int64_t byte_count() const;

private:
    template <typename Visit>
    void visit_pairs(const Progress& progress, const Visit& visit) const;

    const FiberSource& fibers_;
    const TriangleSource& triangles_;
    const LatticeUnits& units_;
    BlockRange range_;
    std::vector<std::uint32_t> counts_; ///< per block of the range
    std::vector<std::uint32_t> blocks_;
    std::uint64_t total_ = 0;
};

} // namespace heddle
