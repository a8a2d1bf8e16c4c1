#include <heddle/io/vdb/grid_reader.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/vdb/vdb_leaves.h>
#include <heddle/voxel/leaf_voxels.h>

#include <openvdb/io/Compression.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <istream>
#include <new>
#include <streambuf>
#include <tuple>

namespace heddle {
namespace {

constexpr std::uint32_t kFlags = openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK;

/// How a tree of one value type is stored.
struct ValueType {
    std::size_t bytes = 0;  ///< of the background or an inactive value
    std::size_t stored = 0; ///< of an active value
    [[nodiscard]] bool half() const { return stored != bytes; }
};

ValueType value_type(const GridEntry& grid, const std::string& path) {
    const std::tuple<const char*, std::size_t, bool> types[] = {{"Tree_float_5_4_3", 4, true},
                                                                {"Tree_vec3s_5_4_3", 12, true},
                                                                {"Tree_int32_5_4_3", 4, false},
                                                                {"Tree_int64_5_4_3", 8, false}};
    for (const auto& [name, bytes, real] : types) {
        if (grid.type == name) return {bytes, bytes};
        if (real && grid.type == std::string(name) + "_HalfFloat") return {bytes, bytes / 2};
    }
    throw Error(ErrorCode::Unsupported,
                str("grid '", grid.name, "' is of type '", grid.type,
                    "' (allowed: float, vec3s, int32, int64 in trees 5_4_3)"),
                "leave it out", {.path = path});
}

/// The bytes of a grid, read front to back; every read is checked.
class Bytes {
public:
    Bytes(const std::vector<char>& data, const GridEntry& grid, const std::string& path)
        : data_(data), grid_(grid), path_(path) {}

