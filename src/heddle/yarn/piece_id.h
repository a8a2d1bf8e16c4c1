#pragma once

#include <cstdint>

namespace heddle {

/// A part of a span of a fiber's or yarn's centreline: span << 16 | part.
using PieceId = std::uint64_t;

} // namespace heddle
