#pragma once

#include <heddle/base/platform.h>

#include <cstdint>

namespace heddle {

/// A part of a span of a fiber's or yarn's centreline: the span's number, over all sets of a
/// geometry, above the bits of the part.
using PieceId = std::uint64_t;

constexpr int kPartBits = 16;
/// Most parts of a span.
constexpr std::uint64_t kMaxParts = std::uint64_t{1} << kPartBits;

[[nodiscard]] HEDDLE_HD constexpr PieceId pack_piece(std::uint64_t span, std::uint32_t part) {
    return span << kPartBits | part;
}
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t span_of_piece(PieceId id) {
    return id >> kPartBits;
}
[[nodiscard]] HEDDLE_HD constexpr std::uint32_t part_of_piece(PieceId id) {
    return static_cast<std::uint32_t>(id & (kMaxParts - 1));
}

} // namespace heddle
