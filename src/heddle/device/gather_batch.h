#pragma once

#include <heddle/device/fit_slabs_op.h>
#include <heddle/device/gather_fibers_op.h>
#include <heddle/device/gather_triangle_op.h>
#include <heddle/device/level/fit_sums.h>
#include <heddle/device/level/join_slabs_op.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// An uploaded geometry and its lattice, which all executors read.
struct DeviceGeometry {
    FiberView fibers;
    FiberTablesView tables;
    SurfaceView surfaces;
    LatticeUnits units;
    BlockRange range;
    FitOptions fit;
};

/// The host's description of the blocks that are processed at once.
struct BlockBatch {
    std::vector<std::uint32_t> numbers; ///< numbers of the blocks in the range
    std::vector<BatchBlock> blocks;
    /// [kind][block]: first pair of the block, and the end
    std::array<std::vector<std::uint64_t>, kPrimitiveKinds> first_pair;
};

/// The pairs of a batch's blocks, by kind.
struct BatchPairs {
    std::array<executor::Array<BlockPair>, kPrimitiveKinds> of;
};

/// Sets n numbers to one value.
struct FillOp {
    std::uint32_t* to;
    std::uint32_t value;
    HEDDLE_HD void operator()(std::size_t i) const { to[i] = value; }
};

/// Writes the slot of each of a batch's blocks.
struct SetSlotsOp {
    const std::uint32_t* numbers;
    std::uint32_t* slot_of_block;
    HEDDLE_HD void operator()(std::size_t slot) const {
        slot_of_block[numbers[slot]] = static_cast<std::uint32_t>(slot);
    }
};

/// Calls to.add() for each primitive of the scene with each block that it may touch.
template <typename Exec, typename To>
void walk_primitives(Exec& exec, const DeviceGeometry& scene, const To& to) {
    exec.for_each(scene.fibers.span_count,
                  WalkSpanOp<To>{scene.fibers, scene.units, scene.range, to});
    exec.for_each(scene.surfaces.triangle_count,
                  WalkTriangleOp<To>{scene.surfaces, scene.units, scene.range, to});
}

/// Lists the primitives of a batch's blocks, and assigns each block its planes, one per material.
/// @param slot_of_block  has space for a number per block of the range
template <typename Exec>
[[nodiscard]] BatchPairs list_pairs(Exec& exec,
                                    const DeviceGeometry& scene,
                                    BlockBatch& batch,
                                    std::uint32_t* slot_of_block) {
    exec.set_phase("bin");
    const std::size_t n = batch.blocks.size();
    const auto numbers = exec.make_from(std::span<const std::uint32_t>(batch.numbers));
    const auto blocks = exec.make_from(std::span<const BatchBlock>(batch.blocks));
    BatchPairs pairs;
    std::array<executor::Array<std::uint64_t>, kPrimitiveKinds> next;
    ListPairs list{slot_of_block, blocks.data(), {}, {}};
    for (std::size_t k = 0; k < kPrimitiveKinds; ++k) {
        const std::span<const std::uint64_t> first(batch.first_pair[k]);
        next[k] = exec.make_from(first);
        pairs.of[k] = exec.template make<BlockPair>(first[n]);
        list.next[k] = next[k].data();
        list.pairs[k] = pairs.of[k].data();
    }
    exec.for_each(scene.range.count(), FillOp{slot_of_block, ListPairs::kNoSlot});
    exec.for_each(n, SetSlotsOp{numbers.data(), slot_of_block});
    walk_primitives(exec, scene, list);
    exec.download(std::span(batch.blocks), blocks.data());
    std::uint32_t planes = 0;
    for (BatchBlock& block : batch.blocks) {
        block.first_plane = planes;
        block.planes = block.materials.count();
        planes += block.planes;
    }
    return pairs;
}

/// Gathers the single curves of a batch.
template <typename Exec>
void gather_plain(Exec& exec, const FiberBatch& batch, const executor::Array<BlockPair>& pairs) {
    exec.set_phase("gather of curves");
    exec.for_each(pairs.size(), GatherPlainOp{batch, pairs.data()});
}

/// Gathers the yarns of a batch.
template <typename Exec>
void gather_yarns(Exec& exec, const FiberBatch& batch, const executor::Array<BlockPair>& pairs) {
    const std::size_t n = pairs.size();
    if (n == 0) return;
    exec.set_phase("gather of yarns");
    const auto yarns = exec.template make<YarnPair>(n);
    const auto count = [&] { return exec.template make<std::uint32_t>(n); };
    const auto first = [&] { return exec.template make<std::uint64_t>(n + 1); };
    const auto frames = count(), runs = count(), hairs = count();
    const auto first_frame = first(), first_run = first(), first_hair = first();
    exec.for_each(n, PrepareYarnOp{batch, pairs.data(), yarns.data(), frames.data(), runs.data(),
                                   hairs.data()});
    exec.offsets(frames.data(), first_frame.data(), n);
    exec.offsets(runs.data(), first_run.data(), n);
    exec.offsets(hairs.data(), first_hair.data(), n);
    const auto frame_at = exec.template make<YarnFrame>(exec.read(first_frame.data() + n));
    exec.for_each(frame_at.size(),
                  FrameYarnOp{yarns.data(), first_frame.data(), n, frame_at.data()});
    exec.for_each(exec.read(first_run.data() + n),
                  GatherYarnOp{batch, yarns.data(), first_run.data(), first_frame.data(), n,
                               frame_at.data()});
    exec.for_each(exec.read(first_hair.data() + n),
                  GatherHairOp{batch, yarns.data(), first_hair.data(), n});
}

