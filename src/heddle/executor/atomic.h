#pragma once

#include <heddle/base/platform.h>

#include <atomic>
#include <cstdint>

namespace heddle::executor {

/// *at |= bits as one atomic operation, on the device and on the host.
HEDDLE_HD inline void atomic_or(std::uint64_t* at, std::uint64_t bits) {
#if HEDDLE_DEVICE_PASS
    atomicOr(reinterpret_cast<unsigned long long*>(at), static_cast<unsigned long long>(bits));
#else
    std::atomic_ref(*at).fetch_or(bits, std::memory_order_relaxed);
#endif
}

/// *at += x modulo 2^64, atomically. Signed numbers are added as their two's complement.
/// @return  the value before
HEDDLE_HD inline std::uint64_t atomic_add(std::uint64_t* at, std::uint64_t x) {
#if HEDDLE_DEVICE_PASS
    return atomicAdd(reinterpret_cast<unsigned long long*>(at), static_cast<unsigned long long>(x));
#else
    return std::atomic_ref(*at).fetch_add(x, std::memory_order_relaxed);
#endif
}

/// *at += x modulo 2^32, atomically.
/// @return  the value before
HEDDLE_HD inline std::uint32_t atomic_add(std::uint32_t* at, std::uint32_t x) {
#if HEDDLE_DEVICE_PASS
    return atomicAdd(at, x);
#else
    return std::atomic_ref(*at).fetch_add(x, std::memory_order_relaxed);
#endif
}

/// *at = max(*at, x), atomically.
HEDDLE_HD inline void atomic_max(std::uint32_t* at, std::uint32_t x) {
#if HEDDLE_DEVICE_PASS
    atomicMax(at, x);
#else
    std::atomic_ref value(*at);
    std::uint32_t before = value.load(std::memory_order_relaxed);
    while (before < x && !value.compare_exchange_weak(before, x, std::memory_order_relaxed)) {
    }
#endif
}

} // namespace heddle::executor
