#include <heddle/io/vol/vol_dictionary.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <system_error>
#include <tuple>

namespace heddle {
namespace {

constexpr std::uint64_t kHeadBytes = 36;
constexpr std::uint64_t kEntryBytes = 12;
constexpr const char* kNeither =
    "give a grid volume (it begins with 'VOL') or a hgridvolume dictionary";

Vec3i read_vec3i(ByteReader& in, const char* what) {
    Vec3i v;
    for (int a = 0; a < 3; ++a) v[a] = in.i32(what);
    return v;
}

std::string show(Vec3i v) {
    return str(v.x, " ", v.y, " ", v.z);
}

void read_head(ByteReader& in, VolDictionary& out) {
    std::array<float, 6> b{};
    for (float& f : b) f = in.f32("the dictionary's bounds");
    for (std::size_t a = 0; a < 3; ++a) {
        if (!std::isfinite(b[a]) || !std::isfinite(b[a + 3]) || !(b[a] < b[a + 3])) {
            in.fail(4 * a,
                    str("bounds from ", b[a], " to ", b[a + 3], " along ", "xyz"[a],
                        " are no interval: not a volume"),
                    kNeither);
        }
        out.bounds.lo[static_cast<int>(a)] = b[a];
        out.bounds.hi[static_cast<int>(a)] = b[a + 3];
    }
    out.cells = read_vec3i(in, "the dictionary's resolution");
    for (int a = 0; a < 3; ++a) {
        if (out.cells[a] < 1) {
            in.fail(24 + 4 * static_cast<std::uint64_t>(a),
                    str(out.cells[a], " blocks along ", "xyz"[a], ", at least 1 is needed"),
                    kNeither);
        }
    }
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Reads "XXX_YYY_ZZZ" without signs and moves `text` after it.
bool take_place(const char*& text, const char* end, Vec3i& out) {
    for (int a = 0; a < 3; ++a) {
        if (a > 0 && (text == end || *text++ != '_')) return false;
        if (text == end || !is_digit(*text)) return false;
        const auto [behind, error] = std::from_chars(text, end, out[a]);
        if (error != std::errc()) return false;
        text = behind;
    }
    return true;
}

} // namespace

VolDictionary read_vol_dictionary(const std::string& path) {
    ByteReader in(path);
    VolDictionary out;
    read_head(in, out);
    const std::uint64_t count = in.remaining() / kEntryBytes;
    if (count == 0) in.fail(kHeadBytes, "lists no block", kNeither);
    if (in.remaining() % kEntryBytes != 0) {
        in.fail(kHeadBytes + count * kEntryBytes,
                str("the last block's entry has ", in.remaining() % kEntryBytes, " bytes of ",
                    kEntryBytes),
                "the file is cut short or of another kind; copy or export it again");
    }
    std::map<std::tuple<std::int32_t, std::int32_t, std::int32_t>, std::uint64_t> seen;
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t at = in.offset();
        const Vec3i b = read_vec3i(in, "a block's place");
        for (int a = 0; a < 3; ++a) {
            if (b[a] < 0 || b[a] >= out.cells[a]) {
                in.fail(at,
                        str("block ", show(b), " lies outside the ", show(out.cells), " blocks"),
                        "export the volume again");
            }
        }
        const auto [first, is_new] = seen.try_emplace({b.x, b.y, b.z}, at);
        if (!is_new) {
            in.fail(at, str("block ", show(b), " is listed twice, first at byte ", first->second),
                    "export the volume again");
        }
        out.blocks.push_back(b);
    }
    return out;
}

std::string BlockName::of(Vec3i other) const {
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), "%03d_%03d_%03d", other.x, other.y, other.z);
    return prefix + digits.data() + postfix;
}

std::optional<BlockName> parse_block_name(const std::string& name) {
    for (std::size_t at = 0; at < name.size(); ++at) {
        if (at > 0 && is_digit(name[at - 1])) continue; // not in the middle of a number
        BlockName out{name.substr(0, at), {}, {}};
        const char* rest = name.data() + at;
        if (!take_place(rest, name.data() + name.size(), out.block)) continue;
        out.postfix = rest;
        // with other padding ("0008") the file would not be found again
        if (out.of(out.block) == name) return out;
    }
    return std::nullopt;
}

} // namespace heddle
