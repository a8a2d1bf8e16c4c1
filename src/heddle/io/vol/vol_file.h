#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/bounds.h>
#include <heddle/io/file/input_file.h>

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// How a .vol stores a sample; the numbers are those of the file.
enum class VolEncoding : std::int32_t {
    Float32 = 1,
    Byte = 3,     ///< 0..255 means 0..1
    Direction = 4 ///< two bytes: theta = b0 pi / 255, phi = b1 2 pi / 255; b0 = 255: none
};

/// "f32", "u8", "directions".
[[nodiscard]] const char* to_string(VolEncoding encoding);

/// The first 48 bytes of a .vol of version 3.
struct VolHeader {
    VolEncoding encoding = VolEncoding::Float32;
    Vec3i size;       ///< samples per axis, 2 to 2^30
    int channels = 1; ///< 1 or 3
    Bounds bounds;    ///< scene units; the outermost samples are on it

    [[nodiscard]] std::uint64_t sample_bytes() const;
    [[nodiscard]] bool holds_density() const { return channels == 1; }
    /// True for directions, or for three floats, which may be directions or a colour.
    [[nodiscard]] bool may_hold_directions() const {
        return channels == 3 && encoding != VolEncoding::Byte;
    }
};

/// A Mitsuba 0.6 grid volume: a header, then the samples, x fastest. One box is read at a time.
///
/// Threads: the read functions may be called from several.
class VolFile {
public:
    /// Opens the file, checks its header, and its size against the header, in 64 bits.
    /// @throws Error  as InputFile; BadFile: not a .vol, truncated, bytes after the samples, bounds
    ///                not finite or empty; Unsupported: another version or encoding
    explicit VolFile(std::string path);

    [[nodiscard]] const std::string& path() const { return file_.path(); }
    [[nodiscard]] const VolHeader& header() const { return header_; }

    /// Reads the densities of the samples in [lo, hi), x fastest, then y.
    /// @param lo, hi  inside header().size; header().holds_density()
    /// @param out     resized; in [0, 1]
    /// @throws Error  BadFile: not finite, or not in [0, 1]
    void read_densities(Vec3i lo, Vec3i hi, std::vector<float>& out) const;

    /// Reads the directions of the samples in [lo, hi), x fastest, then y.
    /// @param lo, hi  inside header().size; header().may_hold_directions()
    /// @param out     resized; unit, or zero where there is none
    /// @throws Error  BadFile: not finite
    void read_directions(Vec3i lo, Vec3i hi, std::vector<Vec3f>& out) const;

    /// Throws Error{BadFile} at byte `at`.
    [[noreturn]] void
    fail(std::uint64_t at, const std::string& what, const std::string& fix = {}) const;

private:
    template <typename Decode>
    void for_each_sample(Vec3i lo, Vec3i hi, const Decode& decode) const;
    void read_header();
    void read_size(const unsigned char* bytes);
    void read_bounds(const unsigned char* bytes);

    InputFile file_;
    VolHeader header_;
};

} // namespace heddle
