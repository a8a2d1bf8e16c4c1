#include <heddle/stage/checkpoint.h>

#include <heddle/base/error.h>
#include <heddle/base/random.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/file/output_file.h>

#include <array>
#include <cstring>
#include <type_traits>

namespace heddle {
namespace {

static_assert(std::is_trivially_copyable_v<PixelSums>, "written as it lies");

struct Head {
    std::array<char, 8> magic{'H', 'E', 'D', 'D', 'L', 'E', 'C', '2'};
    std::uint64_t hash = 0;
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::uint64_t pixel_bytes = sizeof(PixelSums);
    std::uint64_t checksum = 0; ///< of the pixels
};

std::uint64_t checksum_of(const Picture& picture) {
    static_assert(sizeof(PixelSums) % sizeof(std::uint64_t) == 0);
    std::uint64_t sum = 0;
    for (const PixelSums& pixel : picture.pixels) {
        std::array<std::uint64_t, sizeof(PixelSums) / sizeof(std::uint64_t)> words;
        std::memcpy(words.data(), &pixel, sizeof(pixel));
        for (const std::uint64_t word : words) sum = hash64(sum, word);
    }
    return sum;
}

} // namespace

void write_checkpoint(const std::string& path, std::uint64_t hash, const Picture& picture) {
    Head head;
    head.hash = hash;
    head.width = picture.width;
    head.height = picture.height;
    head.checksum = checksum_of(picture);
    OutputFile out(path);
    out.write(&head, sizeof(head));
    out.write(picture.pixels.data(), picture.pixels.size() * sizeof(PixelSums));
    out.commit();
}

Picture read_checkpoint(const std::string& path,
                        std::uint64_t hash,
                        std::int32_t width,
                        std::int32_t height) {
    const auto refuse = [&](const std::string& what) {
        throw Error(ErrorCode::BadFile, what, "render without --resume to begin again",
                    {.path = path});
    };
    const InputFile file(path);
    const Head expected;
    Head head;
    if (file.size_bytes() < sizeof(Head)) refuse("is no checkpoint: too short");
    file.read_at(0, &head, sizeof(head));
    if (head.magic != expected.magic || head.pixel_bytes != expected.pixel_bytes) {
        refuse("is no checkpoint that this version wrote");
    }
    if (head.width != width || head.height != height) {
        refuse(str("holds ", head.width, " x ", head.height, " pixels, the picture has ", width,
                   " x ", height));
    }
    if (head.hash != hash) refuse("is of another scene, or of other options");
    Picture picture(width, height);
    const std::size_t bytes = picture.pixels.size() * sizeof(PixelSums);
    if (file.size_bytes() != sizeof(Head) + bytes) {
        refuse(str("has ", file.size_bytes(), " bytes, ", sizeof(Head) + bytes, " were written"));
    }
    file.read_at(sizeof(head), picture.pixels.data(), bytes);
    if (checksum_of(picture) != head.checksum) refuse("is damaged: its pixels' checksum differs");
    return picture;
}

} // namespace heddle
