#pragma once

#include <heddle/leaf_table/leaf_table.h>
#include <heddle/sggx/sggx.h>
#include <heddle/voxel/leaf_voxels.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// One unit of a PackedFlake's entries. Rounded to it, a matrix moves by at most 5e-5 of its
/// largest eigenvalue: a twentieth of the smallest, so it stays positive definite.
inline constexpr float kFlakeUnit = 1.0f / 32767.0f;
/// Smallest eigenvalue of a flake's S, of the largest: seen end on, a fiber hides 3 % of its side.
inline constexpr float kMinFlake = 1e-3f;

/// An SGGX of normals, largest eigenvalue 1: xx yy zz xy xz yz in kFlakeUnit.
using PackedFlake = std::array<std::int16_t, 6>;

[[nodiscard]] PackedFlake pack_flake(const SggxMatrix& S);
[[nodiscard]] inline SggxMatrix unpack_flake(const PackedFlake& p) {
    const auto unit = [&](std::size_t i) { return kFlakeUnit * static_cast<float>(p[i]); };
    return {unit(0), unit(1), unit(2), unit(3), unit(4), unit(5)};
}

/// Flakes at the centres of a box of voxels, x fastest.
struct FlakeBlock {
    std::vector<float> sigma_t; ///< per scene unit; extinction along w is sigma_t sqrt(w^T S w)
    std::vector<PackedFlake> S;
    std::vector<Vec3f> albedo; ///< empty where it does not vary
};

/// A voxel grid as one SGGX of flakes a voxel: what a renderer of grids of sigma_t and S takes.
///
/// A voxel's lobes become one SGGX of normals: fibers' tangents with second moment M are
/// normals with (I - M) / 2, surfaces' lobes are as they are; the weighted mean of the moments is
/// fitted. S is scaled to a largest eigenvalue of 1, and sigma_t so that the mean over the axes of
/// sigma_t sqrt(S_aa) is that of -ln(1 - coverage_a) / h_a. S, and the albedo, grow by two voxels
/// into emptiness (means of the known of six neighbours) and are isotropic beyond: what lies
/// between two voxels' centres is interpolated, and S is never 0.
class FlakeField {
public:
    /// Copies what it needs of `source`. Memory: 16 bytes a voxel, 3 more where albedo varies.
    /// @param albedo  of each of the grid's materials, linear
    FlakeField(const VoxelLevel& source, std::span<const Vec3f> albedo);

    /// Voxel indices that hold all voxels: [lo, hi); lo = hi where there are none.
    [[nodiscard]] Vec3i lo() const { return lo_; }
    [[nodiscard]] Vec3i hi() const { return hi_; }
    [[nodiscard]] Vec3d voxel_size() const { return voxel_size_; }
    [[nodiscard]] bool albedo_varies() const { return !albedo_.empty(); }
    /// Where it does not vary.
    [[nodiscard]] Vec3f albedo() const { return one_albedo_; }
    /// Corners of the 8^3 leaves that hold voxels.
    [[nodiscard]] const std::vector<Vec3i>& origins() const { return origins_; }

    /// Flakes of the voxels [low, low + size). Safe from several threads.
    /// @param size  > 0 on each axis
    void fill(Vec3i low, Vec3i size, FlakeBlock& out) const;
    /// True where one of those voxels has extinction.
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
