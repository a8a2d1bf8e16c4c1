#pragma once

#include <heddle/base/vec.h>

#include <cstdint>
#include <vector>

namespace heddle {

/// Numbers of cells by their indices, which may lie as far apart as 32 bits allow: a hash table.
///
/// It is at most half full: a search reads one slot or two on average. Memory: 32 to 64 bytes a
/// cell. Reading is safe from several threads.
class IndexTable {
public:
    static constexpr std::uint32_t kNone = 0xffffffff;

    /// Gives a cell the next number: 0, 1, 2 and so on.
    /// @return  its number; the one that it had before where it is there already
    std::uint32_t add(Vec3i index);
    /// @return  the number of a cell; kNone where it is not there
    [[nodiscard]] std::uint32_t find(Vec3i index) const;
    /// How many cells there are.
    [[nodiscard]] std::uint32_t size() const { return size_; }
    [[nodiscard]] std::int64_t byte_count() const {
        return static_cast<std::int64_t>(slots_.capacity() * sizeof(Slot));
    }

private:
    struct Slot {
        Vec3i index;
        std::uint32_t number = kNone;
    };
    [[nodiscard]] static std::uint32_t hash(Vec3i index);
    /// Number of the slot that holds a cell, or of the empty one where it belongs.
    [[nodiscard]] std::size_t place_of(Vec3i index) const;

    std::vector<Slot> slots_ = std::vector<Slot>(2); ///< a power of two
    std::uint32_t size_ = 0;
};

inline std::uint32_t IndexTable::hash(Vec3i index) {
    // three odd factors [Teschner 2003], then the high bits into the low ones
    const auto word = [](std::int32_t v) { return static_cast<std::uint32_t>(v); };
    std::uint32_t h =
        word(index.x) * 73856093u ^ word(index.y) * 19349663u ^ word(index.z) * 83492791u;
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    return h ^ h >> 13;
}

inline std::size_t IndexTable::place_of(Vec3i index) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = hash(index) & mask;
    while (slots_[i].number != kNone && !(slots_[i].index == index)) i = (i + 1) & mask;
    return i;
}

inline std::uint32_t IndexTable::find(Vec3i index) const {
    return slots_[place_of(index)].number;
}

} // namespace heddle
