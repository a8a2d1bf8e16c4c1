#pragma once

#include <heddle/base/vec.h>
#include <heddle/opengl/buffer.h>
#include <heddle/opengl/shader.h>
#include <heddle/slice/slices.h>
#include <heddle/voxel/lattice_units.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle::raster {

/// Voxels along a brick's edge. A brick has the voxels of one leaf.
constexpr int kBrickEdge = 8;

/// The bricks of a voxel range, counted from the origin of the slices.
struct BrickGrid {
    Vec3i origin;             ///< voxel index
    Vec3i voxel_lo, voxel_hi; ///< [lo, hi), relative to the origin
    Vec3i lo, count;          ///< first brick; number of bricks per axis
    LatticeUnits units;

    /// @throws Error  Unsupported: too many bricks for one table, or too many subvoxels for pixels
    BrickGrid(const LatticeUnits& units, Vec3i origin, Vec3i voxel_lo, Vec3i voxel_hi);

    [[nodiscard]] std::uint64_t size() const;
    [[nodiscard]] Vec3i brick(std::uint64_t number) const; ///< index, from the origin
    [[nodiscard]] std::uint64_t number(Vec3i brick) const;
    /// Sets the uniforms of kBrickGlsl.
    void set_uniforms(const opengl::Program& program) const;
};

/// A block and its touched bricks.
struct TouchedBlock {
    Vec3i index;                       ///< index in the lattice, as for BlockVisitor
    std::vector<std::uint32_t> bricks; ///< numbers in the grid, ascending
};

/// Returns the program for find_blocks().
[[nodiscard]] opengl::Program make_mark_program();

/// Returns the blocks that slices may touch, in Z-order. They are found by the driver.
/// @param mark  result of make_mark_program()
[[nodiscard]] std::vector<TouchedBlock> find_blocks(const opengl::Context& context,
                                                    const opengl::Program& mark,
                                                    const BrickGrid& grid,
                                                    std::span<const slice::SliceChunk> chunks);

} // namespace heddle::raster
