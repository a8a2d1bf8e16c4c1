#pragma once

#include <heddle/base/vec.h>
#include <heddle/sggx/packed.h>
#include <heddle/voxel/voxel_level.h>

namespace heddle {

/// Converts a sample of a Mitsuba 0.6 medium to the values of a voxel.
///
/// Extinction along the unit vector w, with the medium's `scale` s:
///     sigma(w) = 2 s density mean |w . m|                       [Jakob10; Mitsuba 0.6, microflake]
/// over the flakes' normals m. These are perpendicular to the tangent t, which gives (4 / pi) s
/// density sin(angle of w and t); without a direction they are uniform, which gives s density. (The
/// factor 2 is Mitsuba's: a medium of isotropic flakes is then equal to one without flakes.)
/// Coverage along axis a: 1 - exp(-sigma(a) h_a), at most 1 - 1 / (2 subvoxels^2).
/// Occupancy: 1 - exp(-d / subvoxels), where d is the mean of sigma(a) h_a over the axes: the
/// fraction of subvoxels that are hit if each is hit independently and columns have this coverage.
class VolMedium {
public:
    static constexpr int kSubvoxels = 8;

    /// @param voxel_size  scene units, > 0
    /// @param scale       extinction per scene unit at density 1, > 0
    VolMedium(Vec3d voxel_size, double scale);

    /// @param density  in [0, 1]
    /// @param tangent  unit, or zero: no direction
    [[nodiscard]] Coverage coverage(float density, Vec3f tangent) const;

    /// The distribution of tangents: a needle as narrow as fit_sggx allows, or uniform.
    /// @param tangent  unit, or zero: no direction
    [[nodiscard]] static PackedSggx lobe(Vec3f tangent);

private:
    Vec3d depth_; ///< scale x voxel size
};

/// The scale at which density 1 without a direction covers 86 % of a voxel's face (depth 2).
///
/// Densities of a .vol are relative; the scale that makes them absolute is in a scene file. Scarves
/// and the like are opaque after about a voxel: the scale of the scarf [Jakob10], 100 at voxels of
/// 0.02, is this one.
[[nodiscard]] double default_density_scale(Vec3d voxel_size);

} // namespace heddle
