#pragma once

#include <heddle/device/level/build_level_op.h>
#include <heddle/device/level/join_slabs_op.h>
#include <heddle/device/level/level_arrays.h>

#include <utility>

namespace heddle {

/// Builds a level of a batch from the level below by the method `moments`, as LevelBuilder does.
/// @param below    is consumed: its lobes are merged in place
/// @param options  of the levels above 0
/// @throws Error   OutOfMemory, Device
template <typename Exec>
[[nodiscard]] LevelArrays
build_level_arrays(Exec& exec, LevelArrays below, const FitOptions& options) {
    exec.set_phase("levels");
    const std::size_t n = below.voxel_count;
    auto first = exec.template make<std::uint8_t>(n);
    auto parent = exec.template make<std::uint32_t>(n + 1);
    exec.for_each(n, MarkFirstChildOp{below.key.data(), first.data()});
    exec.offsets(first.data(), parent.data(), n);
    LevelArrays out;
    out.level = below.level + 1;
    out.voxel_count = exec.read(parent.data() + n);
    const std::size_t count = out.voxel_count;
    out.key = exec.template make<std::uint64_t>(count);
    const auto first_child = exec.template make<std::uint32_t>(count + 1);
    const auto child_mask = exec.template make<std::uint8_t>(count);
    exec.for_each(n + 1,
                  ListParentsOp{below.key.data(), first.data(), parent.data(), n, count,
                                Parents{out.key.data(), first_child.data(), child_mask.data()}});
    first.reset();
    parent.reset();

    out.columns = exec.template make<std::uint64_t>(3 * count * out.words());
    exec.for_each(out.columns.size(),
                  JoinColumnsOp{first_child.data(), child_mask.data(), below.columns.data(),
                                out.level, out.columns.data()});
    below.columns.reset();
    below.key.reset();
    if (below.occupancy.data() != nullptr) {
        out.occupancy = exec.template make<std::uint64_t>(count);
        exec.for_each(count, JoinOccupancyOp{first_child.data(), child_mask.data(),
                                             below.occupancy.data(), out.occupancy.data()});
        below.occupancy.reset();
    }

    out.hits = exec.template make<std::uint32_t>(count);
    out.order = exec.template make<std::uint32_t>(count);
    const auto lobes_left = exec.template make<std::uint8_t>(count);
    exec.for_each(count,
                  MergeChildrenOp{first_child.data(), below.first_lobe.data(), below.hits.data(),
                                  below.lobes.data(), below.maps.data(), options.max_lobes,
                                  out.hits.data(), out.order.data(), lobes_left.data()});
    out.first_lobe = exec.template make<std::uint32_t>(count + 1);
    exec.offsets(lobes_left.data(), out.first_lobe.data(), count);
    out.lobe_count = exec.read(out.first_lobe.data() + count);
    out.lobes = exec.template make<DirectionSums>(out.lobe_count);
    if (below.maps.data() != nullptr) out.maps = exec.template make<MapSums>(out.lobe_count);
    exec.for_each(count, TakeLobesOp{first_child.data(), below.first_lobe.data(),
                                     out.first_lobe.data(), below.lobes.data(), below.maps.data(),
                                     out.lobes.data(), out.maps.data()});
    if (!options.fields.slabs) return out;
    out.slabs = exec.template make<OpenSlab>(count);
    exec.for_each(count, JoinSlabsOp{options, first_child.data(), child_mask.data(),
                                     below.slabs.data(), below.hits.data(), out.first_lobe.data(),
                                     out.lobes.data(), out.slabs.data()});
    return out;
}

} // namespace heddle