    const char* take(std::size_t n) {
        if (n > data_.size() - at_)
            fail(str("ends ", n - (data_.size() - at_), " bytes too early"));
        const char* from = data_.data() + at_;
        at_ += n;
        return from;
    }
    template <typename T>
    T read() {
        T value{};
        std::memcpy(&value, take(sizeof(T)), sizeof(T));
        return value;
    }
    std::string read_string() {
        const auto n = read<std::uint32_t>();
        const char* from = take(n);
        return std::string(from, n);
    }
    void expect_at(std::int64_t offset, const char* what) const {
        if (grid_.begin + static_cast<std::int64_t>(at_) != offset) {
            fail(str(what, " should end at byte ", offset));
        }
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::BadFile, str("grid '", grid_.name, "' is damaged: ", what),
                    "write the file again",
                    {.path = path_, .offset = grid_.begin + static_cast<std::int64_t>(at_)});
    }

private:
    const std::vector<char>& data_;
    const GridEntry& grid_;
    const std::string& path_;
    std::size_t at_ = 0;
};

/// The stored values of one node.
struct Chunk {
    const char* data = nullptr; ///< an int64 size and then that many bytes; null: no values
    std::size_t size = 0;       ///< of both together
    std::size_t values = 0;
    bool all = false; ///< includes inactive values
};

/// Skips a node's values, which follow its masks.
Chunk take_values(Bytes& in, ValueType type, std::size_t active, std::size_t total) {
    using namespace openvdb::io;
    Chunk chunk{nullptr, 0, active, false};
    const auto flag = in.read<std::int8_t>();
    if (flag < 0 || flag > NO_MASK_AND_ALL_VALS) in.fail(str("value flag ", int{flag}));
    const bool one = flag == NO_MASK_AND_ONE_INACTIVE_VAL || flag == MASK_AND_ONE_INACTIVE_VAL;
    if (one) in.take(type.bytes);
    if (flag == MASK_AND_TWO_INACTIVE_VALS) in.take(2 * type.bytes);
    if (flag >= MASK_AND_NO_INACTIVE_VALS && flag <= MASK_AND_TWO_INACTIVE_VALS) in.take(total / 8);
    if (flag == NO_MASK_AND_ALL_VALS) {
        chunk.all = true;
        chunk.values = total;
    }
    if (type.half() && chunk.values == 0) return chunk;
    const std::size_t raw = chunk.values * type.stored;
    const char* head = in.take(8);
    std::int64_t n = 0;
    std::memcpy(&n, head, 8);
    if (n <= 0) { // uncompressed: -n bytes
        if (n != -static_cast<std::int64_t>(raw))
            in.fail(str("a chunk of ", -n, " bytes, not ", raw));
        in.take(raw);
        chunk.size = 8 + raw;
    } else {
        if (n < 16) in.fail(str("a compressed chunk of ", n, " bytes (needed: 16)"));
        const char* blosc = in.take(static_cast<std::size_t>(n));
        std::uint32_t sizes[3]; // of the values, of a block, of the chunk
        std::memcpy(sizes, blosc + 4, sizeof(sizes));
        if (sizes[0] != raw || sizes[2] != static_cast<std::uint64_t>(n)) {
            in.fail(str("a chunk that holds ", sizes[0], " bytes in ", sizes[2], ", not ", raw,
                        " in ", n));
        }
        chunk.size = 8 + static_cast<std::size_t>(n);
    }
    chunk.data = head;
    return chunk;
}

template <std::size_t Words>
using Mask = std::array<std::uint64_t, Words>;

template <std::size_t Words>
std::size_t count(const Mask<Words>& mask) {
    std::size_t n = 0;
    for (const std::uint64_t w : mask) n += static_cast<std::size_t>(std::popcount(w));
    return n;
}

/// Calls child(origin) for the children of an internal node at `origin`, after its own bytes.
template <std::size_t Words, typename Child>
void walk_node(Bytes& in, ValueType type, Vec3i origin, int width, int child_bits, Child child) {
    const auto children = in.read<Mask<Words>>();
    const auto tiles = in.read<Mask<Words>>();
    if (count(tiles) != 0) in.fail("active tiles (allowed: none, voxels are in leaves)");
    take_values(in, type, 0, Words * 64);
    const std::int32_t last = (1 << width) - 1;
    for (std::size_t w = 0; w < Words; ++w) {
        for (std::uint64_t bits = children[w]; bits != 0; bits &= bits - 1) {
            const auto i = static_cast<std::int32_t>(w * 64) + std::countr_zero(bits);
            child(origin + Vec3i{((i >> (2 * width)) & last) << child_bits,
                                 ((i >> width) & last) << child_bits, (i & last) << child_bits});
        }
    }
}

void skip_head(Bytes& in) {
    const auto flags = in.read<std::uint32_t>();
    if (flags != kFlags) {
        in.fail(str("compression ", flags, " (allowed: ", kFlags, ", blosc + active values)"));
    }
    const auto metadata = in.read<std::uint32_t>();
    for (std::uint32_t i = 0; i < metadata; ++i) {
        for (int part = 0; part < 3; ++part) (void)in.read_string();
    }
    const std::string map = in.read_string();
    const std::pair<const char*, std::size_t> maps[] = {
        {"UniformScaleTranslateMap", 144}, {"ScaleTranslateMap", 144}, {"AffineMap", 128}};
    for (const auto& [name, bytes] : maps) {
        if (map == name) {
            in.take(bytes);
            return;
        }
    }
    in.fail(str("transform '", map, "' (allowed: scale and translation)"));
}

std::vector<GridLeaves::Leaf> read_topology(Bytes& in, ValueType type) {
    std::vector<GridLeaves::Leaf> leaves;
    if (in.read<std::int32_t>() != 1) in.fail("more than one buffer a leaf");
    in.take(type.bytes); // background
    if (in.read<std::uint32_t>() != 0) in.fail("tiles in the root (allowed: none)");
    const auto roots = in.read<std::uint32_t>();
    for (std::uint32_t i = 0; i < roots; ++i) {
        const auto root = in.read<Vec3i>();
        if (!(node_origin(root, 12) == root)) in.fail("a node off its lattice");
        walk_node<512>(in, type, root, 5, 7, [&](Vec3i upper) {
            std::vector<Vec3i> origins;
            walk_node<64>(in, type, upper, 4, 3, [&](Vec3i at) { origins.push_back(at); });
            for (const Vec3i at : origins) leaves.push_back({at, in.read<LeafMask>(), 0});
        });
    }
    return leaves;
}

/// A stream over bytes in memory.
class MemoryStream : private std::streambuf, public std::istream {
public:
    MemoryStream(const char* data, std::size_t size)
        : std::istream(static_cast<std::streambuf*>(this)) {
        char* from = const_cast<char*>(data); // streambuf has no const; nothing is written
        setg(from, from, from + size);
    }
};

void decode_leaf(const Chunk& chunk, ValueType type, const LeafMask& active, std::byte* to) {
    if (chunk.data == nullptr) return;
    MemoryStream in(chunk.data, chunk.size);
    const std::size_t bytes = chunk.values * type.stored;
    if (!chunk.all) {
        openvdb::io::bloscFromStream(in, reinterpret_cast<char*>(to), bytes);
        return;
    }
    char all[512 * 12];
    openvdb::io::bloscFromStream(in, all, bytes);
    for_each_active(active, [&](std::size_t x, int bit) {
        const std::size_t i = x * 64 + static_cast<std::size_t>(bit);
        std::memcpy(to, all + i * type.stored, type.stored);
        to += type.stored;
    });
}

void sort_leaves(GridLeaves& grid, const Bytes& in) {
    const auto key = [](const GridLeaves::Leaf& l) {
        return std::tuple(l.origin.x, l.origin.y, l.origin.z);
    };
    std::erase_if(grid.leaves, [](const auto& l) { return l.active == LeafMask{}; });
    std::sort(grid.leaves.begin(), grid.leaves.end(),
              [&](const auto& a, const auto& b) { return key(a) < key(b); });
    for (std::size_t i = 1; i < grid.leaves.size(); ++i) {
        if (key(grid.leaves[i - 1]) == key(grid.leaves[i])) in.fail("the same leaf twice");
    }
}

std::vector<char> load(const std::string& path, const GridEntry& grid) {
    std::vector<char> data(static_cast<std::size_t>(grid.end - grid.begin));
    InputFile(path).read_at(static_cast<std::uint64_t>(grid.begin), data.data(), data.size());
    return data;
}

GridLeaves decode(const std::vector<char>& data, const GridEntry& entry, const std::string& path) {
    const ValueType type = value_type(entry, path);
    Bytes in(data, entry, path);
    skip_head(in);
    GridLeaves grid;
    grid.leaves = read_topology(in, type);
    grid.value_bytes = type.stored;
    in.expect_at(entry.buffers, "its masks");

    std::vector<Chunk> chunks;
    std::size_t total = 0;
    for (GridLeaves::Leaf& leaf : grid.leaves) {
        if (in.read<LeafMask>() != leaf.active) in.fail("two masks of one leaf that differ");
        leaf.first = total;
        total += count(leaf.active);
        chunks.push_back(take_values(in, type, count(leaf.active), 512));
    }
    in.expect_at(entry.end, "its values");
    grid.values.resize(total * type.stored);
    parallel_chunks(chunks.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const GridLeaves::Leaf& leaf = grid.leaves[i];
            decode_leaf(chunks[i], type, leaf.active,
                        grid.values.data() + leaf.first * type.stored);
        }
    });
    sort_leaves(grid, in);
    return grid;
}

} // namespace

GridLeaves read_grid(const std::string& path, const GridEntry& entry) {
    try {
        return decode(load(path, entry), entry, path);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) { // openvdb::Exception, std::bad_alloc
        throw Error(ErrorCode::BadFile, str("grid '", entry.name, "' cannot be read: ", e.what()),
                    "write the file again", {.path = path, .offset = entry.begin});
    }
}

} // namespace heddle
