#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/vdb/vdb_file.h>

#include <algorithm>
#include <cstring>

namespace heddle {
namespace {

constexpr std::uint64_t kMagic = 0x56444220;
constexpr std::uint32_t kOldestVersion = 222; // OpenVDB 2: the layout below

/// Reads a length and a text of that many bytes.
std::string read_string(ByteReader& in, const char* what) {
    return in.text(in.u32(what), what);
}

[[noreturn]] void fail(const ByteReader& in, const std::string& what) {
    in.fail(in.offset(), what, "write or copy the file again");
}

std::int64_t read_offset(ByteReader& in) {
    return static_cast<std::int64_t>(in.u64("a grid's offset"));
}

void skip_head(ByteReader& in, const std::string& path) {
    if (in.size_bytes() < 8 || in.u64("the magic number") != kMagic) {
        in.fail(0, "not a VDB file: it does not start with ' BDV' and four zeros",
                "name a .vdb file");
    }
    const std::uint32_t version = in.u32("the version");
    if (version < kOldestVersion || version > 1000) {
        throw Error(ErrorCode::Unsupported,
                    str("VDB file version ", version, " (allowed: from ", kOldestVersion, ")"),
                    "save it again with a newer program", {.path = path, .offset = 8});
    }
    in.skip(8, 1, "the library version");
    if (in.u8("the offset flag") == 0) {
        throw Error(ErrorCode::Unsupported, "was written as a stream, without grid offsets",
                    "save it as a file", {.path = path, .offset = 20});
    }
    in.skip(36, 1, "the UUID");
}

void read_metadata(ByteReader& in, VdbContents& out) {
    const std::uint32_t n = in.u32("the metadata count");
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::string name = read_string(in, "a metadata name");
        const std::string type = read_string(in, "a metadata type");
        const auto at = static_cast<std::int64_t>(in.offset());
        const std::string value = read_string(in, "a metadata value");
        if (type == "string") {
            out.metadata[name] = value;
            out.value_at[name] = at;
        }
        if (type == "int32" && value.size() == sizeof(std::int32_t)) {
            std::int32_t number = 0;
            std::memcpy(&number, value.data(), sizeof(number));
            out.metadata[name] = std::to_string(number);
        }
    }
}

GridEntry read_entry(ByteReader& in) {
    GridEntry grid;
    grid.name = read_string(in, "a grid's name");
    grid.name = grid.name.substr(0, grid.name.find('\x1e')); // VDB numbers repeated names
    grid.type = read_string(in, "a grid's type");
    const std::string parent = read_string(in, "a grid's instance parent");
    grid.begin = read_offset(in);
    grid.buffers = read_offset(in);
    grid.end = read_offset(in);
    if (!parent.empty()) fail(in, str("grid '", grid.name, "' shares the tree of '", parent, "'"));
    const bool ordered = grid.begin == static_cast<std::int64_t>(in.offset()) &&
                         grid.buffers >= grid.begin && grid.end >= grid.buffers;
    if (!ordered) fail(in, str("grid '", grid.name, "' has offsets out of order"));
    in.skip(static_cast<std::uint64_t>(grid.end - grid.begin), 1, "a grid");
    return grid;
}

} // namespace

const GridEntry* VdbContents::find(const std::string& name) const {
    const auto at = std::find_if(grids.begin(), grids.end(),
                                 [&](const GridEntry& e) { return e.name == name; });
    return at == grids.end() ? nullptr : &*at;
}

VdbContents read_contents(const std::string& path) {
    ByteReader in(path);
    skip_head(in, path);
    VdbContents out;
    out.bytes = static_cast<std::int64_t>(in.size_bytes());
    read_metadata(in, out);
    const std::int32_t n = in.i32("the grid count");
    for (std::int32_t i = 0; i < n; ++i) out.grids.push_back(read_entry(in));
    if (in.remaining() != 0) {
        fail(in, str(in.remaining(), " bytes follow the last grid (allowed: 0)"));
    }
    return out;
}

} // namespace heddle
