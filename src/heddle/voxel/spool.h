#pragma once

#include <heddle/base/temp_file.h>
#include <heddle/voxel/voxel_level.h>

#include <array>
#include <memory>
#include <string>

namespace heddle {

/// A VoxelLevel whose blocks are in a temporary file, so that it needs almost no memory.
class SpooledLevel final : public VoxelLevel {
public:
    /// @param folder  folder of the file
    explicit SpooledLevel(const std::string& folder) : file_(folder) {}

    void resize(std::size_t blocks) { records_.resize(blocks); }
    /// Stores block i. One thread at a time.
    void store(std::size_t i, const VoxelBlock& block);

    [[nodiscard]] std::size_t block_count() const override { return records_.size(); }
    [[nodiscard]] const VoxelBlock& block(std::size_t i, VoxelBlock& scratch) const override;

private:
    struct BlockRecord {
        std::int64_t offset = 0;
        std::uint32_t leaves = 0;
        std::array<std::uint32_t, 12> sizes{}; ///< of the vectors of for_each_array()
    };
    TempFile file_;
    std::vector<BlockRecord> records_;
};

} // namespace heddle
