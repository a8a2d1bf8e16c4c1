#include <heddle/io/vdb/content_hash.h>

#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/io/vdb/grid_name.h>
#include <heddle/io/vdb/grid_reader.h>
#include <heddle/voxel/leaf_voxels.h>

#include <algorithm>
#include <cstring>
#include <iomanip>
#include <sstream>

namespace heddle {
namespace {

std::uint64_t hash_text(const std::string& text) {
    std::uint64_t h = text.size();
    for (const char c : text) h = hash64(h, static_cast<unsigned char>(c));
    return h;
}

/// A sum over the voxels: independent of their order, no sorting, and threads can add up.
std::uint64_t hash_voxels(const GridLeaves& grid, std::uint64_t seed) {
    const auto part = [&](std::size_t begin, std::size_t end) {
        std::uint64_t sum = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const GridLeaves::Leaf& leaf = grid.leaves[i];
            const auto word = [](std::int32_t v) {
                return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v));
            };
            const std::uint64_t at =
                hash64(seed, word(leaf.origin.x) << 32 | word(leaf.origin.y), word(leaf.origin.z));
            const std::byte* value = grid.values.data() + leaf.first * grid.value_bytes;
            for_each_active(leaf.active, [&](std::size_t x, int bit) {
                std::uint64_t words[2] = {0, 0};
                std::memcpy(words, value, grid.value_bytes);
                sum += hash64(at + x * 64 + static_cast<std::uint64_t>(bit), words[0], words[1]);
                value += grid.value_bytes;
            });
        }
        return sum;
    };
    const auto add = [](std::uint64_t a, std::uint64_t b) { return a + b; };
    return reduce_chunks(grid.leaves.size(), 256, seed, part, add);
}

/// "Tree_vec3s_5_4_3_HalfFloat" -> "vec3s"
std::string value_type(const std::string& tree_type) {
    const std::size_t begin = tree_type.starts_with("Tree_") ? 5 : 0;
    return tree_type.substr(begin, tree_type.find('_', begin) - begin);
}

} // namespace

std::vector<GridSummary> summarize_vdb(const std::string& path) {
    std::vector<GridSummary> out;
    const VdbContents file = read_contents(path);
    for (const GridEntry& entry : file.grids) {
        const GridLeaves grid = read_grid(path, entry);
        const int level = std::max(0, split_grid_name(entry.name).level);
        out.push_back({entry.name, level, value_type(entry.type),
                       static_cast<std::int64_t>(grid.size()), entry.end - entry.begin,
                       hash_voxels(grid, hash_text(entry.name))});
    }
    return out;
}

std::string content_hash(const std::vector<GridSummary>& grids) {
    std::uint64_t sum = grids.size();
    for (const GridSummary& grid : grids) sum += hash64(grid.hash, hash_text(grid.name));
    std::ostringstream out;
    out << std::hex << std::setw(16) << std::setfill('0') << sum;
    return out.str();
}

std::string content_hash(const std::string& path) {
    return content_hash(summarize_vdb(path));
}

} // namespace heddle
