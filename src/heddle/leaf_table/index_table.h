#pragma once

#include <heddle/base/vec.h>

#include <cstdint>
#include <vector>

namespace heddle {

/// A hash table from the indices of cells, any 32-bit integers, to their numbers.
///
/// It is at most half full, so that a search reads one or two slots on average. Memory: 32 to 64
/// bytes per cell. Reading is thread-safe.
class IndexTable {
public:
    static constexpr std::uint32_t kNone = 0xffffffff;

    /// Adds a cell and gives it the next number: 0, 1, 2 and so on.
    /// @return  its number; if the cell is in the table already, the number that it has
    std::uint32_t add(Vec3i index);
    /// Returns the number of a cell; kNone if it is not in the table.
    [[nodiscard]] std::uint32_t find(Vec3i index) const;
    /// Returns the number of cells.
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
    /// Returns the number of the slot that holds a cell, or of the empty slot where it belongs.
    [[nodiscard]] std::size_t slot_of(Vec3i index) const;

    std::vector<Slot> slots_ = std::vector<Slot>(2); ///< their number is a power of two
    std::uint32_t size_ = 0;
};

inline std::uint32_t IndexTable::hash(Vec3i index) {
    // three odd factors [Teschner 2003], then the high bits are mixed into the low ones
    const auto word = [](std::int32_t v) { return static_cast<std::uint32_t>(v); };
    std::uint32_t h =
        word(index.x) * 73856093u ^ word(index.y) * 19349663u ^ word(index.z) * 83492791u;
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    return h ^ h >> 13;
}

inline std::size_t IndexTable::slot_of(Vec3i index) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = hash(index) & mask;
    while (slots_[i].number != kNone && !(slots_[i].index == index)) i = (i + 1) & mask;
    return i;
}

inline std::uint32_t IndexTable::find(Vec3i index) const {
    return slots_[slot_of(index)].number;
}

} // namespace heddle
