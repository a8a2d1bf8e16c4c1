#include <heddle/voxelize/block/accumulator.h>

#include <algorithm>

namespace heddle {

BlockSums::BlockSums(bool with_maps)
    : with_maps_(with_maps),
      table_(kVoxels + kSpareVoxels, kNone),
      voxels_(kVoxels + kSpareVoxels) {
    for (int i = kVoxels; i < kVoxels + kSpareVoxels; ++i) {
        table_[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(i);
    }
    if (with_maps) maps_.resize(kVoxels);
}

void BlockSums::reset(Vec3i lo, Vec3i hi) {
    lo_ = lo;
    hi_ = hi;
    std::fill_n(table_.begin(), kVoxels, kNone);
    if (with_maps_) std::fill_n(maps_.begin(), count_, MapSums{});
    count_ = 0;
    more_.clear();
    more_maps_.clear();
}

LobeSums& BlockSums::other_lobe(VoxelSums& voxel, std::uint32_t material) {
    std::uint32_t link = voxel.lobe.next;
    std::uint32_t last = 0;
    while (link != 0) {
        if (more_[link - 1].material == material) return more_[link - 1];
        last = link;
        link = more_[link - 1].next;
    }
    more_.push_back({.material = material});
    if (with_maps_) more_maps_.emplace_back();
    const auto made = static_cast<std::uint32_t>(more_.size());
    (last == 0 ? voxel.lobe.next : more_[last - 1].next) = made;
    return more_.back();
}

MapSums& BlockSums::maps(const VoxelSums& voxel, const LobeSums& lobe) {
    if (&lobe == &voxel.lobe) return maps_[static_cast<std::size_t>(&voxel - voxels_.data())];
    return more_maps_[static_cast<std::size_t>(&lobe - more_.data())];
}

const MapSums* BlockSums::find_maps(const VoxelSums& voxel, const LobeSums& lobe) const {
    if (!with_maps_) return nullptr;
    if (&lobe == &voxel.lobe) return &maps_[static_cast<std::size_t>(&voxel - voxels_.data())];
    return &more_maps_[static_cast<std::size_t>(&lobe - more_.data())];
}

} // namespace heddle
