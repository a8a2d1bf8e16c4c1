#pragma once

#include <heddle/sggx/eigen.h>
#include <heddle/slice/test_slices.h>
#include <heddle/voxelize/test_voxelize.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

// Compares two voxelizations of the same slices, for tests and the tables of bench/.

namespace heddle::raster::test {

/// Returns the mean extinction of a voxel over its three axes, per voxel edge, like `density` of a
/// .vdb.
inline double density_of(const Coverage& coverage, int columns) {
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double most = 1.0 - 0.5 / columns;
        sum -= std::log(1.0 - std::min(heddle::test::covered(coverage, a), most)) / 3.0;
    }
    return sum;
}

/// Returns the main axis of a voxel's directions.
inline Vec3d axis_of(const BlockVoxel& voxel) {
    double sum[6]{};
    double weight = 0.0;
    for (const LobeMoment& lobe : voxel.moments()) {
        for (std::size_t i = 0; i < 6; ++i) sum[i] += static_cast<double>(lobe.moment[i]);
        weight += static_cast<double>(lobe.weight);
    }
    const auto of = [&](int i) { return static_cast<float>(sum[i] / weight); };
    return to_double(principal_direction({of(0), of(1), of(2), of(3), of(4), of(5)}));
}

/// All stored data of a level, voxel by voxel.
struct Stored {
    Vec3i at;
    Coverage coverage;
    std::vector<Lobe> lobes;
    std::array<std::uint64_t, 3> columns{};
    friend bool operator==(const Stored&, const Stored&) = default;
};

inline std::vector<Stored> stored(const VoxelLevel& source) {
    std::vector<Stored> out;
    for_each_voxel(source, [&](const BlockVoxel& v) {
        out.push_back({v.at, v.coverage(), {v.lobes().begin(), v.lobes().end()}, v.columns()});
    });
    std::sort(out.begin(), out.end(), [](const Stored& a, const Stored& b) {
        return std::tie(a.at.x, a.at.y, a.at.z) < std::tie(b.at.x, b.at.y, b.at.z);
    });
    return out;
}

/// How a second voxelization differs from a first.
struct Difference {
    double density = 0.0;   ///< ratio of the sums of density_of
    double coverage = 0.0;  ///< ratio of the sums of coverage, all axes
    double volume = 0.0;    ///< ratio of the sums of occupancy
    double angle_deg = 0.0; ///< median angle between the axes of voxels that both have
    double far_deg = 0.0;   ///< 90 % of the angles are smaller
};

inline Difference compare(const VoxelLevel& first, const VoxelLevel& second) {
    using Key = std::tuple<int, int, int>;
    std::map<Key, Vec3d> axes;
    const int columns = first.info().lattice.subvoxels * first.info().lattice.subvoxels;
    double sums[2][3]{};
    std::vector<double> angles;
    const auto add = [&](double* sum, const BlockVoxel& v) {
        sum[0] += density_of(v.coverage(), columns);
        for (int a = 0; a < 3; ++a) sum[1] += heddle::test::covered(v.coverage(), a);
        sum[2] += v.coverage().occupancy;
    };
    for_each_voxel(first, [&](const BlockVoxel& v) {
        add(sums[0], v);
        axes[{v.at.x, v.at.y, v.at.z}] = axis_of(v);
    });
    for_each_voxel(second, [&](const BlockVoxel& v) {
        add(sums[1], v);
        const auto found = axes.find({v.at.x, v.at.y, v.at.z});
        if (found == axes.end()) return;
        const double cosine = std::abs(dot(found->second, axis_of(v)));
        angles.push_back(std::acos(std::min(cosine, 1.0)) * 57.29577951308232);
    });
    std::sort(angles.begin(), angles.end());
    Difference out{sums[1][0] / sums[0][0], sums[1][1] / sums[0][1], sums[1][2] / sums[0][2]};
    if (angles.empty()) return out;
    out.angle_deg = angles[angles.size() / 2];
    out.far_deg = angles[angles.size() * 9 / 10];
    return out;
}

} // namespace heddle::raster::test
