#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/voxel/lattice_units.h>
#include <heddle/voxel/voxel_level.h>
#include <heddle/voxel/weight.h>

#include <array>
#include <cstdint>
#include <vector>

namespace heddle {

/// The pooled directions of one material in one voxel. Sums are integers, so the order of adding
/// has no effect.
struct LobeSums {
    std::array<std::int64_t, 6> moment{}; ///< sum of weight x d d^T: xx yy zz xy xz yz
    std::int64_t weight = 0;
    std::uint32_t material = 0;
    std::uint32_t next = 0; ///< index + 1 of the voxel's next lobe in BlockSums::more; 0: none
};
static_assert(sizeof(LobeSums) == 64);

/// All sums of one voxel.
struct VoxelSums {
    std::array<std::uint64_t, 3>
        column{};                       ///< per axis: bit b * n + a of the other two axes (a < b)
    std::array<std::uint64_t, 8> sub{}; ///< subvoxel (x, y, z) is bit (x n + y) n + z of all words
    LobeSums lobe;                      ///< the first material's; weight 0: none yet
};
static_assert(sizeof(VoxelSums) == 152);

/// The sums of one block's voxels. Reused from block to block.
class BlockSums {
public:
    static constexpr std::uint16_t kNone = 0xffff;
    static constexpr int kVoxels = kBlockVoxels * kBlockVoxels * kBlockVoxels;

    explicit BlockSums(bool with_maps);

    /// Clears the sums for the block with voxel range [lo, hi), at most kBlockVoxels per axis.
    void reset(Vec3i lo, Vec3i hi);

    /// Returns a voxel's sums, which are empty at the first call. (x, y, z) is relative to lo and
    /// inside the block.
    HEDDLE_HOST_INLINE VoxelSums& voxel(int x, int y, int z) {
        return voxel_at(number_of(x, y, z));
    }
    /// Number of scratch voxels, from number kVoxels on, that lanes without a hit write to.
    static constexpr int kSpareVoxels = 16;

    /// Returns the sums of a voxel by its number, (x 32 + y) 32 + z.
    HEDDLE_HOST_INLINE VoxelSums& voxel_at(std::uint32_t cell) { return VoxelTable(*this)[cell]; }

    /// voxel_at() for loops that set many bits. A copy in the loop has its addresses in registers,
    /// unlike vectors behind a reference. It is valid until the next reset().
    class VoxelTable {
    public:
        HEDDLE_HOST_INLINE explicit VoxelTable(BlockSums& block)
            : slots_(block.table_.data()), voxels_(block.voxels_.data()), count_(&block.count_) {}
        HEDDLE_HOST_INLINE VoxelSums& operator[](std::uint32_t cell) const {
            std::uint16_t slot = slots_[cell];
            if (slot == kNone) [[unlikely]] {
                slot = static_cast<std::uint16_t>((*count_)++);
                slots_[cell] = slot;
                voxels_[slot] = VoxelSums{};
            }
            return voxels_[slot];
        }

    private:
        std::uint16_t* slots_;
        VoxelSums* voxels_;
        int* count_;
    };

    /// Returns the sums of `material` in `voxel`, which are empty at the first call.
    HEDDLE_HOST_INLINE LobeSums& lobe(VoxelSums& voxel, std::uint32_t material) {
        if (voxel.lobe.weight != 0 && voxel.lobe.material != material) {
            return other_lobe(voxel, material);
        }
        voxel.lobe.material = material;
        return voxel.lobe;
    }
    /// Returns the map sums of a lobe of `voxel`. Requires has_maps().
    MapSums& maps(const VoxelSums& voxel, const LobeSums& lobe);

    [[nodiscard]] Vec3i lo() const { return lo_; }
    [[nodiscard]] Vec3i hi() const { return hi_; }
    [[nodiscard]] int count() const { return count_; }
    /// Returns the voxel at (x, y, z) relative to lo, or null.
    [[nodiscard]] const VoxelSums* find(int x, int y, int z) const {
        const std::uint16_t slot = table_[number_of(x, y, z)];
        return slot == kNone ? nullptr : &voxels_[slot];
    }
    /// Returns the slots for at_slot(), or kNone, of the voxels (x, y, 0 .. kBlockVoxels - 1)
    /// relative to lo.
    [[nodiscard]] const std::uint16_t* slots(int x, int y) const {
        return &table_[number_of(x, y, 0)];
    }
    [[nodiscard]] const VoxelSums& at_slot(std::uint16_t slot) const { return voxels_[slot]; }
    [[nodiscard]] const LobeSums* next(const LobeSums& lobe) const {
        return lobe.next == 0 ? nullptr : &more_[lobe.next - 1];
    }
    [[nodiscard]] const MapSums* find_maps(const VoxelSums& voxel, const LobeSums& lobe) const;
    [[nodiscard]] bool has_maps() const { return with_maps_; }

private:
    /// Returns the number of a voxel for voxel_at().
    [[nodiscard]] static HEDDLE_HOST_INLINE std::uint32_t number_of(int x, int y, int z) {
        return static_cast<std::uint32_t>((x * kBlockVoxels + y) * kBlockVoxels + z);
    }
    LobeSums& other_lobe(VoxelSums& voxel, std::uint32_t material);

    Vec3i lo_, hi_;
    int count_ = 0;
    bool with_maps_ = false;
    std::vector<std::uint16_t> table_;
    std::vector<VoxelSums> voxels_;
    std::vector<LobeSums> more_; ///< second and later materials of voxels
    std::vector<MapSums> maps_, more_maps_;
};

} // namespace heddle
