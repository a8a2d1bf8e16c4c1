#pragma once

#include <OpenEXR/ImfIO.h>

#include <cstddef>
#include <cstdint>
#include <string>

/// What reading and writing share, and what is checked before OpenEXR sees a file.
namespace heddle::exr {

inline constexpr std::int64_t kMostSide = 1 << 20;
inline constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;
inline constexpr std::int64_t kMostChannels = 1024;

/// Throws Error{BadFile} unless the header's attributes and sizes can be true of a file of these
/// bytes. OpenEXR allocates what a header asks for, so a false one must not reach it.
/// @param bytes  the whole file
void check_header(const std::string& bytes, const std::string& path);

/// A file's bytes in memory as OpenEXR reads them.
class MemoryInput : public Imf::IStream {
public:
    MemoryInput(const std::string& bytes, const std::string& path)
        : IStream(path.c_str()), bytes_(bytes) {}
    bool read(char* out, int count) override;
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = position; }

private:
    const std::string& bytes_;
    std::uint64_t at_ = 0;
};

} // namespace heddle::exr
