#include <heddle/leaf_table/index_table.h>

#include <heddle/base/error.h>

#include <utility>

namespace heddle {

std::uint32_t IndexTable::add(Vec3i index) {
    const std::uint32_t found = find(index);
    if (found != kNone) return found;
    if (size_ == kNone) {
        throw Error(ErrorCode::InvalidArgument, "voxels: 2^32 cells by index (limit 2^32 - 1)",
                    "use a larger voxel size");
    }
    if (2 * (std::size_t{size_} + 1) > slots_.size()) {
        const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
        for (const Slot& slot : old) {
            if (slot.number != kNone) slots_[slot_of(slot.index)] = slot;
        }
    }
    slots_[slot_of(index)] = {index, size_};
    return size_++;
}

} // namespace heddle