/// Gathers a batch's triangles of one kind.
template <SurfaceKind Kind, typename Exec>
void gather_triangles(Exec& exec,
                      const DeviceGeometry& scene,
                      const DenseSums& sums,
                      const BatchPairs& pairs) {
    const executor::Array<BlockPair>& of_kind = pairs.of[number_of(Kind)];
    exec.set_phase("gather of triangles");
    exec.for_each(of_kind.size(),
                  GatherTriangleOp<Kind>{scene.surfaces, scene.units, sums, of_kind.data()});
}

/// Adds a batch's triangles of one kind to the normals or to the slabs of its voxels.
/// @tparam Slabs  DenseAreas or DenseSlabs
template <typename Slabs, SurfaceKind Kind, typename Exec>
void widen_slabs_of(Exec& exec,
                    const DeviceGeometry& scene,
                    const BatchBlock* blocks,
                    const BatchPairs& pairs,
                    const BatchSlabs& slabs) {
    const executor::Array<BlockPair>& of_kind = pairs.of[number_of(Kind)];
    exec.for_each(of_kind.size(), WidenSlabsOp<Kind, Slabs>{scene.surfaces, scene.units.n, blocks,
                                                            of_kind.data(), slabs});
}

/// The same for all kinds.
template <typename Slabs, typename Exec>
void widen_slabs(Exec& exec,
                 const DeviceGeometry& scene,
                 const BatchBlock* blocks,
                 const BatchPairs& pairs,
                 const BatchSlabs& slabs) {
    widen_slabs_of<Slabs, SurfaceKind::Constant>(exec, scene, blocks, pairs, slabs);
    widen_slabs_of<Slabs, SurfaceKind::Shaded>(exec, scene, blocks, pairs, slabs);
    widen_slabs_of<Slabs, SurfaceKind::Displaced>(exec, scene, blocks, pairs, slabs);
}

/// Fits the slabs of level 0 of a batch, as SlabFitter does.
/// @throws Error  OutOfMemory, Device
template <typename Exec>
void fit_slabs(Exec& exec,
               const DeviceGeometry& scene,
               const BatchBlock* blocks,
               const BatchPairs& pairs,
               LevelArrays& level) {
    exec.set_phase("slabs");
    const std::size_t n = level.voxel_count;
    level.slabs = exec.template make<OpenSlab>(n);
    const auto moment = exec.template make_zero<std::uint64_t>(6 * n);
    const auto reach = exec.template make_zero<std::uint32_t>(2 * n);
    exec.for_each(
        n, OpenSlabsOp{scene.fit, level.first_lobe.data(), level.lobes.data(), level.slabs.data()});
    const BatchSlabs slabs{level.key.data(),
                           level.first_lobe.data(),
                           level.lobes.data(),
                           level.slabs.data(),
                           moment.data(),
                           reach.data(),
                           n,
                           scene.fit.max_lobes,
                           slab_faces(scene.fit.voxel_size)};
    widen_slabs<DenseAreas>(exec, scene, blocks, pairs, slabs);
    exec.for_each(n, TurnSlabsOp{moment.data(), scene.fit.voxel_size, level.slabs.data()});
    widen_slabs<DenseSlabs>(exec, scene, blocks, pairs, slabs);
    exec.for_each(n, CloseSlabsOp{reach.data(), level.slabs.data()});
}

/// Returns level 0 of a batch of blocks, gathered from the primitives and fitted.
/// @throws Error  OutOfMemory, Device
template <typename Exec>
[[nodiscard]] LevelArrays gather_batch(Exec& exec,
                                       const DeviceGeometry& scene,
                                       BlockBatch& batch,
                                       std::uint32_t* slot_of_block) {
    const BatchPairs pairs = list_pairs(exec, scene, batch, slot_of_block);
    exec.set_phase("sums");
    const std::size_t n = batch.blocks.size();
    std::size_t planes = 0;
    bool merging = false;
    for (const BatchBlock& block : batch.blocks) {
        planes += block.planes;
        merging = merging || block.planes > 1;
    }
    const auto blocks = exec.make_from(std::span<const BatchBlock>(batch.blocks));
    const auto masks =
        exec.template make_zero<std::uint64_t>(n * kVoxelsPerBlock * DenseLobe::kMaskWords);
    const auto lobes =
        exec.template make_zero<std::uint64_t>(planes * kVoxelsPerBlock * DenseLobe::kLobeWords);
    const auto maps = exec.template make_zero<std::uint64_t>(
        scene.fit.fields.map_sums() ? planes * kVoxelsPerBlock * DenseLobe::kMapWords : 0);
    const DenseSums sums{blocks.data(), masks.data(), lobes.data(), maps.data()};
    const FiberBatch fibers{scene.fibers, scene.tables, scene.units, sums};
    gather_plain(exec, fibers, pairs.of[number_of(PrimitiveKind::Plain)]);
    gather_yarns(exec, fibers, pairs.of[number_of(PrimitiveKind::Yarn)]);
    gather_triangles<SurfaceKind::Constant>(exec, scene, sums, pairs);
    gather_triangles<SurfaceKind::Shaded>(exec, scene, sums, pairs);
    gather_triangles<SurfaceKind::Displaced>(exec, scene, sums, pairs);
    LevelArrays level0 = fit_sums(exec, sums, n, merging, scene.fit);
    if (scene.fit.fields.slabs) fit_slabs(exec, scene, blocks.data(), pairs, level0);
    return level0;
}

} // namespace heddle
