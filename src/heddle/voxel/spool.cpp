#include <heddle/voxel/spool.h>

namespace heddle {
namespace {

template <typename T>
void fetch(const TempFile& file, std::int64_t& offset, std::vector<T>& into, std::uint32_t count) {
    into.resize(count);
    const std::size_t bytes = count * sizeof(T);
    if (bytes == 0) return;
    file.read(offset, into.data(), bytes);
    offset += static_cast<std::int64_t>(bytes);
}

} // namespace

void SpooledLevel::store(std::size_t i, const VoxelBlock& block) {
    BlockRecord& at = records_[i];
    const auto put = [&](const auto& v) { return file_.append(v.data(), v.size() * sizeof(v[0])); };
    at.offset = put(block.leaves);
    at.leaves = static_cast<std::uint32_t>(block.leaves.size());
    std::size_t n = 0;
    VoxelBlock::for_each_array(block, [&](const auto& v) {
        at.sizes[n++] = static_cast<std::uint32_t>(v.size());
        put(v);
    });
}

const VoxelBlock& SpooledLevel::block(std::size_t i, VoxelBlock& scratch) const {
    const BlockRecord& at = records_[i];
    std::int64_t offset = at.offset;
    fetch(file_, offset, scratch.leaves, at.leaves);
    std::size_t n = 0;
    VoxelBlock::for_each_array(scratch, [&](auto& v) { fetch(file_, offset, v, at.sizes[n++]); });
    return scratch;
}

} // namespace heddle
