#include <heddle/base/error.h>
#include <heddle/io/vdb/vdb_file.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace heddle {
namespace {

constexpr std::int64_t kMagic = 0x56444220;
constexpr std::uint32_t kOldestVersion = 222; // OpenVDB 2: the layout below

/// Reads little-endian numbers and knows where the file ends.
class Cursor {
public:
    explicit Cursor(const std::string& path) : path_(path) {
        std::error_code error;
        if (std::filesystem::is_directory(path, error)) {
            throw Error(ErrorCode::NotFound, "is a folder", "name a .vdb file", {.path = path});
        }
        errno = 0;
        in_.open(path, std::ios::binary);
        if (!in_) {
            throw Error(ErrorCode::NotFound,
                        str("cannot be read: ", std::strerror(errno != 0 ? errno : EIO)),
                        "check the name and its permissions", {.path = path});
        }
        in_.seekg(0, std::ios::end);
        size_ = static_cast<std::int64_t>(in_.tellg());
        seek(0);
    }

    [[nodiscard]] std::int64_t at() const { return at_; }
    [[nodiscard]] std::int64_t size() const { return size_; }

    template <typename T>
    T read(const char* what) {
        need(sizeof(T), what);
        T value{};
        in_.read(reinterpret_cast<char*>(&value), sizeof(T));
        at_ += static_cast<std::int64_t>(sizeof(T));
        return value;
    }
    std::string read_string(const char* what) {
        const auto n = read<std::uint32_t>(what);
        need(n, what);
        std::string text(n, '\0');
        in_.read(text.data(), n);
        at_ += n;
        return text;
    }
    void skip(std::int64_t n, const char* what) {
        need(n, what);
        seek(at_ + n);
    }
    void seek(std::int64_t to) {
        in_.seekg(to);
        at_ = to;
    }
    [[noreturn]] void fail(const std::string& what,
                           const char* fix = "write or copy the file again") const {
        throw Error(ErrorCode::BadFile, what, fix, {.path = path_, .offset = at_});
    }

private:
    void need(std::int64_t n, const char* what) const {
        if (n > size_ - at_) {
            fail(str("truncated: ", what, " needs ", n, " bytes, ", size_ - at_, " are left"));
        }
    }

    std::string path_;
    std::ifstream in_;
    std::int64_t size_ = 0;
    std::int64_t at_ = 0;
};

void skip_head(Cursor& in, const std::string& path) {
    if (in.size() < 8 || in.read<std::int64_t>("the magic number") != kMagic) {
        in.seek(0);
        in.fail("not a VDB file: it does not start with ' BDV' and four zeros", "name a .vdb file");
    }
    const auto version = in.read<std::uint32_t>("the version");
    if (version < kOldestVersion || version > 1000) {
        throw Error(ErrorCode::Unsupported,
                    str("VDB file version ", version, " (allowed: from ", kOldestVersion, ")"),
                    "save it again with a newer program", {.path = path, .offset = 8});
    }
    in.skip(8, "the library version");
    if (in.read<std::uint8_t>("the offset flag") == 0) {
        throw Error(ErrorCode::Unsupported, "was written as a stream, without grid offsets",
                    "save it as a file", {.path = path, .offset = 20});
    }
    in.skip(36, "the UUID");
}

std::map<std::string, std::string> read_metadata(Cursor& in) {
    std::map<std::string, std::string> out;
    const auto n = in.read<std::uint32_t>("the metadata count");
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::string name = in.read_string("a metadata name");
        const std::string type = in.read_string("a metadata type");
        const std::string value = in.read_string("a metadata value");
        if (type == "string") out[name] = value;
        if (type == "int32" && value.size() == sizeof(std::int32_t)) {
            std::int32_t number = 0;
            std::memcpy(&number, value.data(), sizeof(number));
            out[name] = std::to_string(number);
        }
    }
    return out;
}

GridEntry read_entry(Cursor& in) {
    GridEntry grid;
    grid.name = in.read_string("a grid's name");
    grid.name = grid.name.substr(0, grid.name.find('\x1e')); // VDB numbers names that repeat
    grid.type = in.read_string("a grid's type");
    const std::string parent = in.read_string("a grid's instance parent");
    grid.begin = in.read<std::int64_t>("a grid's offset");
    grid.buffers = in.read<std::int64_t>("a grid's offset");
    grid.end = in.read<std::int64_t>("a grid's offset");
    if (!parent.empty()) in.fail(str("grid '", grid.name, "' shares the tree of '", parent, "'"));
    const bool ordered =
        grid.begin == in.at() && grid.buffers >= grid.begin && grid.end >= grid.buffers;
    if (!ordered) in.fail(str("grid '", grid.name, "' has offsets out of order"));
    in.skip(grid.end - grid.begin, "a grid");
    return grid;
}

} // namespace

VdbContents read_contents(const std::string& path) {
    Cursor in(path);
    skip_head(in, path);
    VdbContents out;
    out.metadata = read_metadata(in);
    const auto n = in.read<std::int32_t>("the grid count");
    for (std::int32_t i = 0; i < n; ++i) out.grids.push_back(read_entry(in));
    if (in.at() != in.size()) {
        in.fail(str(in.size() - in.at(), " bytes follow the last grid (allowed: 0)"));
    }
    return out;
}

} // namespace heddle
