#include <heddle/io/exr/exr_header.h>

#include <heddle/base/error.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTileDescription.h>

#include <Imath/ImathBox.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace heddle::exr {
namespace {

constexpr std::size_t kPreambleBytes = 8; // magic and version
constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kDeepOrParts = 0x1800;

// Deflate compresses by at most 1032, the other methods less, and a pixel has at least two bytes.
// DWA first writes an 8 x 8 block that is constant as one number.
constexpr std::int64_t kMaxPixelsPerByte = 1032;
constexpr std::int64_t kMaxPixelsPerByteDwa = 64 * 1032;

/// A tile may be larger than its picture; OpenEXR allocates whole tiles.
constexpr std::int64_t kMaxTilePixels = std::int64_t{1} << 22;

[[noreturn]] void
fail(const std::string& path, std::size_t at, const std::string& what, const std::string& fix) {
    throw Error(ErrorCode::BadFile, what, fix,
                {.path = path, .offset = static_cast<std::int64_t>(at)});
}

/// Skips a zero-terminated text of the header; returns the offset after it.
std::size_t skip_name(const std::string& bytes, std::size_t at, const std::string& path) {
    const std::size_t end = bytes.find('\0', at);
    if (end == std::string::npos || end - at > 255) {
        fail(path, at, "no name of 255 bytes or fewer in the header", "the file is damaged");
    }
    return end + 1;
}

/// Checks that each attribute has its stated length, and returns the end of the header.
void check_attributes(const std::string& bytes, const std::string& path) {
    std::size_t at = kPreambleBytes;
    while (true) {
        const std::size_t start = at;
        at = skip_name(bytes, at, path);
        if (at == start + 1) return; // an empty name ends the header
        at = skip_name(bytes, at, path);
        std::int32_t size = 0;
        if (bytes.size() - at < sizeof(size)) {
            fail(path, at, "the file ends in its header", "it was cut short; get it again");
        }
        std::memcpy(&size, bytes.data() + at, sizeof(size));
        at += sizeof(size);
        if (size < 0 || static_cast<std::size_t>(size) > bytes.size() - at) {
            fail(path, at - sizeof(size),
                 str("an attribute says it has ", size, " bytes, ", bytes.size() - at, " are left"),
                 "the file was cut short or damaged; get it again");
        }
        at += static_cast<std::size_t>(size);
    }
}

void check_sizes(const Imf::Header& header, std::int64_t file_bytes, const std::string& path) {
    const Imath::Box2i window = header.dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    const bool dwa = header.compression() == Imf::DWAA_COMPRESSION ||
                     header.compression() == Imf::DWAB_COMPRESSION;
    const std::int64_t per_byte = dwa ? kMaxPixelsPerByteDwa : kMaxPixelsPerByte;
    if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide ||
        width * height > kMaxPixels) {
        fail(path, 0, str("says ", width, " x ", height, " px, the limit is 2^28 px"),
             "store a smaller picture");
    }
    if (width * height > per_byte * file_bytes) {
        fail(path, 0,
             str("says ", width, " x ", height, " px, but has only ", file_bytes, " bytes"),
             "the file was cut short or damaged; get it again");
    }
    std::int64_t channels = 0; // std::distance does not accept its iterators
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++channels;
    if (channels > kMaxChannels) {
        fail(path, 0, str("has ", channels, " channels, the limit is ", kMaxChannels),
             "store fewer");
    }
    if (!header.hasTileDescription()) return;
    const Imf::TileDescription& tile = header.tileDescription();
    const std::int64_t limit = std::max(width * height, kMaxTilePixels);
    if (tile.xSize < 1 || tile.ySize < 1 || tile.xSize > limit / tile.ySize) {
        fail(
            path, 0,
            str("has tiles of ", tile.xSize, " x ", tile.ySize, " px, the limit is ", limit, " px"),
            "store it with smaller tiles");
    }
}

} // namespace

bool MemoryInput::read(char* out, int count) {
    const auto n = static_cast<std::uint64_t>(std::max(count, 0));
    if (at_ > bytes_.size() || n > bytes_.size() - at_) {
        throw std::runtime_error("the file ends too early");
    }
    std::memcpy(out, bytes_.data() + at_, n);
    at_ += n;
    return at_ < bytes_.size();
}

void check_header(const std::string& bytes, const std::string& path) {
    std::uint32_t magic = 0;
    std::uint32_t version = 0;
    if (bytes.size() >= kPreambleBytes) {
        std::memcpy(&magic, bytes.data(), sizeof(magic));
        std::memcpy(&version, bytes.data() + sizeof(magic), sizeof(version));
    }
    if (magic != kMagic || (version & 0xff) != 2) {
        fail(path, 0, "is no OpenEXR file of version 2", "store it as OpenEXR again");
    }
    if ((version & kDeepOrParts) != 0) {
        fail(path, 4, "is a deep file or has several parts", "store one flat picture in it");
    }
    check_attributes(bytes, path);
    MemoryInput stream(bytes, path);
    stream.seekg(kPreambleBytes);
    Imf::Header header;
    int flags = static_cast<int>(version);
    header.readFrom(stream, flags);
    check_sizes(header, static_cast<std::int64_t>(bytes.size()), path);
}

} // namespace heddle::exr
