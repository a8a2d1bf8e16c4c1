#pragma once

#include <heddle/base/platform.h>
#include <heddle/sggx/agglomerate.h>
#include <heddle/sggx/direction_sums.h>
#include <heddle/sggx/sggx.h>

#include <cstdint>
#include <span>

namespace heddle {

/// Distance of the method `moments` below which two lobes are stored as one, even if fewer than
/// `keep` are left. Measured: sigma loses at most 2e-5 and the L1 distance of densities is 0.013;
/// packing costs 6e-4 and 0.01 to 0.02. Up to half of the lobes merge. At 1e-3 sigma loses 6e-5 and
/// L1 is up to 0.05, on flat surfaces more than the error of `wasserstein`.          [docs/sggx.md]
inline constexpr float kSameLobe = 1e-4f;

namespace detail {

/// The mean of d d^T.
/// @param moment  6 sums, as in DirectionSums::moment
[[nodiscard]] HEDDLE_HD inline SymmetricMatrix mean_moment(const std::int64_t* moment,
                                                           std::int64_t weight) {
    const double scale = 1.0 / static_cast<double>(weight);
    const auto mean = [&](int k) {
        return static_cast<float>(static_cast<double>(moment[k]) * scale);
    };
    return {mean(0), mean(1), mean(2), mean(3), mean(4), mean(5)};
}
[[nodiscard]] HEDDLE_HD inline SymmetricMatrix mean_moment(const DirectionSums& s) {
    return mean_moment(s.moment, s.weight);
}

/// The sum of the squares of all nine entries of A - B.
[[nodiscard]] HEDDLE_HD constexpr float square_distance(const SymmetricMatrix& A,
                                                        const SymmetricMatrix& B) {
    const float xx = A.xx - B.xx;
    const float yy = A.yy - B.yy;
    const float zz = A.zz - B.zz;
    const float xy = A.xy - B.xy;
    const float xz = A.xz - B.xz;
    const float yz = A.yz - B.yz;
    return (xx * xx + yy * yy + zz * zz) + 2.0f * (xy * xy + xz * xz + yz * yz);
}

/// The distance of lobes of different materials: greater than that of any lobes of one material
/// (which is below 4 in every method), and in the same order among themselves.
[[nodiscard]] HEDDLE_HD constexpr float keep_apart(float distance) {
    return (distance + 0x1p-60f) * 0x1p62f; // a product: a sum would lose small differences
}

} // namespace detail

/// True if a merged lobe takes the material and kind of `a`, not of `b`: those of the heavier lobe,
/// or, of equally heavy ones, of the lower material id.
[[nodiscard]] HEDDLE_HD constexpr bool leads(const DirectionSums& a, const DirectionSums& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.material <= b.material;
}

/// The same lobe in the other kind: normals of fibers with these tangents, or tangents that are
/// evenly spread in surfaces with these normals.
///
/// Both are the ring across d, with second moment (I - d d^T) / 2: M' = (weight I - M) / 2. Entries
/// are rounded towards 0.
[[nodiscard]] HEDDLE_HD constexpr DirectionSums turned_across(DirectionSums s) {
    for (int k = 0; k < 6; ++k) s.moment[k] = ((k < 3 ? s.weight : 0) - s.moment[k]) / 2;
    s.normals = !s.normals;
    return s;
}

/// Merges two lobes exactly: adds their sums, the lighter's converted to the heavier's kind.
[[nodiscard]] HEDDLE_HD constexpr DirectionSums merged(const DirectionSums& a,
                                                       const DirectionSums& b) {
    const bool first = leads(a, b);
    DirectionSums sum = first ? a : b;
    const DirectionSums& light = first ? b : a;
    const DirectionSums other = light.normals == sum.normals ? light : turned_across(light);
    for (int k = 0; k < 6; ++k) sum.moment[k] += other.moment[k];
    sum.weight += other.weight;
    return sum;
}

/// Lobes for agglomerate() by the method `moments`: merging the closest costs projected area least.
///
/// distance = w_i w_j / (w_i + w_j) |M_i - M_j|^2   (Frobenius; w: shares of weight; [Ward 1963])
///
/// The merged lobe keeps the second moment, so the error of sigma(w) starts with the fourth moment.
/// If a lobe's fourth moment is close to M x M (for a needle it is M x M), merging changes the sum
/// of w M x M by this factor times D x D, D = M_i - M_j; the size of its fourth-order part is a
/// constant times |D|^2. At most 1/2: perpendicular needles, half of the weight each.
///                                                                               [docs/sggx.md]
class MomentLobes {
public:
    /// @param lobes  at most kMaxPool, weights > 0, sum of weights < 2^63; merged in place
    HEDDLE_INLINE explicit MomentLobes(std::span<DirectionSums> lobes)
        : lobes_(lobes.data()), count_(static_cast<int>(lobes.size())) {
        std::int64_t total = 0;
        for (const DirectionSums& lobe : lobes) {
            total += lobe.weight;
            one_material_ = one_material_ && lobe.material == lobes_[0].material;
        }
        per_weight_ = 1.0f / static_cast<float>(total);
        for (int i = 0; i < count_; ++i) update(i);
        for (int i = count_; i % kPoolRow != 0; ++i) { // padding: read by distances(), not used
            for (auto& row : mean_) row[i] = 0.0f;
            share_[i] = 1.0f;
        }
    }
    [[nodiscard]] HEDDLE_INLINE float distance(int i, int j) const {
        if (lobes_[i].material != lobes_[j].material) return distance_of_materials(i, j);
        return distance_of_means(i, j);
    }
    HEDDLE_INLINE void distances(int i, int begin, float (&out)[kPoolRow]) const {
        if (one_material_) {
            for (int k = 0; k < kPoolRow; ++k) out[k] = distance_of_means(i, begin + k);
        } else {
            for (int k = 0; k < kPoolRow; ++k) {
                const bool there = begin + k < count_;
                out[k] = there ? distance(i, begin + k) : 0.0f;
            }
        }
    }
    HEDDLE_INLINE void merge(int into, int from) {
        lobes_[into] = merged(lobes_[into], lobes_[from]);
        update(into);
    }

private:
    [[nodiscard]] HEDDLE_INLINE float share_of_pair(int i, int j) const {
        return share_[i] * share_[j] / (share_[i] + share_[j]);
    }
    [[nodiscard]] HEDDLE_INLINE float distance_of_means(int i, int j) const {
        const auto square = [&](int k) {
            const float d = mean_[k][i] - mean_[k][j];
            return d * d;
        };
        const float apart =
            (square(0) + square(1) + square(2)) + 2.0f * (square(3) + square(4) + square(5));
        return share_of_pair(i, j) * apart;
    }
    [[nodiscard]] HEDDLE_HD float distance_of_materials(int i, int j) const {
        SymmetricMatrix a = detail::mean_moment(lobes_[i]);
        SymmetricMatrix b = detail::mean_moment(lobes_[j]);
        if (lobes_[i].normals != lobes_[j].normals) {
            const bool first = leads(lobes_[i], lobes_[j]);
            SymmetricMatrix& light = first ? b : a;
            light = detail::mean_moment(turned_across(lobes_[first ? j : i]));
        }
        return detail::keep_apart(share_of_pair(i, j) * detail::square_distance(a, b));
    }
    HEDDLE_INLINE void update(int i) {
        const SymmetricMatrix M = detail::mean_moment(lobes_[i]);
        const float entry[6] = {M.xx, M.yy, M.zz, M.xy, M.xz, M.yz};
        for (int k = 0; k < 6; ++k) mean_[k][i] = entry[k];
        share_[i] = static_cast<float>(lobes_[i].weight) * per_weight_;
    }

    DirectionSums* lobes_;
    int count_;
    float per_weight_;
    bool one_material_ = true;
    float mean_[6][kMaxPool]; ///< by entry, so that distances to many lobes are vectorized
    float share_[kMaxPool];
};

/// Moves the lobes that are left after `made` merges, or data of the lobes, to the front, in order.
/// @return  how many are left
template <typename T>
HEDDLE_INLINE int compact_lobes(std::span<T> lobes, const LobeMerge* merges, int made) {
    std::uint64_t gone = 0;
    for (int i = 0; i < made; ++i) gone |= std::uint64_t{1} << merges[i].from;
    std::size_t left = 0;
    for (std::size_t i = 0; i < lobes.size(); ++i) {
        if ((gone >> i & 1) == 0) lobes[left++] = lobes[i];
    }
    return static_cast<int>(left);
}

} // namespace heddle
