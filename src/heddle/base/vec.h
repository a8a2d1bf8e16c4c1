#pragma once

#include <heddle/base/platform.h>

#include <cmath>
#include <cstdint>

namespace heddle {

/// Three numbers of one type. An aggregate, trivially copyable, the same bytes on host and device.
template <typename T>
struct Vec3 {
    T x{};
    T y{};
    T z{};

    /// Component by axis, 0 = x, 1 = y, 2 = z.
    [[nodiscard]] HEDDLE_HD constexpr T& operator[](int axis) {
        return axis == 0 ? x : axis == 1 ? y : z;
    }
    [[nodiscard]] HEDDLE_HD constexpr const T& operator[](int axis) const {
        return axis == 0 ? x : axis == 1 ? y : z;
    }
    friend HEDDLE_HD constexpr bool operator==(const Vec3&, const Vec3&) = default;
    friend HEDDLE_HD constexpr Vec3 operator+(Vec3 a, Vec3 b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend HEDDLE_HD constexpr Vec3 operator-(Vec3 a, Vec3 b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend HEDDLE_HD constexpr Vec3 operator*(Vec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
    friend HEDDLE_HD constexpr Vec3 operator*(T s, Vec3 a) { return a * s; }
    /// Component by component.
    friend HEDDLE_HD constexpr Vec3 operator*(Vec3 a, Vec3 b) {
        return {a.x * b.x, a.y * b.y, a.z * b.z};
    }
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
using Vec3i = Vec3<std::int32_t>; ///< voxel and block indices
static_assert(sizeof(Vec3f) == 12, "written to files and copied to the device as 12 bytes");

template <typename T>
[[nodiscard]] HEDDLE_HD constexpr T dot(Vec3<T> a, Vec3<T> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <typename T>
[[nodiscard]] HEDDLE_HD constexpr Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <typename T>
[[nodiscard]] HEDDLE_HD inline T length(Vec3<T> a) {
    return std::sqrt(dot(a, a));
}

/// `a` scaled to length 1; `fallback` if `a` has no direction (it is zero or too small to square).
template <typename T>
[[nodiscard]] HEDDLE_HD inline Vec3<T> normalize(Vec3<T> a, Vec3<T> fallback = {T(0), T(0), T(1)}) {
    const T n = length(a);
    return n > T(0) ? a * (T(1) / n) : fallback;
}

/// A unit vector perpendicular to the unit vector `n`; discontinuous only at n = -z.
///                                                     [Duff 2017, "Building an orthonormal basis"]
[[nodiscard]] HEDDLE_HD inline Vec3f any_perpendicular(Vec3f n) {
    const float sign = n.z < 0.0f ? -1.0f : 1.0f;
    const float a = -1.0f / (sign + n.z);
    return {1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

[[nodiscard]] HEDDLE_HD constexpr Vec3d to_double(Vec3f a) {
    return {a.x, a.y, a.z};
}
[[nodiscard]] HEDDLE_HD constexpr Vec3f to_float(Vec3d a) {
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

} // namespace heddle
