#include <heddle/io/exr/exr.h>

#include <heddle/base/error.h>
#include <heddle/io/exr/exr_header.h>
#include <heddle/io/file/input_file.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <Imath/ImathBox.h>

#include <array>
#include <exception>
#include <new>

namespace heddle {
namespace {

using Names = std::array<const char*, 3>;

/// The channels that become red, green and blue.
Names choose_channels(const Imf::ChannelList& held, const std::string& path) {
    constexpr Names kColor{"R", "G", "B"};
    constexpr Names kGrey{"Y", "Y", "Y"};
    for (const Names& names : {kColor, kGrey}) {
        bool whole = true;
        for (const char* name : names) {
            const Imf::Channel* channel = held.findChannel(name);
            whole &= channel != nullptr && channel->xSampling == 1 && channel->ySampling == 1;
        }
        if (whole) return names;
    }
    std::string found;
    for (auto c = held.begin(); c != held.end(); ++c)
        found += str(found.empty() ? "" : ", ", c.name());
    throw Error(ErrorCode::BadFile,
                str("has no R, G, B or Y at every pixel; it has: ", found.substr(0, 200)),
                "store it as RGB", {.path = path});
}

FloatImage read_pixels(Imf::InputFile& file, const std::string& path) {
    const Imath::Box2i window = file.header().dataWindow();
    FloatImage image;
    image.width = window.max.x - window.min.x + 1;
    image.height = window.max.y - window.min.y + 1;
    const Names names = choose_channels(file.header().channels(), path);
    const std::size_t pixels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    image.values.resize(3 * pixels);
    const bool grey = names[0] == names[1];
    const std::size_t pixel_bytes = 3 * sizeof(float);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < (grey ? 1u : 3u); ++c) {
        frame.insert(names[c],
                     Imf::Slice::Make(Imf::FLOAT, image.values.data() + c, window, pixel_bytes,
                                      pixel_bytes * static_cast<std::size_t>(image.width)));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    if (grey) {
        for (std::size_t i = 0; i < pixels; ++i) {
            image.values[3 * i + 1] = image.values[3 * i + 2] = image.values[3 * i];
        }
    }
    return image;
}

} // namespace

FloatImage read_exr_rgb(const std::string& path) {
    const std::string bytes = read_whole_file(path, kAnySize);
    try {
        exr::check_header(bytes, path);
        exr::MemoryInput stream(bytes, path);
        Imf::InputFile file(stream, 0);
        return read_pixels(file, path);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "no memory for the picture", "use a smaller one",
                    {.path = path});
    } catch (const std::exception& e) {
        throw Error(ErrorCode::BadFile, str("cannot be read as OpenEXR (", e.what(), ")"),
                    "the file was cut short or damaged; get it again", {.path = path});
    }
}

} // namespace heddle
