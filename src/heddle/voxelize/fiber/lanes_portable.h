// Lanes of eight numbers in plain C++, with the names of lanes_avx2.h and results of the same
// bits.
#pragma once

#include <heddle/voxelize/fiber/set_lanes.h>

#include <cmath>
#include <cstdint>
#include <cstring>

namespace heddle::portable {

constexpr int kLanes = 8;

namespace detail {
template <typename T, typename F>
T each(const F& f) {
    T out;
    for (int l = 0; l < kLanes; ++l) out.v[l] = f(l);
    return out;
}
} // namespace detail

struct Mask {
    std::int32_t v[kLanes]; ///< 0 or -1
    friend Mask operator&(Mask a, Mask b) {
        return detail::each<Mask>([&](int l) { return a.v[l] & b.v[l]; });
    }
    friend Mask operator|(Mask a, Mask b) {
        return detail::each<Mask>([&](int l) { return a.v[l] | b.v[l]; });
    }
    friend Mask without(Mask a, Mask b) {
        return detail::each<Mask>([&](int l) { return a.v[l] & ~b.v[l]; });
    }
    [[nodiscard]] std::uint32_t bits() const {
        std::uint32_t out = 0;
        for (int l = 0; l < kLanes; ++l) out |= (v[l] != 0 ? 1u : 0u) << l;
        return out;
    }
};

struct Int {
    std::int32_t v[kLanes];
    Int() = default;
    explicit Int(std::int32_t x) {
        for (std::int32_t& e : v) e = x;
    }
    static Int load(const std::int32_t* p) {
        return detail::each<Int>([&](int l) { return p[l]; });
    }
    void store(std::int32_t* p) const { std::memcpy(p, v, sizeof(v)); }
    static Int iota() {
        return detail::each<Int>([](int l) { return l; });
    }
    friend Int operator+(Int a, Int b) {
        return detail::each<Int>([&](int l) { return wrap(bits(a.v[l]) + bits(b.v[l])); });
    }
    friend Int operator-(Int a, Int b) {
        return detail::each<Int>([&](int l) { return wrap(bits(a.v[l]) - bits(b.v[l])); });
    }
    friend Int operator&(Int a, Int b) {
        return detail::each<Int>([&](int l) { return a.v[l] & b.v[l]; });
    }
    friend Int operator|(Int a, Int b) {
        return detail::each<Int>([&](int l) { return a.v[l] | b.v[l]; });
    }
    friend Int operator<<(Int a, int n) {
        return detail::each<Int>([&](int l) { return wrap(bits(a.v[l]) << n); });
    }
    friend Int operator>>(Int a, int n) {
        return detail::each<Int>([&](int l) { return a.v[l] >> n; });
    }
    friend Mask operator==(Int a, Int b) {
        return detail::each<Mask>([&](int l) { return a.v[l] == b.v[l] ? -1 : 0; });
    }
    friend Mask operator>(Int a, Int b) {
        return detail::each<Mask>([&](int l) { return a.v[l] > b.v[l] ? -1 : 0; });
    }

private:
    static std::uint32_t bits(std::int32_t x) { return static_cast<std::uint32_t>(x); }
    static std::int32_t wrap(std::uint32_t x) { return static_cast<std::int32_t>(x); }
};

struct Real {
    float v[kLanes];
    Real() = default;
    explicit Real(float x) {
        for (float& e : v) e = x;
    }
    static Real load(const float* p) {
        return detail::each<Real>([&](int l) { return p[l]; });
    }
    void store(float* p) const { std::memcpy(p, v, sizeof(v)); }
    friend Real operator+(Real a, Real b) {
        return detail::each<Real>([&](int l) { return a.v[l] + b.v[l]; });
    }
    friend Real operator-(Real a, Real b) {
        return detail::each<Real>([&](int l) { return a.v[l] - b.v[l]; });
    }
    friend Real operator*(Real a, Real b) {
        return detail::each<Real>([&](int l) { return a.v[l] * b.v[l]; });
    }
    friend Real operator/(Real a, Real b) {
        return detail::each<Real>([&](int l) { return a.v[l] / b.v[l]; });
    }
    friend Mask operator<(Real a, Real b) {
        return detail::each<Mask>([&](int l) { return a.v[l] < b.v[l] ? -1 : 0; });
    }
    friend Mask operator<=(Real a, Real b) {
        return detail::each<Mask>([&](int l) { return a.v[l] <= b.v[l] ? -1 : 0; });
    }
};

inline Int min(Int a, Int b) {
    return detail::each<Int>([&](int l) { return a.v[l] < b.v[l] ? a.v[l] : b.v[l]; });
}
inline Int max(Int a, Int b) {
    return detail::each<Int>([&](int l) { return a.v[l] > b.v[l] ? a.v[l] : b.v[l]; });
}
inline Real min(Real a, Real b) {
    return detail::each<Real>([&](int l) { return a.v[l] < b.v[l] ? a.v[l] : b.v[l]; });
}
inline Real max(Real a, Real b) {
    return detail::each<Real>([&](int l) { return a.v[l] > b.v[l] ? a.v[l] : b.v[l]; });
}
inline Real sqrt(Real a) {
    return detail::each<Real>([&](int l) { return std::sqrt(a.v[l]); });
}
inline Real floor(Real a) {
    return detail::each<Real>([&](int l) { return std::floor(a.v[l]); });
}
inline Real ceil(Real a) {
    return detail::each<Real>([&](int l) { return std::ceil(a.v[l]); });
}
inline Real abs(Real a) {
    return detail::each<Real>([&](int l) { return std::fabs(a.v[l]); });
}
inline Real select(Mask m, Real a, Real b) {
    return detail::each<Real>([&](int l) { return m.v[l] != 0 ? a.v[l] : b.v[l]; });
}
inline Int select(Mask m, Int a, Int b) {
    return detail::each<Int>([&](int l) { return m.v[l] != 0 ? a.v[l] : b.v[l]; });
}
inline Real to_real(Int a) {
    return detail::each<Real>([&](int l) { return static_cast<float>(a.v[l]); });
}
inline Int to_int(Real a) {
    return detail::each<Int>([&](int l) { // out of range: as AVX2
        const bool fits = a.v[l] >= -2147483648.0f && a.v[l] < 2147483648.0f;
        return fits ? static_cast<std::int32_t>(a.v[l]) : INT32_MIN;
    });
}
inline Real pick(Real a, Int from) {
    return detail::each<Real>([&](int l) { return a.v[from.v[l] & 7]; });
}
inline Int pick(Int a, Int from) {
    return detail::each<Int>([&](int l) { return a.v[from.v[l] & 7]; });
}
inline Mask pick(Mask a, Int from) {
    return detail::each<Mask>([&](int l) { return a.v[from.v[l] & 7]; });
}
inline void store_transposed(const Real (&r)[8], float (&out)[kLanes][8]) {
    for (int l = 0; l < kLanes; ++l) {
        for (int i = 0; i < 8; ++i) out[l][i] = r[i].v[l];
    }
}

/// The argument of templates over lanes.
struct Lanes {
    using Real = portable::Real;
    using Int = portable::Int;
    using Mask = portable::Mask;

    static constexpr int kLanes = portable::kLanes;
    static Int set_lanes(std::uint32_t mask) {
        return detail::each<Int>(
            [&](int l) { return static_cast<std::int32_t>(kSetLanes[mask] >> (8 * l) & 0xff); });
    }
    static void add_scaled(void* sums, const float* row, float scale) {
        auto* p = static_cast<char*>(sums);
        for (int i = 0; i < kLanes; ++i) {
            std::int64_t sum;
            std::memcpy(&sum, p + 8 * i, 8);
            sum += static_cast<std::int32_t>(row[i] * scale);
            std::memcpy(p + 8 * i, &sum, 8);
        }
    }
};

} // namespace heddle::portable
