#include <heddle/io/image/image.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/file/output_file.h>
#include <heddle/io/image/jpeg_tables.h>

#include <limits>
#include <memory>

// The only file that compiles stb; static, because libtinygltf contains a copy of its own.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

namespace heddle {
namespace {

// Deflate compresses by at most 1032, and a PNG texel has at least one bit; JPEG compresses less. A
// header with more texels per byte is false and must not make us allocate.
constexpr std::int64_t kMaxTexelsPerByte = 8 * 1032;
constexpr std::int64_t kMaxSide = 1 << 24;

void check_size(std::int64_t width, std::int64_t height, std::int64_t channels, std::size_t held) {
    if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide || channels < 1 ||
        channels > 4)
        throw Error(ErrorCode::InvalidArgument,
                    str("an image of ", width, " x ", height, " px with ", channels,
                        " channels cannot be a PNG"),
                    "use 1 to 2^24 px a side and 1 to 4 channels");
    const std::int64_t bytes = (width * channels + 1) * height; // a filter byte starts each row
    if (bytes > std::numeric_limits<std::int32_t>::max())
        throw Error(ErrorCode::InvalidArgument,
                    str("an image of ", width, " x ", height, " px has ", bytes,
                        " bytes, the encoder takes fewer than 2^31"),
                    "write a smaller image");
    const std::int64_t needed = width * height * channels;
    if (static_cast<std::uint64_t>(needed) != held)
        throw Error(ErrorCode::InvalidArgument,
                    str("an image of ", width, " x ", height, " px with ", channels,
                        " channels has ", needed, " values, not ", held));
}

} // namespace

Texture read_image(const std::filesystem::path& path) {
    const std::string bytes = read_whole_file(path.string());
    return decode_image(std::as_bytes(std::span{bytes}), path.string());
}

Texture decode_image(std::span<const std::byte> bytes, const std::string& name) {
    const auto fail = [&](const std::string& what) {
        throw Error(ErrorCode::BadFile, what, "store it as PNG or baseline JPEG again",
                    {.path = name});
    };
    if (bytes.empty()) fail("is empty, not a PNG or JPEG image");
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        fail(str("has ", bytes.size(), " bytes, an image has fewer than 2^31"));
    check_jpeg_tables(bytes, name); // false tables make stb 2.27 write past its arrays
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    Texture image;
    if (stbi_info_from_memory(data, size, &image.width, &image.height, &image.channels) == 0)
        fail(str("is not a PNG or JPEG image (", stbi_failure_reason(), ")"));
    if (std::int64_t{image.width} * image.height > kMaxTexelsPerByte * std::int64_t{size})
        fail(str("says ", image.width, " x ", image.height, " px, but has only ", size, " bytes"));
    const std::unique_ptr<stbi_uc, void (*)(void*)> texels{
        stbi_load_from_memory(data, size, &image.width, &image.height, &image.channels, 0),
        stbi_image_free};
    if (!texels) fail(str("is a broken image (", stbi_failure_reason(), ")"));
    image.name = name;
    const std::int64_t count = std::int64_t{image.width} * image.height * image.channels;
    image.texels.assign(texels.get(), texels.get() + count);
    return image;
}

std::vector<std::uint8_t> encode_png(std::int32_t width,
                                     std::int32_t height,
                                     std::int32_t channels,
                                     std::span<const std::uint8_t> texels) {
    check_size(width, height, channels, texels.size());
    std::vector<std::uint8_t> png;
    const auto append = [](void* target, void* data, int size) {
        const auto* from = static_cast<const std::uint8_t*>(data);
        auto& to = *static_cast<std::vector<std::uint8_t>*>(target);
        to.insert(to.end(), from, from + size);
    };
    if (stbi_write_png_to_func(append, &png, width, height, channels, texels.data(),
                               width * channels) == 0)
        throw Error(ErrorCode::OutOfMemory,
                    str("no memory to encode an image of ", width, " x ", height, " px"),
                    "write a smaller image");
    return png;
}

void write_png(const std::filesystem::path& path,
               std::int32_t width,
               std::int32_t height,
               std::int32_t channels,
               std::span<const std::uint8_t> texels) {
    const std::vector<std::uint8_t> png = encode_png(width, height, channels, texels);
    OutputFile file(path.string());
    file.write_array(std::span<const std::uint8_t>(png));
    file.commit();
}

} // namespace heddle
