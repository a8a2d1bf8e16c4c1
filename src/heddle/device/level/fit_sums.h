#pragma once

#include <heddle/device/level/build_level_op.h>
#include <heddle/device/level/fit_sums_op.h>

#include <utility>

namespace heddle {

/// Merges the lobes of level 0 if a voxel has more than may be stored, and orders them.
template <typename Exec>
void merge_lobes(Exec& exec, int max_lobes, LevelArrays& level) {
    const std::size_t n = level.voxel_count;
    const auto count = exec.template make<std::uint8_t>(n);
    exec.for_each(n, MergeLobesOp{level.first_lobe.data(), level.lobes.data(), level.maps.data(),
                                  max_lobes, level.order.data(), count.data()});
    auto first = exec.template make<std::uint32_t>(n + 1);
    exec.offsets(count.data(), first.data(), n);
    level.lobe_count = exec.read(first.data() + n);
    auto lobes = exec.template make<DirectionSums>(level.lobe_count);
    auto maps = exec.template make<MapSums>(level.maps.size() > 0 ? level.lobe_count : 0);
    exec.for_each(n, TakeLobesOp{nullptr, level.first_lobe.data(), first.data(), level.lobes.data(),
                                 level.maps.data(), lobes.data(), maps.data()});
    level.first_lobe = std::move(first);
    level.lobes = std::move(lobes);
    level.maps = std::move(maps);
}

/// Returns level 0 of a batch from its sums: the lobes of each voxel, one per material, merged if
/// there are more than may be stored. They are the same as those of fit_block().
/// @param blocks   blocks of the batch
/// @param merging  true: some block has lobes of more than one material
/// @throws Error  OutOfMemory, Device
template <typename Exec>
[[nodiscard]] LevelArrays fit_sums(Exec& exec,
                                   const DenseSums& sums,
                                   std::size_t blocks,
                                   bool merging,
                                   const FitOptions& options) {
    exec.set_phase("fit");
    const std::size_t cells = blocks * kVoxelsPerBlock;
    executor::Array<std::uint8_t> voxels = exec.template make<std::uint8_t>(cells);
    executor::Array<std::uint16_t> lobes = exec.template make<std::uint16_t>(cells);
    exec.for_each(cells, CountVoxelOp{sums, voxels.data(), lobes.data()});
    const auto first_voxel = exec.template make<std::uint32_t>(cells + 1);
    const auto first_lobe = exec.template make<std::uint32_t>(cells + 1);
    exec.offsets(voxels.data(), first_voxel.data(), cells);
    exec.offsets(lobes.data(), first_lobe.data(), cells);
    voxels.reset();
    lobes.reset();

    LevelArrays out;
    out.voxel_count = exec.read(first_voxel.data() + cells);
    out.lobe_count = exec.read(first_lobe.data() + cells);
    const std::size_t n = out.voxel_count;
    out.key = exec.template make<std::uint64_t>(n);
    out.hits = exec.template make<std::uint32_t>(n);
    out.first_lobe = exec.template make<std::uint32_t>(n + 1);
    out.order = exec.template make<std::uint32_t>(n);
    out.columns = exec.template make<std::uint64_t>(3 * n);
    out.occupancy = exec.template make<std::uint64_t>(options.fields.occupancy ? n : 0);
    out.lobes = exec.template make<DirectionSums>(out.lobe_count);
    if (sums.maps != nullptr) out.maps = exec.template make<MapSums>(out.lobe_count);
    exec.for_each(cells + 1,
                  FitVoxelOp{sums, options, cells, static_cast<std::uint32_t>(n),
                             first_voxel.data(), first_lobe.data(), out.key.data(), out.hits.data(),
                             out.first_lobe.data(), out.order.data(), out.columns.data(),
                             out.occupancy.data(), out.lobes.data(), out.maps.data()});
    if (merging) merge_lobes(exec, options.max_lobes, out);
    return out;
}

} // namespace heddle
