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

void SpooledGrid::store(std::size_t i, const VoxelBlock& block) {
    const auto size = [](const auto& v) { return static_cast<std::uint32_t>(v.size()); };
    const auto put = [&](const auto& v) { return file_.append(v.data(), v.size() * sizeof(v[0])); };
    places_[i] = {put(block.leaves), size(block.leaves), size(block.coverage),
                  size(block.lobes), size(block.maps),   size(block.tangents)};
    put(block.coverage);
    put(block.lobe_count);
    put(block.lobes);
    put(block.maps);
    put(block.tangents);
}

const VoxelBlock& SpooledGrid::block(std::size_t i, VoxelBlock& scratch) const {
    const Place& at = places_[i];
    std::int64_t offset = at.offset;
    fetch(file_, offset, scratch.leaves, at.leaves);
    fetch(file_, offset, scratch.coverage, at.voxels);
    fetch(file_, offset, scratch.lobe_count, at.voxels);
    fetch(file_, offset, scratch.lobes, at.lobes);
    fetch(file_, offset, scratch.maps, at.maps);
    fetch(file_, offset, scratch.tangents, at.tangents);
    return scratch;
}

} // namespace heddle
