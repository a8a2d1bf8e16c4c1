#pragma once

#include <heddle/base/platform.h>

#include <cstdint>

namespace heddle {

/// The number of a piece: the number of its span, over all sets of a geometry, in the upper bits
/// and the number of the part in the lower kPartBits.
using PieceId = std::uint64_t;

constexpr int kPartBits = 16;
/// Largest number of parts of a span.
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
