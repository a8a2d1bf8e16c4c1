#pragma once

#include <heddle/device/fit_sums_op.h>

namespace heddle {

/// Level 0 of a batch from its sums: the lobes of each voxel, one a material, merged where there are
/// more than may be stored. The same as fit_block() finds.
/// @param blocks   of the batch
/// @param merging  a block has lobes of more than one material
/// @throws Error  OutOfMemory, Device
template <typename Exec>
[[nodiscard]] LevelArrays fit_sums(Exec& exec,
                                   const DenseSums& sums,
                                   std::size_t blocks,
                                   bool merging,
                                   const FitSettings& settings) {
    exec.set_stage("fit");
    const std::size_t cells = blocks * kBlockCells;
    gpu::Array<std::uint8_t> voxels = exec.template make<std::uint8_t>(cells);
    gpu::Array<std::uint8_t> lobes = exec.template make<std::uint8_t>(cells);
    exec.for_each(cells, CountVoxelOp{sums, settings.max_lobes, voxels.data(), lobes.data()});
    gpu::Array<std::uint32_t> first_voxel = exec.template make<std::uint32_t>(cells + 1);
    gpu::Array<std::uint32_t> first_lobe = exec.template make<std::uint32_t>(cells + 1);
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
    out.lobes = exec.template make<DirectionSums>(out.lobe_count);
    if (sums.maps != nullptr) out.maps = exec.template make<MapSums>(out.lobe_count);
    const auto write = [&](auto op) {
        op.sums = sums;
        op.settings = settings;
        op.cells = cells;
        op.voxel_count = static_cast<std::uint32_t>(n);
        op.first_voxel = first_voxel.data();
        op.first_lobe = first_lobe.data();
        op.key = out.key.data();
        op.hits = out.hits.data();
        op.lobe_begin = out.first_lobe.data();
        op.order = out.order.data();
        op.columns = out.columns.data();
        op.lobes = out.lobes.data();
        op.maps = out.maps.data();
        exec.for_each(cells + 1, op);
    };
    if (merging) {
        write(FitVoxelOp<true>{});
    } else {
        write(FitVoxelOp<false>{});
    }
    return out;
}

} // namespace heddle
