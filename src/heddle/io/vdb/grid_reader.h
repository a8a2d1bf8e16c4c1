#pragma once

#include <heddle/base/vec.h>
#include <heddle/io/vdb/vdb_file.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace heddle {

/// The active voxels of a grid without its tree.
struct GridLeaves {
    struct Leaf {
        Vec3i origin;
        std::array<std::uint64_t, 8> active{}; ///< as VoxelLeaf::active
        std::size_t first = 0;                 ///< its first value
    };
    std::vector<Leaf> leaves;      ///< ascending origin (x, then y, then z), none empty
    std::vector<std::byte> values; ///< of the active voxels in the leaves' order
    std::size_t value_bytes = 0;   ///< 4, 8 or 12

    [[nodiscard]] std::size_t size() const {
        return value_bytes == 0 ? 0 : values.size() / value_bytes;
    }
};

/// Reads grids of one file by name through OpenVDB; all that it throws arrives as an Error.
class VdbReader {
public:
    /// @throws Error  as read_grid_entries; BadFile: OpenVDB refuses the file
    explicit VdbReader(const std::string& path);
    ~VdbReader();
    VdbReader(const VdbReader&) = delete;
    VdbReader& operator=(const VdbReader&) = delete;

    [[nodiscard]] const std::vector<GridEntry>& entries() const { return entries_; }
    /// File-level metadata as text: strings as they are, numbers in decimal.
    [[nodiscard]] const std::map<std::string, std::string>& metadata() const { return metadata_; }
    /// @throws Error  BadFile: damaged, or active tiles; Unsupported: not one of Heddle's value types
    [[nodiscard]] GridLeaves read(const std::string& name) const;

private:
    struct File;
    std::string path_;
    std::vector<GridEntry> entries_;
    std::map<std::string, std::string> metadata_;
    std::unique_ptr<File> file_;
};

} // namespace heddle
