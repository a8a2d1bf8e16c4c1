#pragma once

#include <OpenEXR/ImfIO.h>

#include <cstddef>
#include <cstdint>
#include <string>

/// Limits that reading and writing share, and the checks before OpenEXR reads a file.
namespace heddle::exr {

inline constexpr std::int64_t kMaxSide = 1 << 20;
inline constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;
inline constexpr std::int64_t kMaxChannels = 1024;

/// Throws Error{BadFile} unless the attributes and sizes of the header are possible in a file of
/// these bytes. OpenEXR allocates what a header asks for, so it must not read a false one.
/// @param bytes  the whole file
void check_header(const std::string& bytes, const std::string& path);

/// Lets OpenEXR read the bytes of a file from memory.
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
