#include <heddle/io/vol/vol_file.h>

#include <heddle/base/error.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

namespace heddle {
namespace {

constexpr std::uint64_t kHeaderBytes = 48;
constexpr std::int32_t kMaxSize = 1 << 30;
constexpr std::uint64_t kLayerBytes = 1u << 16; // a box up to this size is read in one piece

template <typename T>
T value_at(const unsigned char* bytes) {
    T v{};
    std::memcpy(&v, bytes, sizeof v);
    return v;
}

/// The sines and cosines of the angles that a byte encodes.
struct AngleTable {
    std::array<float, 256> sine{}, cosine{};
    explicit AngleTable(double whole) {
        for (std::size_t i = 0; i < 256; ++i) {
            const double angle = static_cast<double>(i) * whole / 255.0;
            sine[i] = static_cast<float>(std::sin(angle));
            cosine[i] = static_cast<float>(std::cos(angle));
        }
    }
};

Vec3f decode_direction(const unsigned char* bytes) {
    static const AngleTable theta(std::numbers::pi);
    static const AngleTable phi(2.0 * std::numbers::pi);
    if (bytes[0] == 255) return {};
    const float r = theta.sine[bytes[0]];
    return {phi.cosine[bytes[1]] * r, phi.sine[bytes[1]] * r, theta.cosine[bytes[0]]};
}

bool is_finite(Vec3f v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

const char* to_string(VolEncoding encoding) {
    switch (encoding) {
    case VolEncoding::Float32: return "f32";
    case VolEncoding::Byte: return "u8";
    case VolEncoding::Direction: return "directions";
    }
    return "";
}

std::uint64_t VolHeader::sample_bytes() const {
    const auto n = static_cast<std::uint64_t>(channels);
    switch (encoding) {
    case VolEncoding::Float32: return 4 * n;
    case VolEncoding::Byte: return n;
    case VolEncoding::Direction: return 2; // whatever the number of channels
    }
    return 0;
}

VolFile::VolFile(std::string path) : file_(std::move(path)) {
    read_header();
    std::uint64_t left = (file_.size_bytes() - kHeaderBytes) / header_.sample_bytes();
    for (int a = 0; a < 3; ++a) left /= static_cast<std::uint64_t>(header_.size[a]);
    const Vec3i n = header_.size;
    const std::string needed =
        str(n.x, " x ", n.y, " x ", n.z, " samples of ", header_.sample_bytes(), " bytes");
    if (left < 1) { // divided: the product may overflow 64 bits
        fail(kHeaderBytes,
             str(needed, " are stated, ", file_.size_bytes() - kHeaderBytes, " bytes are left"),
             "the file is cut short or of another kind; copy or export it again");
    }
    std::uint64_t end = header_.sample_bytes();
    for (int a = 0; a < 3; ++a) end *= static_cast<std::uint64_t>(n[a]);
    end += kHeaderBytes;
    if (file_.size_bytes() != end) {
        fail(end, str(file_.size_bytes() - end, " bytes follow ", needed),
             "the file is damaged or of another kind; copy or export it again");
    }
}

void VolFile::read_header() {
    std::array<unsigned char, kHeaderBytes> bytes{};
    const std::uint64_t have = std::min(kHeaderBytes, file_.size_bytes());
    file_.read_at(0, bytes.data(), have);
    if (std::memcmp(bytes.data(), "VOL", 3) != 0) {
        fail(0, "does not begin with 'VOL'", "give a Mitsuba 0.6 grid volume");
    }
    if (have < kHeaderBytes) {
        fail(have, str("the header needs ", kHeaderBytes, " bytes, the file has ", have),
             "copy or export it again");
    }
    const auto unsupported = [&](std::int64_t at, const std::string& what, const char* fix) {
        throw Error(ErrorCode::Unsupported, what, fix, {.path = path(), .offset = at});
    };
    if (bytes[3] != 3) {
        unsupported(3, str("version ", int{bytes[3]}, ", only 3 is known"), "export it again");
    }
    const auto encoding = value_at<std::int32_t>(&bytes[4]);
    if (encoding != 1 && encoding != 3 && encoding != 4) {
        unsupported(4, str("encoding ", encoding, "; known are 1 (f32), 3 (u8), 4 (directions)"),
                    "export it as f32");
    }
    header_.encoding = static_cast<VolEncoding>(encoding);
    read_size(bytes.data());
    read_bounds(bytes.data());
}

void VolFile::read_size(const unsigned char* bytes) {
    for (int a = 0; a < 3; ++a) {
        const std::uint64_t at = 8 + 4 * static_cast<std::uint64_t>(a);
        header_.size[a] = value_at<std::int32_t>(bytes + at);
        if (header_.size[a] < 2 || header_.size[a] > kMaxSize) {
            fail(at, str(header_.size[a], " samples along ", "xyz"[a], ", allowed are 2 to 2^30"),
                 "export it again");
        }
    }
    header_.channels = value_at<std::int32_t>(bytes + 20);
    const bool direction = header_.encoding == VolEncoding::Direction;
    if (header_.channels != 3 && (direction || header_.channels != 1)) {
        fail(20,
             str(header_.channels, " channels, allowed ",
                 direction ? "with directions are 3" : "are 1 and 3"),
             "export density and orientation as files of their own");
    }
}

void VolFile::read_bounds(const unsigned char* bytes) {
    for (int a = 0; a < 3; ++a) {
        const std::uint64_t at = 24 + 4 * static_cast<std::uint64_t>(a);
        const auto lo = value_at<float>(bytes + at);
        const auto hi = value_at<float>(bytes + at + 12);
        if (!std::isfinite(lo) || !std::isfinite(hi) || !(lo < hi)) {
            fail(at, str("bounds from ", lo, " to ", hi, " along ", "xyz"[a], " are no interval"),
                 "export it again");
        }
        header_.bounds.lo[a] = lo;
        header_.bounds.hi[a] = hi;
    }
}

/// Calls decode(bytes, offset, i) for each sample of the box.
template <typename Decode>
void VolFile::for_each_sample(Vec3i lo, Vec3i hi, const Decode& decode) const {
    const auto u64 = [](std::int32_t n) { return static_cast<std::uint64_t>(n); };
    const std::uint64_t each = header_.sample_bytes();
    const std::uint64_t row = u64(header_.size.x) * each;
    const std::uint64_t width = u64(hi.x - lo.x) * each;
    const bool whole_layer = u64(hi.y - lo.y) * row <= kLayerBytes;
    const std::int32_t rows = whole_layer ? hi.y - lo.y : 1;
    std::vector<unsigned char> bytes(u64(rows - 1) * row + width);
    std::size_t i = 0;
    for (std::int32_t z = lo.z; z < hi.z; ++z) {
        for (std::int32_t y = lo.y; y < hi.y; y += rows) {
            const std::uint64_t from =
                kHeaderBytes + (u64(z) * u64(header_.size.y) + u64(y)) * row + u64(lo.x) * each;
            file_.read_at(from, bytes.data(), bytes.size());
            for (std::int32_t r = 0; r < rows; ++r) {
                const std::uint64_t begin = u64(r) * row;
                for (std::uint64_t b = begin; b < begin + width; b += each) {
                    decode(&bytes[b], from + b, i++);
                }
            }
        }
    }
}

void VolFile::read_densities(Vec3i lo, Vec3i hi, std::vector<float>& out) const {
    const Vec3i n = hi - lo;
    out.resize(static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
               static_cast<std::size_t>(n.z));
    if (header_.encoding == VolEncoding::Byte) {
        for_each_sample(lo, hi, [&](const unsigned char* bytes, std::uint64_t, std::size_t i) {
            out[i] = static_cast<float>(*bytes) / 255.0f;
        });
        return;
    }
    for_each_sample(lo, hi, [&](const unsigned char* bytes, std::uint64_t at, std::size_t i) {
        out[i] = value_at<float>(bytes);
        if (!(out[i] >= 0.0f && out[i] <= 1.0f)) {
            fail(at, str("density ", out[i], ", allowed is 0 to 1"),
                 "divide by the largest and give it as --density-scale");
        }
    });
}

void VolFile::read_directions(Vec3i lo, Vec3i hi, std::vector<Vec3f>& out) const {
    const Vec3i n = hi - lo;
    out.resize(static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
               static_cast<std::size_t>(n.z));
    if (header_.encoding == VolEncoding::Direction) {
        for_each_sample(lo, hi, [&](const unsigned char* bytes, std::uint64_t, std::size_t i) {
            out[i] = decode_direction(bytes);
        });
        return;
    }
    for_each_sample(lo, hi, [&](const unsigned char* bytes, std::uint64_t at, std::size_t i) {
        const auto v = value_at<Vec3f>(bytes);
        if (!is_finite(v)) {
            fail(at, str("direction (", v.x, ", ", v.y, ", ", v.z, ") is not finite"),
                 "store 0 0 0 where there is none");
        }
        // in double: no finite float is too large or too small to be squared
        out[i] = to_float(normalize(to_double(v), Vec3d{}));
    });
}

void VolFile::fail(std::uint64_t at, const std::string& what, const std::string& fix) const {
    throw Error(ErrorCode::BadFile, what, fix,
                {.path = path(), .offset = static_cast<std::int64_t>(at)});
}

} // namespace heddle
