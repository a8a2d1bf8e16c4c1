#pragma once

#include <heddle/leaf_table/leaf_table.h>
#include <heddle/sggx/sggx.h>
#include <heddle/voxel/leaf_voxels.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// One unit of a PackedFlake's entries. Rounding to it changes a matrix by at most 5e-5 of its
/// largest eigenvalue, a twentieth of the smallest, so it stays positive definite.
inline constexpr float kFlakeUnit = 1.0f / 32767.0f;
/// Smallest ratio of the eigenvalues of a flake's S: seen end on, a fiber covers 3 % of its side
/// view.
inline constexpr float kMinFlake = 1e-3f;

/// An SGGX of normals with largest eigenvalue 1: xx yy zz xy xz yz in units of kFlakeUnit.
using PackedFlake = std::array<std::int16_t, 6>;

[[nodiscard]] PackedFlake pack_flake(const SggxMatrix& S);
[[nodiscard]] inline SggxMatrix unpack_flake(const PackedFlake& p) {
    const auto unit = [&](std::size_t i) { return kFlakeUnit * static_cast<float>(p[i]); };
    return {unit(0), unit(1), unit(2), unit(3), unit(4), unit(5)};
}

/// The microflakes at the centres of a box of voxels, x fastest.
struct FlakeBlock {
    std::vector<float> sigma_t; ///< per scene unit; extinction along w is sigma_t sqrt(w^T S w)
    std::vector<PackedFlake> S;
    std::vector<Vec3f> albedo; ///< empty if it does not vary
};

/// A voxel level as one SGGX of microflakes per voxel, for renderers that take grids of sigma_t and
/// S.
///
/// A voxel's lobes are merged into one SGGX of normals: a fiber's tangents with second moment M
/// become normals with (I - M) / 2, a surface's lobes are unchanged, and S is fitted to the
/// weighted mean of the moments. S is scaled to a largest eigenvalue of 1, and sigma_t so that the
/// mean over the axes of sigma_t sqrt(S_aa) is that of -ln(1 - coverage_a) / h_a. Renderers
/// interpolate between voxel centres, where S must not be 0. So S and the albedo are extended by
/// two voxels into empty space (the mean of the known ones of six neighbours), and are isotropic
/// beyond.
class FlakeField {
public:
    /// Copies what it needs of `source`. Memory: 16 bytes per voxel, 3 more if the albedo varies.
    /// @param albedo  linear albedo of each material of the level
    FlakeField(const VoxelLevel& source, std::span<const Vec3f> albedo);

    /// The range [lo, hi) of indices that contains all voxels; lo = hi if there are none.
    [[nodiscard]] Vec3i lo() const { return lo_; }
    [[nodiscard]] Vec3i hi() const { return hi_; }
    [[nodiscard]] Vec3d voxel_size() const { return voxel_size_; }
    [[nodiscard]] bool albedo_varies() const { return !albedo_.empty(); }
    /// Returns the albedo if it does not vary.
    [[nodiscard]] Vec3f albedo() const { return one_albedo_; }
    /// Returns the origins of the leaves that contain voxels.
    [[nodiscard]] const std::vector<Vec3i>& origins() const { return origins_; }

    /// Sets `out` to the microflakes of the voxels [low, low + size). Thread-safe.
    /// @param size  > 0 on each axis
    void fill(Vec3i low, Vec3i size, FlakeBlock& out) const;
    /// Returns true if any voxel of [low, low + size) has extinction.
    [[nodiscard]] bool any(Vec3i low, Vec3i size) const;

private:
    struct FlakeLeaf {
        std::array<std::uint64_t, 8> active{};
        std::size_t first = 0;
    };
    struct Draft;
    void
    add_voxel(const VoxelLevelInfo& info, const BlockVoxel& voxel, std::span<const Vec3f> albedo);
    void drop_equal_albedo();
    template <typename Visit>
    void for_each_in_box(Vec3i low, Vec3i size, const Visit& visit) const;

    Vec3d voxel_size_{};
    Vec3i lo_{}, hi_{};
    Vec3f one_albedo_{0.8f, 0.8f, 0.8f};
    LeafTable<3> table_;
    std::vector<FlakeLeaf> leaves_; ///< by the table's numbers
    std::vector<Vec3i> origins_;
    std::vector<float> sigma_t_;
    std::vector<PackedFlake> S_;
    std::vector<std::array<std::uint8_t, 3>> albedo_;
};

} // namespace heddle
