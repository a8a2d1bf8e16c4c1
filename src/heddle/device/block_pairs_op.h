#pragma once

#include <heddle/device/level/dense_sums.h>
#include <heddle/executor/atomic.h>
#include <heddle/surface/surface_view.h>
#include <heddle/voxelize/bin_op.h>
#include <heddle/voxelize/block/primitive.h>
#include <heddle/yarn/fiber_view.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace heddle {

/// The kind of a primitive. Each kind is gathered in a pass of its own, with its own list of pairs.
enum class PrimitiveKind : std::uint8_t {
    Plain,   ///< a piece of a single curve
    Yarn,    ///< a piece of a yarn of fibers
    Triangle ///< first of the triangles' kinds: Triangle + SurfaceKind of the mesh
};
constexpr std::size_t kPrimitiveKinds = 5;

[[nodiscard]] HEDDLE_HD constexpr std::size_t number_of(PrimitiveKind kind) {
    return static_cast<std::size_t>(kind);
}
[[nodiscard]] HEDDLE_HD constexpr std::size_t number_of(SurfaceKind kind) {
    return number_of(PrimitiveKind::Triangle) + static_cast<std::size_t>(kind);
}

/// Returns the kind of a set's pieces.
[[nodiscard]] HEDDLE_HD inline PrimitiveKind kind_of(const CurveSetView& set) {
    return set.length != nullptr ? PrimitiveKind::Yarn : PrimitiveKind::Plain;
}

/// A primitive, and a block of the batch that it touches.
struct BlockPair {
    Primitive primitive = 0;
    std::uint32_t slot = 0; ///< number of the block in the batch
    std::uint32_t spare = 0;
};
static_assert(sizeof(BlockPair) == 16);

/// Counts the primitives of each kind in each block of the range.
struct CountPairs {
    std::uint32_t* counts[kPrimitiveKinds]; ///< per block of the range; null: no primitives of it

    HEDDLE_HD void add(std::size_t kind, Primitive, std::uint64_t block, std::uint32_t) const {
        executor::atomic_add(counts[kind] + block, 1);
    }
};

/// Lists the pairs of a batch, block by block, in any order within a block.
struct ListPairs {
    const std::uint32_t* slot_of_block;   ///< per block of the range; kNoSlot: not in the batch
    BatchBlock* blocks;                   ///< their materials are set
    std::uint64_t* next[kPrimitiveKinds]; ///< per slot: position of its next pair
    BlockPair* pairs[kPrimitiveKinds];

    static constexpr std::uint32_t kNoSlot = 0xffffffffu;

    HEDDLE_HD void
    add(std::size_t kind, Primitive primitive, std::uint64_t block, std::uint32_t material) const {
        const std::uint32_t slot = slot_of_block[block];
        if (slot == kNoSlot) return;
        const std::uint64_t at = executor::atomic_add(next[kind] + slot, 1);
        pairs[kind][at] = {primitive, slot, 0};
        executor::atomic_or(&blocks[slot].materials.words[material / 64],
                            MaterialSet::bit_of(material));
    }
};

/// Calls to.add() for each piece of a span with each block that it may touch.
template <typename To>
struct WalkSpanOp {
    FiberView fibers;
    LatticeUnits units;
    BlockRange range;
    To to;

    HEDDLE_HD void operator()(std::size_t span) const {
        const FiberPiece whole = fibers.whole_span(span);
        const CurveSetView& set = fibers.sets[whole.set];
        Visit visit{*this, number_of(kind_of(set)), 0, set.material};
        for (std::uint32_t part = 0; part < whole.parts; ++part) {
            visit.id = pack_piece(span, part);
            for_each_block(fibers, part_of(whole, part), units, range, visit);
        }
    }

private:
    struct Visit {
        const WalkSpanOp& op;
        std::size_t kind;
        Primitive id;
        std::uint32_t material;
        HEDDLE_HD void operator()(int x, int y, int z) const {
            op.to.add(kind, id, op.range.number({x, y, z}), material);
        }
    };
};

/// Calls to.add() for a triangle with each block that it may touch.
template <typename To>
struct WalkTriangleOp {
    SurfaceView surfaces;
    LatticeUnits units;
    BlockRange range;
    To to;

    HEDDLE_HD void operator()(std::size_t triangle) const {
        const TriangleId at = surfaces.place(triangle);
        const MeshView& mesh = surfaces.meshes[at.mesh];
        const std::array<std::uint32_t, 3> c = mesh.triangles[at.triangle];
        const Vec3f corners[3] = {mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]]};
        for_each_block(corners, mesh.displacement, units, range,
                       Visit{*this, number_of(mesh.kind), pack_triangle(triangle), mesh.material});
    }

private:
    struct Visit {
        const WalkTriangleOp& op;
        std::size_t kind;
        Primitive id;
        std::uint32_t material;
        HEDDLE_HD void operator()(int x, int y, int z) const {
            op.to.add(kind, id, op.range.number({x, y, z}), material);
        }
    };
};

} // namespace heddle
