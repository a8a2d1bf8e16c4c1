#pragma once

#include <heddle/voxelize/fiber/gather_kernels.h>

#include <cmath>
#include <cstdint>

namespace heddle {

/// How CoverageMode::Mask samples a span, and the position of a chord on it.
struct SpanSamples {
    std::int64_t count = 0; ///< samples of the whole span; 0: two per subvoxel
    double begin = 0.0;     ///< start and end of the chord as fractions of the span
    double end = 1.0;
};

/// Sets the subvoxels of sample points on a chord's axis, and pools its direction in their voxels,
/// as a sampling voxelizer that ignores the fiber's thickness does [Fabre26, 3.2 to 3.4]
/// @param anchor  voxel that the chord's positions are relative to, relative to the block's lo
inline void gather_samples(const Chord& chord,
                           Vec3i anchor,
                           const GatherTarget& target,
                           const SpanSamples& samples) {
    const LatticeUnits& u = target.units;
    const bool dense = samples.count == 0;
    const double first =
        dense ? 0.0 : std::ceil(samples.begin * static_cast<double>(samples.count) - 0.5);
    const double last = dense ? std::ceil(2.0 * static_cast<double>(chord.length))
                              : std::ceil(samples.end * static_cast<double>(samples.count) - 0.5);
    const double width = samples.end - samples.begin;
    const double all = static_cast<double>(dense ? 1 : samples.count);
    const auto spacing =
        static_cast<float>(dense ? static_cast<double>(chord.length) / last
                                 : static_cast<double>(chord.length) / (width * all));
    const DirectionMoment moment(chord.dir);
    const int low = (1 << target.shift) - 1;
    for (double k = first; k < last; k += 1.0) {
        const double f = dense ? (k + 0.5) / last : ((k + 0.5) / all - samples.begin) / width;
        const Vec3f p = chord.start + chord.dir * (static_cast<float>(f) * chord.length);
        Vec3i sub;
        Vec3i at;
        bool inside = true;
        for (int a = 0; a < 3; ++a) {
            sub[a] = floor_to_int(p[a] * u.inv_edge[a]);
            at[a] = (sub[a] >> target.shift) + anchor[a];
            inside = inside && at[a] >= 0 && at[a] < target.size[a];
        }
        if (!inside) continue;
        VoxelSums& voxel = target.block.voxel(at.x, at.y, at.z);
        const int bit =
            ((((sub.x & low) << target.shift) | (sub.y & low)) << target.shift) | (sub.z & low);
        voxel.sub[static_cast<std::size_t>(bit >> 6)] |= std::uint64_t{1} << (bit & 63);
        pool_moment(target.block, voxel, moment.v, 2.0f * chord.radius * spacing, target.paint);
    }
}

} // namespace heddle
