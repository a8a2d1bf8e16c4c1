#pragma once

#include <cstdint>

namespace heddle {

/// A primitive of a block: a fiber piece's id (yarn/piece_id.h), or a triangle's number with the top
/// bit set.
using Primitive = std::uint64_t;
constexpr Primitive kTriangleBit = Primitive{1} << 63;

} // namespace heddle
