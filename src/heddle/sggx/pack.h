#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/sggx/packed.h>
#include <heddle/sggx/sggx.h>

#include <cmath>
#include <cstdint>

namespace heddle {

/// Smallest determinant of the correlations, times 255^3, that `pack` gives. Their smallest
/// eigenvalue is then above 2.6e-5, 400 float roundings: float algebra on the decoded S stays
/// definite. It is free: no bound from 2 to 1700 changes a measured error. The narrowest diagonal
/// needle (all r = 253/255) has 3064.
inline constexpr std::int32_t kMinPackedDeterminant = 1000;

namespace detail {

/// 255 r: an odd number in -255 .. 255.
[[nodiscard]] HEDDLE_HD constexpr std::int32_t correlation255(std::int32_t byte) {
    return 2 * byte - 255;
}

/// 255^3 times the determinant of the matrix of correlations; exact.
[[nodiscard]] HEDDLE_HD constexpr std::int32_t
correlation_determinant(std::int32_t byte_xy, std::int32_t byte_xz, std::int32_t byte_yz) {
    const std::int32_t xy = correlation255(byte_xy);
    const std::int32_t xz = correlation255(byte_xz);
    const std::int32_t yz = correlation255(byte_yz);
    // at most 5 x 255^3 = 8.3e7 in any partial sum
    return 255 * 255 * 255 + 2 * xy * xz * yz - 255 * (xy * xy + xz * xz + yz * yz);
}

/// floor(x), kept in 1 .. `most`; NaN gives 1.
[[nodiscard]] HEDDLE_HD constexpr std::int32_t to_byte(float x, std::int32_t most) {
    return x >= 1.0f ? (x < static_cast<float>(most) ? static_cast<std::int32_t>(x) : most) : 1;
}

/// A correlation's two neighbouring bytes, of 1 .. 254.
struct Neighbours {
    std::int32_t nearest, other;
    float extra; ///< what the other adds to the squared error in S
};

/// @param r       in byte steps: 127.5 (1 + correlation)
/// @param weight  of its squared error
[[nodiscard]] HEDDLE_HD constexpr Neighbours neighbours(float r, float weight) {
    const std::int32_t nearest = to_byte(r + 0.5f, 254);
    const float error = r - static_cast<float>(nearest);
    const std::int32_t next = nearest + (error < 0.0f ? -1 : 1);
    const std::int32_t other = next < 1 ? 1 : next > 254 ? 254 : next;
    const float other_error = r - static_cast<float>(other);
    return {nearest, other, weight * (other_error * other_error - error * error)};
}

/// Stores the bytes if they are definite with the margin of kMinPackedDeterminant.
[[nodiscard]] HEDDLE_HD constexpr bool
store_if_definite(std::int32_t xy, std::int32_t xz, std::int32_t yz, PackedSggx& out) {
    if (correlation_determinant(xy, xz, yz) < kMinPackedDeterminant) return false;
    out.r[0] = static_cast<std::uint8_t>(xy);
    out.r[1] = static_cast<std::uint8_t>(xz);
    out.r[2] = static_cast<std::uint8_t>(yz);
    return true;
}

/// Stores, of the 8 choices of neighbours, the definite one with the least squared error in S.
///
/// @return  false if none of the 8 is definite; `out` is then unchanged
[[nodiscard]] HEDDLE_HD constexpr bool
store_best_neighbours(Vec3f r, Vec3f weight, PackedSggx& out) {
    const Neighbours x = neighbours(r.x, weight.x);
    const Neighbours y = neighbours(r.y, weight.y);
    const Neighbours z = neighbours(r.z, weight.z);
    bool found = false;
    float least = 0.0f;
    for (int choice = 0; choice < 8; ++choice) {
        const bool fx = (choice & 1) != 0;
        const bool fy = (choice & 2) != 0;
        const bool fz = (choice & 4) != 0;
        const float error = (fx ? x.extra : 0.0f) + (fy ? y.extra : 0.0f) + (fz ? z.extra : 0.0f);
        if (found && !(error < least)) continue;
        if (!store_if_definite(fx ? x.other : x.nearest, fy ? y.other : y.nearest,
                               fz ? z.other : z.nearest, out)) {
            continue;
        }
        found = true;
        least = error;
    }
    return found;
}

/// sqrt(x) of a diagonal entry, and the byte it is stored as.
[[nodiscard]] HEDDLE_HD inline float pack_sigma(float square, std::uint8_t& byte) {
    const float sigma = std::sqrt(square > 0.0f ? square : 0.0f);
    byte = static_cast<std::uint8_t>(to_byte(255.0f * sigma + 0.5f, 255));
    return sigma;
}

/// Correlation in byte steps.
[[nodiscard]] HEDDLE_HD constexpr float scale_correlation(float product, float sigmas) {
    return sigmas > 0.0f ? 127.5f + 127.5f * (product / sigmas) : 127.5f;
}

} // namespace detail

/// True if `p` decodes to a positive definite matrix; exact, for any 6 bytes.
///
/// S = D C D with D = diag(sigma) and C the correlations: no sigma is 0, no |r| is 1, |C| > 0.
[[nodiscard]] HEDDLE_HD constexpr bool is_positive_definite(const PackedSggx& p) {
    for (int i = 0; i < 3; ++i) {
        if (p.sigma[i] == 0 || p.r[i] == 0 || p.r[i] == 255) return false;
    }
    return detail::correlation_determinant(p.r[0], p.r[1], p.r[2]) > 0;
}

/// Packs S into 6 bytes that decode positive definite, whatever S is.
///
/// sigma_x = sqrt(S_xx), r_xy = S_xy / (sigma_x sigma_y)                      [Fabre26, eq. 17]
/// Each is rounded to the nearest byte, sigma to 1 or more, r to 1 .. 254. Where that is not
/// definite: of the 8 choices of upper and lower neighbours of r the definite one nearest in S. If
/// there is none, r is scaled by 1 - 4/255 first: rounding then takes at most 2/255 of the 4/255
/// that its eigenvalues have, which leaves a determinant of 3040.
///
/// @param S  positive semi-definite, diagonal in [0, 1]; anything else is clamped
[[nodiscard]] HEDDLE_HD inline PackedSggx pack(const SggxMatrix& S) {
    PackedSggx p;
    const float x = detail::pack_sigma(S.xx, p.sigma[0]);
    const float y = detail::pack_sigma(S.yy, p.sigma[1]);
    const float z = detail::pack_sigma(S.zz, p.sigma[2]);
    const Vec3f sigmas{x * y, x * z, y * z};
    Vec3f r{detail::scale_correlation(S.xy, sigmas.x), detail::scale_correlation(S.xz, sigmas.y),
            detail::scale_correlation(S.yz, sigmas.z)};
    if (detail::store_if_definite(detail::to_byte(r.x + 0.5f, 254),
                                  detail::to_byte(r.y + 0.5f, 254),
                                  detail::to_byte(r.z + 0.5f, 254), p)) {
        return p; // the least error of all, and nearly always definite
    }
    const Vec3f weight = sigmas * sigmas;
    if (detail::store_best_neighbours(r, weight, p)) return p;
    constexpr Vec3f kCentre{127.5f, 127.5f, 127.5f};
    r = kCentre + (r - kCentre) * (251.0f / 255.0f);
    if (detail::store_best_neighbours(r, weight, p)) return p;
    for (std::uint8_t& byte : p.r) byte = 128; // S was not semi-definite: no correlation
    return p;
}

/// The matrix that 6 bytes stand for, each entry rounded once.
///
/// Rounding moved its scale: the distribution integrates to 1 within 1 %. Bytes from outside may
/// decode to anything: ask is_positive_definite first.
[[nodiscard]] HEDDLE_HD inline SggxMatrix unpack(const PackedSggx& p) {
    const std::int32_t x = p.sigma[0];
    const std::int32_t y = p.sigma[1];
    const std::int32_t z = p.sigma[2];
    const auto square = [](std::int32_t s) { return static_cast<float>(s * s) / 65025.0f; };
    const auto product = [](std::int32_t ss, std::uint8_t r) { // below 2^24: exact before dividing
        return static_cast<float>(ss * detail::correlation255(r)) / 16581375.0f;
    };
    return {square(x),
            square(y),
            square(z),
            product(x * y, p.r[0]),
            product(x * z, p.r[1]),
            product(y * z, p.r[2])};
}

} // namespace heddle
