#pragma once

#include <heddle/device/level/join_slabs_op.h>
#include <heddle/device/level/level_arrays.h>
#include <heddle/device/level/store_level_op.h>
#include <heddle/device/level/stored_level.h>

namespace heddle {

namespace detail {

/// Downloads an array to a buffer of the host and frees the array.
template <typename Exec, typename T>
void download_array(Exec& exec, executor::Array<T> from, HostBuffer<T>& to) {
    const std::span<T> room = to.resize(from.size());
    exec.download(room, static_cast<const T*>(from.data()));
}

/// The stored order of a level's voxels and lobes.
struct StoredOrder {
    executor::Array<std::uint32_t> voxel_at;   ///< per stored voxel: its number in the level
    executor::Array<std::uint32_t> lobe_begin; ///< first lobe of each stored voxel, and the end
};

/// Finds the stored order and the leaves.
template <typename Exec>
[[nodiscard]] StoredOrder
order_voxels(Exec& exec, const LevelArrays& level, std::size_t blocks, StoredLevel& out) {
    const LeafCells cells{level.level};
    const std::size_t leaves = blocks * cells.per_block();
    const std::size_t n = level.voxel_count;
    auto active = exec.template make_zero<std::uint64_t>(8 * leaves);
    auto first_voxel = exec.template make<std::uint32_t>(leaves + 1);
    StoredOrder order;
    exec.for_each(n, MarkLeavesOp{cells, level.key.data(), active.data()});
    {
        const auto count = exec.template make<std::uint32_t>(leaves);
        exec.for_each(leaves, CountLeavesOp{active.data(), count.data()});
        exec.offsets(count.data(), first_voxel.data(), leaves);
    }
    order.voxel_at = exec.template make<std::uint32_t>(n);
    order.lobe_begin = exec.template make<std::uint32_t>(n + 1);
    auto lobe_count = exec.template make<std::uint8_t>(n);
    exec.for_each(n,
                  RankVoxelsOp{cells, level.key.data(), active.data(), first_voxel.data(),
                               level.first_lobe.data(), order.voxel_at.data(), lobe_count.data()});
    exec.offsets(lobe_count.data(), order.lobe_begin.data(), n);
    auto first_lobe = exec.template make<std::uint32_t>(leaves + 1);
    exec.for_each(leaves + 1,
                  FirstLobesOp{first_voxel.data(), order.lobe_begin.data(), first_lobe.data()});
    download_array(exec, std::move(active), out.active);
    download_array(exec, std::move(first_voxel), out.first_voxel);
    download_array(exec, std::move(first_lobe), out.first_lobe);
    download_array(exec, std::move(lobe_count), out.lobe_count);
    return order;
}

template <typename Exec>
void store_faces(Exec& exec, const LevelArrays& level, const StoredOrder& order, StoredLevel& out) {
    const std::size_t n = level.voxel_count;
    const int cells = out.options.fields.footprints;
    auto coverage = exec.template make<Coverage>(n);
    auto footprint = exec.template make<std::uint64_t>(cells != 0 ? 3 * n : 0);
    exec.for_each(3 * n, StoreFaceOp{level.level, out.options.subvoxels, cells,
                                     order.voxel_at.data(), level.hits.data(), level.columns.data(),
                                     coverage.data(), footprint.data()});
    download_array(exec, std::move(coverage), out.coverage);
    download_array(exec, std::move(footprint), out.footprint);
}

template <typename Exec>
void store_occupancy(Exec& exec,
                     const LevelArrays& level,
                     const StoredOrder& order,
                     StoredLevel& out) {
    const std::size_t n = out.options.fields.occupancy ? level.voxel_count : 0;
    auto occupancy = exec.template make<std::uint64_t>(n);
    exec.for_each(
        n, StoreOccupancyOp{order.voxel_at.data(), level.occupancy.data(), occupancy.data()});
    download_array(exec, std::move(occupancy), out.occupancy);
}

template <typename Exec>
void store_lobes(Exec& exec, const LevelArrays& level, const StoredOrder& order, StoredLevel& out) {
    const VoxelFields& fields = out.options.fields;
    const std::size_t n = level.voxel_count;
    const std::size_t m = level.lobe_count;
    auto merges = exec.template make<std::uint32_t>(out.options.max_lobes > 2 ? n : 0);
    auto lobes = exec.template make<Lobe>(m);
    auto maps = exec.template make<LobeMaps>(fields.maps() ? m : 0);
    auto tangents = exec.template make<PackedSggx>(fields.tangents ? m : 0);
    exec.for_each(n, StoreLobesOp{order.voxel_at.data(), level.first_lobe.data(),
                                  order.lobe_begin.data(), level.order.data(), level.lobes.data(),
                                  level.maps.data(), merges.data(), lobes.data(), maps.data(),
                                  tangents.data()});
    download_array(exec, std::move(merges), out.order);
    download_array(exec, std::move(lobes), out.lobes);
    download_array(exec, std::move(maps), out.maps);
    download_array(exec, std::move(tangents), out.tangents);
}

template <typename Exec>
void store_sums(Exec& exec, const LevelArrays& level, const StoredOrder& order, StoredLevel& out) {
    const bool masks = out.options.fields.masks;
    const std::size_t n = masks ? level.voxel_count : 0;
    const std::size_t m = masks ? level.lobe_count : 0;
    auto columns = exec.template make<std::uint64_t>(3 * n);
    auto moments = exec.template make<LobeMoment>(m);
    auto maps = exec.template make<MapSums>(level.maps.data() != nullptr ? m : 0);
    exec.for_each(n, StoreSumsOp{order.voxel_at.data(), level.first_lobe.data(),
                                 order.lobe_begin.data(), level.columns.data(), level.lobes.data(),
                                 level.maps.data(), columns.data(), moments.data(), maps.data()});
    download_array(exec, std::move(columns), out.columns);
    download_array(exec, std::move(moments), out.moments);
    download_array(exec, std::move(maps), out.map_sums);
}

template <typename Exec>
void store_slabs(Exec& exec, const LevelArrays& level, const StoredOrder& order, StoredLevel& out) {
    const std::size_t n = out.options.fields.slabs ? level.voxel_count : 0;
    auto slabs = exec.template make<PlaneSlab>(n);
    exec.for_each(n, StoreSlabsOp{order.voxel_at.data(), level.slabs.data(), slabs.data()});
    download_array(exec, std::move(slabs), out.slabs);
}

} // namespace detail

/// Computes the stored form of a level and downloads it.
/// @param blocks  blocks of the batch
/// @param out     its buffers are reused
/// @throws Error  OutOfMemory, Device
template <typename Exec>
void store_level_arrays(Exec& exec,
                        const LevelArrays& level,
                        std::size_t blocks,
                        const FitOptions& options,
                        StoredLevel& out) {
    exec.set_phase("store");
    out.level = level.level;
    out.options = options;
    const detail::StoredOrder order = detail::order_voxels(exec, level, blocks, out);
    detail::store_faces(exec, level, order, out);
    detail::store_occupancy(exec, level, order, out);
    detail::store_lobes(exec, level, order, out);
    detail::store_sums(exec, level, order, out);
    detail::store_slabs(exec, level, order, out);
}

} // namespace heddle
