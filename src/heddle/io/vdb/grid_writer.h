#pragma once

#include <heddle/base/error.h>
#include <heddle/base/function_ref.h>
#include <heddle/base/parallel.h>
#include <heddle/base/progress.h>
#include <heddle/io/vdb/vdb_leaves.h>

#include <openvdb/io/Compression.h>
#include <openvdb/util/NodeMasks.h>

#include <algorithm>
#include <iostream>
#include <numeric>
#include <span>
#include <sstream>
#include <string>
#include <vector>

// The two parts of a VDB grid that depend on its voxels, with the bytes that a tree of the standard
// configuration (5, 4, 3 bits) writes with active-mask and Blosc compression.

namespace heddle {

template <typename T>
void write_raw(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// The values of a node, which has no active ones: all are background.
/// @param half  VDB's half-float grids write nothing if there is no value, others an empty chunk
template <typename T>
void write_values(std::ostream& out, const T* values, std::size_t n, bool half) {
    write_raw(out, std::int8_t{openvdb::io::NO_MASK_OR_INACTIVE_VALS});
    if (half && n == 0) return;
    openvdb::io::bloscToStream(out, reinterpret_cast<const char*>(values), sizeof(T), n);
}

/// The end of the run of leaves from `begin` on that share a node of 2^bits voxels per axis.
inline std::size_t node_end(std::span<const LeafRef> leaves, std::size_t begin, int bits) {
    const Vec3i node = node_origin(leaves[begin].origin, bits);
    std::size_t end = begin;
    while (end < leaves.size() && node_origin(leaves[end].origin, bits) == node) ++end;
    return end;
}

/// The masks of an internal node whose children contain `leaves`; there are no active tiles.
template <typename T, openvdb::Index Log2Dim>
void write_node(
    std::ostream& out, std::span<const LeafRef> leaves, int node_bits, int child_bits, bool half) {
    openvdb::util::NodeMask<Log2Dim> child;
    for (const LeafRef& leaf : leaves) {
        child.setOn(child_offset(leaf.origin, node_bits, child_bits));
    }
    child.save(out);
    openvdb::util::NodeMask<Log2Dim>().save(out);
    const T none{};
    write_values(out, &none, 0, half);
}

/// @param leaves  in tree order; none is empty
template <typename T>
void write_topology(std::ostream& out, std::span<const LeafRef> leaves, bool half) {
    std::uint32_t roots = 0;
    for (std::size_t i = 0; i < leaves.size(); i = node_end(leaves, i, 12)) ++roots;
    write_raw(out, std::int32_t{1});  // buffers
    write_raw(out, T{});              // background
    write_raw(out, std::uint32_t{0}); // tiles of the root
    write_raw(out, roots);
    for (std::size_t i = 0; i < leaves.size();) {
        const std::size_t root_end = node_end(leaves, i, 12);
        write_raw(out, node_origin(leaves[i].origin, 12));
        write_node<T, 5>(out, leaves.subspan(i, root_end - i), 12, 7, half);
        while (i < root_end) {
            const std::size_t end = node_end(leaves, i, 7);
            write_node<T, 4>(out, leaves.subspan(i, end - i), 7, 3, half);
            for (; i < end; ++i) write_raw(out, leaves[i].active);
        }
    }
}

/// The leaves [begin, end) of a table, grouped by their block: group g is order[first[g]] ..
/// order[first[g + 1] - 1].
struct LeavesByBlock {
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> first;

    LeavesByBlock(std::span<const LeafRef> leaves, std::size_t begin, std::size_t end)
        : order(end - begin) {
        std::iota(order.begin(), order.end(), static_cast<std::uint32_t>(begin));
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return leaves[a].block < leaves[b].block;
        });
        for (std::uint32_t i = 0; i < order.size(); ++i) {
            if (i == 0 || leaves[order[i]].block != leaves[order[i - 1]].block) first.push_back(i);
        }
        first.push_back(static_cast<std::uint32_t>(order.size()));
    }

    /// Calls body(group, leaf index, block, leaf) on all threads; each group runs on one.
    using Body = FunctionRef<void(std::size_t, std::size_t, const VoxelBlock&, const VoxelLeaf&)>;
    void run(const VoxelLevel& source, std::span<const LeafRef> leaves, Body body) const {
        parallel_chunks(first.size() - 1, 1, [&](std::size_t g, std::size_t) {
            VoxelBlock scratch;
            const VoxelBlock& block = source.block(leaves[order[first[g]]].block, scratch);
            for (std::uint32_t i = first[g]; i < first[g + 1]; ++i) {
                body(g, order[i], block, block.leaves[leaves[order[i]].leaf]);
            }
        });
    }
};

// The two operations of a kind of grid on a leaf. They are passed by reference, so that the code
// below is compiled once per type of value, not per kind of grid.
using LeafSelect = FunctionRef<LeafMask(const VoxelBlock&, const VoxelLeaf&)>;
/// Writes the values of the active voxels to a buffer of 512; returns their number.
template <typename Value>
using LeafGather = FunctionRef<std::size_t(const VoxelBlock&, const VoxelLeaf&, Value*)>;

/// The leaves with at least one voxel that is active in the grid, with the masks of these voxels.
inline std::vector<LeafRef>
select_leaves(const VoxelLevel& source, std::span<const LeafRef> all, LeafSelect select) {
    std::vector<LeafRef> leaves(all.begin(), all.end());
    LeavesByBlock(all, 0, all.size())
        .run(source, all,
             [&](std::size_t, std::size_t i, const VoxelBlock& block, const VoxelLeaf& leaf) {
                 leaves[i].active = select(block, leaf);
             });
    std::erase_if(leaves, [](const LeafRef& leaf) { return leaf.active == LeafMask{}; });
    return leaves;
}

/// The number of leaves that are encoded before they are written: whole nodes of 128^3 voxels, so
/// that a block of the source, which is inside of one node, is requested once.
inline constexpr std::size_t kBatchLeaves = 4096;

/// Encodes the masks and values of the leaves, in order.
template <typename Value>
void write_buffers(std::ostream& out,
                   const VoxelLevel& source,
                   std::span<const LeafRef> leaves,
                   LeafGather<Value> gather,
                   Progress& progress) {
    struct Slice {
        std::size_t group = 0, begin = 0, end = 0;
    };
    for (std::size_t begin = 0; begin < leaves.size();) {
        std::size_t end = begin;
        while (end < leaves.size() && end - begin < kBatchLeaves) end = node_end(leaves, end, 7);
        const LeavesByBlock groups(leaves, begin, end);
        std::vector<std::ostringstream> encoded(groups.first.size() - 1);
        std::vector<Slice> slices(end - begin);
        groups.run(
            source, leaves,
            [&](std::size_t g, std::size_t i, const VoxelBlock& block, const VoxelLeaf& leaf) {
                Value buffer[512];
                const std::size_t n = gather(block, leaf, buffer);
                const auto from = static_cast<std::size_t>(encoded[g].tellp());
                write_raw(encoded[g], leaves[i].active);
                write_values(encoded[g], buffer, n, false);
                slices[i - begin] = {g, from, static_cast<std::size_t>(encoded[g].tellp())};
            });
        for (const Slice& s : slices) {
            const std::string_view bytes = encoded[s.group].view();
            out.write(bytes.data() + s.begin, static_cast<std::streamsize>(s.end - s.begin));
        }
        progress.check();
        progress.advance(static_cast<std::int64_t>(end - begin));
        begin = end;
    }
}

} // namespace heddle
