#include <heddle/io/image/jpeg_tables.h>

#include <heddle/base/error.h>

#include <array>
#include <bitset>
#include <cstdint>

namespace heddle {
namespace {

// Markers, ITU T.81 table B.1.
constexpr int kProgressiveFrame = 0xC2;
constexpr int kHuffmanTables = 0xC4;
constexpr int kFirstRestart = 0xD0;
constexpr int kLastRestart = 0xD7;
constexpr int kStart = 0xD8;
constexpr int kEnd = 0xD9;
constexpr int kScan = 0xDA;

constexpr int kCodeLengths = 16;
constexpr int kMaxCodes = 256; // a symbol is a byte
constexpr std::size_t kTables = 4;

/// Visits the segments as stb_image does, which stops at the first one that it does not understand,
/// and checks all that stb_image would read.
class JpegTables {
public:
    JpegTables(std::span<const std::byte> bytes, const std::string& name)
        : bytes_(bytes), name_(name) {}

    void check() {
        if (next_marker() != kStart) return;
        for (int marker = next_marker(); marker >= 0 && marker != kEnd; marker = next_marker()) {
            if (marker == kProgressiveFrame) progressive_ = true;
            if (bytes_.size() - at_ < 2) return;
            const std::size_t length =
                static_cast<std::size_t>(byte(at_)) << 8 | static_cast<std::size_t>(byte(at_ + 1));
            if (length < 2 || length > bytes_.size() - at_)
                return check_segment(marker, bytes_.size());
            check_segment(marker, at_ + length);
            at_ += length;
            if (marker == kScan) skip_scan();
        }
    }

private:
    [[nodiscard]] int byte(std::size_t at) const { return std::to_integer<int>(bytes_[at]); }

    [[noreturn]] void fail(std::size_t at, const std::string& what) const {
        throw Error(ErrorCode::BadFile, what, "store it as PNG or baseline JPEG again",
                    {.path = name_, .offset = static_cast<std::int64_t>(at)});
    }

    /// Returns the next marker and moves after it; -1 at the end of the bytes.
    int next_marker() {
        while (at_ < bytes_.size() && byte(at_) != 0xFF) ++at_;
        while (at_ < bytes_.size() && byte(at_) == 0xFF) ++at_;
        return at_ < bytes_.size() ? byte(at_++) : -1;
    }

    /// Skips coded data: a marker in it is a byte 0xFF that is followed by neither 0 nor a restart.
    void skip_scan() {
        for (; at_ + 1 < bytes_.size(); ++at_) {
            if (byte(at_) != 0xFF) continue;
            const int next = byte(at_ + 1);
            if (next != 0 && next != 0xFF && (next < kFirstRestart || next > kLastRestart)) return;
        }
        at_ = bytes_.size();
    }

    void check_segment(int marker, std::size_t end) {
        if (marker == kHuffmanTables) check_tables(at_ + 2, end);
        if (marker == kScan) check_scan(at_ + 2, end);
    }

    void check_tables(std::size_t at, std::size_t end) {
        while (at < end) {
            const std::size_t start = at;
            const int id = byte(at++);
            int codes = 0;
            int left = 1; // codes of this length without a shorter one as prefix
            for (int length = 1; length <= kCodeLengths; ++length, ++at) {
                const int count = at < bytes_.size() ? byte(at) : 0;
                codes += count;
                left = 2 * left - count;
                if (left < 0)
                    fail(start, str("a Huffman table has ", count, " codes of ", length,
                                    " bits, allowed are ", left + count));
            }
            if (codes > kMaxCodes)
                fail(start,
                     str("a Huffman table has ", codes, " codes, allowed are 0 to ", kMaxCodes));
            const auto slot = static_cast<std::size_t>(id & 15);
            if (id >> 4 <= 1 && slot < kTables)
                defined_[static_cast<std::size_t>(id >> 4)].set(slot);
            at += static_cast<std::size_t>(codes);
        }
    }

    /// A scan has its length, the number of components, for each component its number and two
    /// tables, then the first and last coefficient and bits. A baseline file needs both tables; in
    /// a progressive file the first scan of coefficient 0 needs DC, others AC.
    void check_scan(std::size_t at, std::size_t end) {
        if (at >= end) return;
        const auto components = static_cast<std::size_t>(byte(at));
        const std::size_t tail = at + 1 + 2 * components;
        if (tail + 3 > end) return;
        const bool first = byte(tail) == 0;
        const bool needs_dc = !progressive_ || (first && byte(tail + 2) >> 4 == 0);
        const bool needs_ac = !progressive_ || !first;
        for (std::size_t c = 0; c < components; ++c) {
            const std::size_t offset = at + 2 + 2 * c;
            const int tables = byte(offset);
            if (needs_dc) require(0, tables >> 4, offset);
            if (needs_ac) require(1, tables & 15, offset);
        }
    }

    void require(std::size_t kind, int table, std::size_t offset) const {
        const auto slot = static_cast<std::size_t>(table);
        if (slot < kTables && defined_[kind].test(slot)) return;
        fail(offset, str("a scan takes the ", kind == 0 ? "DC" : "AC", " Huffman table ", table,
                         ", which is not there"));
    }

    std::span<const std::byte> bytes_;
    const std::string& name_;
    std::size_t at_ = 0;
    bool progressive_ = false;
    std::array<std::bitset<kTables>, 2> defined_; ///< DC, AC
};

} // namespace

void check_jpeg_tables(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.empty() || bytes[0] != std::byte{0xFF}) return;
    JpegTables(bytes, name).check();
}

} // namespace heddle
