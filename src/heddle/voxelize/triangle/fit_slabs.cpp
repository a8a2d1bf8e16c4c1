#include <heddle/voxelize/triangle/fit_slabs.h>

#include <heddle/voxel/leaf_voxels.h>
#include <heddle/voxelize/triangle/slab_op.h>

#include <algorithm>

namespace heddle {
namespace {

constexpr std::size_t kCells = std::size_t{kBlockVoxels} * kBlockVoxels * kBlockVoxels;

} // namespace

/// The slabs of a block for the triangles of one material (slab_op.h).
struct SlabFitter::Slabs {
    static constexpr bool kMeasuresAreas = false;
    const std::uint16_t* number;
    Voxel* voxels;
    const Lobe* lobes;
    int max_lobes;
    std::uint32_t material;

    [[nodiscard]] HEDDLE_HOST_INLINE int find(int cell) const {
        const std::uint16_t voxel = number[cell];
        if (voxel == kNone) return -1;
        const Voxel& of = voxels[voxel];
        return of.material == material || was_merged(of) ? voxel : -1;
    }
    [[nodiscard]] HEDDLE_HOST_INLINE Vec3d gradient(int voxel) const {
        return voxels[voxel].gradient;
    }
    HEDDLE_HOST_INLINE void widen(int voxel, int lo, int hi) const {
        Voxel& of = voxels[voxel];
        of.lo = static_cast<std::uint8_t>(std::min<int>(of.lo, lo));
        of.hi = static_cast<std::uint8_t>(std::max<int>(of.hi, hi));
    }

private:
    /// Returns true if the material may have been merged into another one's lobe.
    [[nodiscard]] bool was_merged(const Voxel& of) const {
        if (of.lobe_count < max_lobes) return false;
        const Lobe* const first = lobes + of.first_lobe;
        return std::none_of(first, first + of.lobe_count,
                            [&](const Lobe& lobe) { return lobe.material == material; });
    }
};

/// The same for the normals.
struct SlabFitter::Areas : Slabs {
    static constexpr bool kMeasuresAreas = true;
    Vec3d faces; ///< slab_faces()

    HEDDLE_HOST_INLINE void add_area(int voxel, Vec3d area) const {
        add_area_moment(area * faces, voxels[voxel].moment);
    }
};

SlabFitter::SlabFitter(const SurfaceSource& surfaces, const FitOptions& options)
    : surfaces_(surfaces), options_(options) {}

void SlabFitter::list_voxels(const VoxelBlock& block, Vec3i lo) {
    number_.assign(kCells, kNone);
    voxels_.resize(block.coverage.size());
    for_each_voxel(block, [&](const BlockVoxel& from) {
        const Lobe& first = from.lobes().front();
        Voxel& voxel = voxels_[from.voxel];
        voxel = {};
        voxel.first_lobe = static_cast<std::uint32_t>(from.lobe);
        voxel.lobe_count = static_cast<std::uint8_t>(from.lobe_count());
        voxel.material = first.material;
        if (!options_.normals.has(first.material)) return;
        const Vec3i at = from.at - lo;
        const int cell = (at.x * kBlockVoxels + at.y) * kBlockVoxels + at.z;
        number_[static_cast<std::size_t>(cell)] = static_cast<std::uint16_t>(from.voxel);
    });
}

void SlabFitter::fit(std::span<const Primitive> triangles,
                     Vec3i lo,
                     Vec3i hi,
                     const Progress& progress,
                     VoxelBlock& block) {
    block.slabs.assign(block.coverage.size(), PlaneSlab{});
    if (triangles.empty() || block.coverage.empty()) return;
    list_voxels(block, lo);
    const SurfaceView& view = surfaces_.view();
    Slabs slabs{number_.data(), voxels_.data(), block.lobes.data(), options_.max_lobes, 0};
    const auto visit = [&](auto to) {
        std::size_t done = 0;
        for (const Primitive id : triangles) {
            if (done++ % 256 == 0) progress.check();
            const TriangleId at = view.place(triangle_of(id));
            to.material = view.meshes[at.mesh].material;
            widen_slabs(view, at, options_.subvoxels, lo, hi, to, scratch_);
        }
    };
    const Vec3d edges = options_.voxel_size;
    visit(Areas{slabs, slab_faces(edges)});
    for (Voxel& voxel : voxels_) {
        voxel.normal = main_normal(voxel.moment);
        voxel.gradient = slab_gradient(unpack_normal(voxel.normal), edges);
    }
    visit(slabs);
    for (std::size_t v = 0; v < voxels_.size(); ++v) {
        const Voxel& of = voxels_[v];
        if (of.lo <= of.hi) block.slabs[v] = {of.lo, of.hi, of.normal};
    }
}

std::int64_t SlabFitter::byte_count() {
    return static_cast<std::int64_t>(kCells * (sizeof(std::uint16_t) + sizeof(Voxel)));
}

} // namespace heddle
