#pragma once

#include <heddle/base/platform.h>
#include <heddle/sggx/agglomerate.h>
#include <heddle/sggx/direction_sums.h>

namespace heddle {

/// Tangents of fibers as the normals around them, or normals of surfaces as the tangents in them:
/// t t^T -> (I - t t^T) / 2.
HEDDLE_HD inline void swap_kind(DirectionSums& s) {
    for (int k = 0; k < 6; ++k) s.moment[k] = ((k < 3 ? s.weight : 0) - s.moment[k]) / 2;
    s.normals = !s.normals;
}

/// Lobes that merge by their second moments.
class MomentLobes {
public:
    HEDDLE_HD MomentLobes(DirectionSums* lobes, int count) : lobes_(lobes) {
        for (int i = 0; i < count; ++i) normalize(i);
    }
    [[nodiscard]] HEDDLE_HD float distance(int i, int j) const {
        float sum = 0.0f;
        for (int k = 0; k < 6; ++k) {
            const float d = mean_[i][k] - mean_[j][k];
            sum += k < 3 ? d * d : 2.0f * d * d;
        }
        const float wi = mean_[i][6], wj = mean_[j][6];
        const float cost = wi * wj / (wi + wj) * sum;
        return lobes_[i].material == lobes_[j].material ? cost : cost + 1e30f;
    }
    HEDDLE_HD void merge(int into, int from) {
        DirectionSums& a = lobes_[into];
        DirectionSums& b = lobes_[from];
        const bool other = b.weight > a.weight || (b.weight == a.weight && b.material < a.material);
        const std::uint32_t material = other ? b.material : a.material;
        const bool normals = other ? b.normals : a.normals;
        if (a.normals != normals) swap_kind(a);
        if (b.normals != normals) swap_kind(b);
        for (int k = 0; k < 6; ++k) a.moment[k] += b.moment[k];
        a.weight += b.weight;
        a.material = material;
        a.normals = normals;
        normalize(into);
    }

private:
    HEDDLE_HD void normalize(int i) {
        const double inv = 1.0 / static_cast<double>(lobes_[i].weight);
        for (int k = 0; k < 6; ++k) {
            mean_[i][k] = static_cast<float>(static_cast<double>(lobes_[i].moment[k]) * inv);
        }
        mean_[i][6] = static_cast<float>(lobes_[i].weight);
    }
    DirectionSums* lobes_;
    float mean_[kMaxPool][7];
};

} // namespace heddle
