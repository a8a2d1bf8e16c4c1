#pragma once

#include <heddle/sggx/packed.h>

namespace heddle {

/// S of six packed bytes: S_aa = sigma_a^2, S_ab = r_ab sigma_a sigma_b        [Fabre26, eq. 17]
/// @return  in world axes; may be indefinite for bytes that no packer made
[[nodiscard]] HEDDLE_HD inline SggxMatrix matrix_from_packed(PackedSggx p) {
    const float x = static_cast<float>(p.sigma[0]) * (1.0f / 255.0f);
    const float y = static_cast<float>(p.sigma[1]) * (1.0f / 255.0f);
    const float z = static_cast<float>(p.sigma[2]) * (1.0f / 255.0f);
    const auto r = [&](int i) { return static_cast<float>(p.r[i]) * (2.0f / 255.0f) - 1.0f; };
    return {x * x, y * y, z * z, r(0) * x * y, r(1) * x * z, r(2) * y * z};
}

/// Unit eigenvector of S's largest eigenvalue, its last component that is not zero positive.
///
/// Squares S until it is of rank one: + and * only, so that the bits are the same everywhere. Where
/// the two largest eigenvalues agree, a unit vector of the plane that they span.
/// @param S  positive semi-definite; all zero gives z
[[nodiscard]] HEDDLE_HD inline Vec3f principal_direction(SymmetricMatrix S) {
    float trace = S.xx + S.yy + S.zz;
    if (!(trace > 0.0f)) return {0.0f, 0.0f, 1.0f};
    for (int i = 0; i < 12; ++i) {
        const float s = 1.0f / trace;
        S = {S.xx * s, S.yy * s, S.zz * s, S.xy * s, S.xz * s, S.yz * s};
        S = {S.xx * S.xx + S.xy * S.xy + S.xz * S.xz, S.xy * S.xy + S.yy * S.yy + S.yz * S.yz,
             S.xz * S.xz + S.yz * S.yz + S.zz * S.zz, S.xx * S.xy + S.xy * S.yy + S.xz * S.yz,
             S.xx * S.xz + S.xy * S.yz + S.xz * S.zz, S.xy * S.xz + S.yy * S.yz + S.yz * S.zz};
        trace = S.xx + S.yy + S.zz; // of a matrix of trace 1, squared: 1 when its rank is one
        if (trace > 0.999999f) break;
    }
    Vec3f d{S.xz, S.yz, S.zz};
    if (S.xx >= S.yy && S.xx >= S.zz) {
        d = {S.xx, S.xy, S.xz};
    } else if (S.yy >= S.zz) {
        d = {S.xy, S.yy, S.yz};
    }
    d = normalize(d);
    const float last = d.z != 0.0f ? d.z : d.y != 0.0f ? d.y : d.x;
    return last < 0.0f ? d * -1.0f : d;
}

} // namespace heddle
