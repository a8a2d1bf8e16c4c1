#include <heddle/viewer/volume/measure_voxels.h>

#include <heddle/preview/preview_volume.h>
#include <heddle/voxel/index_box.h>

#include <algorithm>
#include <span>

namespace heddle::viewer {
namespace {

using Table = preview::PreviewVolume::Table;

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
    const IndexBox box = box_of(leaf);
    if (box.empty()) return;
    Bounds of_leaf;
    for (int a = 0; a < 3; ++a) {
        of_leaf.lo[a] = box.lo[a] * h[a];
        of_leaf.hi[a] = (box.hi[a] + 1) * h[a];
    }
    to.grow(of_leaf);
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

VoxelMeasure measure_voxels(const VoxelLevel& source, Progress& progress) {
    VoxelMeasure out;
    VoxelBlock scratch;
    for (std::size_t i = 0; i < source.block_count(); ++i) {
        progress.check();
        for (const VoxelLeaf& leaf : source.block(i, scratch).leaves) {
            out.bytes.leaves += static_cast<std::int64_t>(4 * kLeafWords);
            out.bytes.voxels += 4 * static_cast<std::int64_t>(leaf.voxel_count());
            grow(out.bounds, leaf, source.info().lattice.voxel_size);
            push_new(out.cells, shifted(leaf.origin, Table::kTileShift));
            push_new(out.blocks, shifted(leaf.origin, kBlockShift));
        }
        progress.advance(1);
    }
    sort_unique(out.cells);
    sort_unique(out.blocks);
    out.bytes.cells = box_bytes(out.cells);
    out.bytes.leaf_table = static_cast<std::int64_t>(4 * Table::kTileLeaves * out.cells.size());
    return out;
}

} // namespace heddle::viewer
