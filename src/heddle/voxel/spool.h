#pragma once

#include <heddle/base/temp_file.h>
#include <heddle/voxel/voxel_grid.h>

#include <array>
#include <memory>
#include <string>

namespace heddle {

/// Blocks that wait in a temporary file: a VoxelSource that holds almost nothing in memory.
class SpooledGrid final : public VoxelSource {
public:
    /// @param folder  of the file
    explicit SpooledGrid(const std::string& folder) : file_(folder) {}

    void resize(std::size_t blocks) { places_.resize(blocks); }
    /// Stores block i. One thread at a time.
    void store(std::size_t i, const VoxelBlock& block);

    [[nodiscard]] std::size_t block_count() const override { return places_.size(); }
    [[nodiscard]] const VoxelBlock& block(std::size_t i, VoxelBlock& scratch) const override;

private:
    struct Place {
        std::int64_t offset = 0;
        std::uint32_t leaves = 0;
        std::array<std::uint32_t, 11> sizes{}; ///< of VoxelBlock::for_each_array's vectors
    };
    TempFile file_;
    std::vector<Place> places_;
};

} // namespace heddle
