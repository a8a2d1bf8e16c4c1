#include <heddle/viewer/volume/measure_voxels.h>

#include <algorithm>
#include <array>
#include <bit>
#include <span>

namespace heddle::viewer {
namespace {

void sort_unique(std::vector<Vec3i>& at) {
    std::sort(at.begin(), at.end(), [](const Vec3i& a, const Vec3i& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    });
    at.erase(std::unique(at.begin(), at.end()), at.end());
}

Vec3i shifted(Vec3i v, int by) {
    return {v.x >> by, v.y >> by, v.z >> by};
}

/// Grows `to` by the voxels of a leaf.
void grow(Bounds& to, const VoxelLeaf& leaf, Vec3d h) {
    std::array<std::uint32_t, 3> seen{}; // layers by axis, one bit each
    for (std::uint32_t x = 0; x < 8; ++x) {
        for (std::uint32_t y = 0; y < 8; ++y) {
            const auto row = static_cast<std::uint32_t>(leaf.active[x] >> (8 * y) & 255);
            seen[0] |= (row != 0 ? 1u : 0u) << x;
            seen[1] |= (row != 0 ? 1u : 0u) << y;
            seen[2] |= row;
        }
    }
    Vec3d lo, hi;
    for (int a = 0; a < 3; ++a) {
        const std::uint32_t bits = seen[static_cast<std::size_t>(a)];
        if (bits == 0) return;
        lo[a] = (leaf.origin[a] + std::countr_zero(bits)) * h[a];
        hi[a] = (leaf.origin[a] + static_cast<int>(std::bit_width(bits))) * h[a];
    }
    to.grow(Bounds{lo, hi});
}

void push_new(std::vector<Vec3i>& to, Vec3i at) {
    if (to.empty() || to.back() != at) to.push_back(at);
}

/// The bytes of the bounding box of cells, occupied or not.
std::int64_t box_bytes(std::span<const Vec3i> cells) {
    if (cells.empty()) return 0;
    std::int64_t box = 4;
    for (int a = 0; a < 3; ++a) {
        const auto [lo, hi] =
            std::minmax_element(cells.begin(), cells.end(),
                                [a](const Vec3i& u, const Vec3i& v) { return u[a] < v[a]; });
        box *= std::int64_t{(*hi)[a]} - (*lo)[a] + 1;
    }
    return box;
}

} // namespace

std::int64_t VoxelTableBytes::largest() const {
    return std::max({cells, leaf_table, leaves, voxels});
}

VoxelTableBytes& VoxelTableBytes::operator+=(const VoxelTableBytes& other) {
    cells += other.cells;
    leaf_table += other.leaf_table;
    leaves += other.leaves;
    voxels += other.voxels;
    return *this;
}

VoxelMeasure measure_voxels(const VoxelSource& source, Progress& progress) {
    VoxelMeasure out;
    VoxelBlock scratch;
    for (std::size_t i = 0; i < source.block_count(); ++i) {
        progress.check();
        for (const VoxelLeaf& leaf : source.block(i, scratch).leaves) {
            out.bytes.leaves += static_cast<std::int64_t>(4 * kLeafWords);
            out.bytes.voxels += 4 * static_cast<std::int64_t>(leaf.voxel_count());
            grow(out.bounds, leaf, source.info().lattice.voxel_size);
            push_new(out.cells, shifted(leaf.origin, kCellShift));
            push_new(out.blocks, shifted(leaf.origin, kBlockShift));
        }
        progress.advance(1);
    }
    sort_unique(out.cells);
    sort_unique(out.blocks);
    out.bytes.cells = box_bytes(out.cells);
    out.bytes.leaf_table = static_cast<std::int64_t>(4 * kCellLeaves * out.cells.size());
    return out;
}

} // namespace heddle::viewer
