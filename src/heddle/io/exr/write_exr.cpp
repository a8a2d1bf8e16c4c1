#include <heddle/io/exr/exr.h>

#include <heddle/base/error.h>
#include <heddle/io/exr/exr_header.h>
#include <heddle/io/file/output_file.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <exception>
#include <new>
#include <set>

namespace heddle {
namespace {

constexpr float kMaxHalf = 65504.0f;

/// A file that grows in memory; OpenEXR seeks back to write the offsets of its blocks.
class MemoryOutput : public Imf::OStream {
public:
    explicit MemoryOutput(const std::string& path) : OStream(path.c_str()) {}
    void write(const char* from, int count) override {
        const auto n = static_cast<std::size_t>(std::max(count, 0));
        if (at_ + n > bytes_.size()) bytes_.resize(at_ + n);
        std::copy_n(from, n, bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
        at_ += n;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = position; }
    [[nodiscard]] const std::vector<char>& bytes() const { return bytes_; }

private:
    std::vector<char> bytes_;
    std::size_t at_ = 0;
};

[[noreturn]] void refuse(const std::string& what, const std::string& fix) {
    throw Error(ErrorCode::InvalidArgument, what, fix);
}

void check_name(const std::string& name, const char* kind, std::set<std::string>& seen) {
    if (name.empty() || name.size() > 255 || name.find('\0') != std::string::npos) {
        refuse(str("the ", kind, " name '", name.substr(0, 32), "' has ", name.size(), " bytes"),
               "use 1 to 255 bytes, none of them zero");
    }
    if (!seen.insert(name).second) {
        refuse(str("the ", kind, " name '", name, "' stands twice"), "name each once");
    }
}

void check_picture(std::int64_t width, std::int64_t height, std::span<const ExrChannel> channels) {
    if (width < 1 || height < 1 || width > exr::kMaxSide || height > exr::kMaxSide ||
        width * height > exr::kMaxPixels) {
        refuse(str("a picture of ", width, " x ", height, " px cannot be written"),
               "use 1 to 2^20 px a side, at most 2^28 px");
    }
    if (channels.empty() || channels.size() > static_cast<std::size_t>(exr::kMaxChannels)) {
        refuse(str("a picture of ", channels.size(), " channels cannot be written"),
               str("use 1 to ", exr::kMaxChannels));
    }
    std::set<std::string> seen;
    for (const ExrChannel& channel : channels) {
        check_name(channel.name, "channel", seen);
        if (channel.values.size() != static_cast<std::size_t>(width * height)) {
            refuse(str("channel '", channel.name, "' has ", channel.values.size(), " values, ",
                       width, " x ", height, " px need ", width * height),
                   "give one value per pixel");
        }
    }
}

Imf::Header make_header(std::int32_t width,
                        std::int32_t height,
                        std::span<const ExrChannel> channels,
                        const ExrAttributes& attributes) {
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    std::set<std::string> seen;
    for (const auto& [name, text] : attributes) {
        check_name(name, "attribute", seen);
        if (header.find(name.c_str()) != header.end()) {
            refuse(str("the attribute '", name, "' is one of the format's own"),
                   "use another name");
        }
        header.insert(name.c_str(), Imf::StringAttribute(text));
    }
    for (const ExrChannel& channel : channels) {
        header.channels().insert(channel.name.c_str(),
                                 Imf::Channel(channel.half ? Imf::HALF : Imf::FLOAT));
    }
    return header;
}

std::vector<Imath::half> to_halves(std::span<const float> values) {
    std::vector<Imath::half> halves(values.size());
    std::transform(values.begin(), values.end(), halves.begin(), [](float x) {
        return Imath::half(std::isnan(x) ? x : std::clamp(x, -kMaxHalf, kMaxHalf));
    });
    return halves;
}

void encode(MemoryOutput& stream,
            const Imf::Header& header,
            std::int32_t height,
            std::span<const ExrChannel> channels) {
    std::deque<std::vector<Imath::half>> halves; // never moves: the frame buffer points into it
    const Imath::Box2i window = header.dataWindow();
    Imf::FrameBuffer frame;
    for (const ExrChannel& channel : channels) {
        const void* values = channel.values.data();
        if (channel.half) values = halves.emplace_back(to_halves(channel.values)).data();
        frame.insert(channel.name.c_str(),
                     Imf::Slice::Make(channel.half ? Imf::HALF : Imf::FLOAT, values, window));
    }
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(frame);
    file.writePixels(height);
} // the destructor of `file` writes the table of blocks

} // namespace

void write_exr(const std::string& path,
               std::int32_t width,
               std::int32_t height,
               std::span<const ExrChannel> channels,
               const ExrAttributes& attributes) {
    check_picture(width, height, channels);
    OutputFile file(path);
    MemoryOutput stream(path);
    try {
        encode(stream, make_header(width, height, channels, attributes), height, channels);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "no memory to encode the picture",
                    "write a smaller one", {.path = path});
    } catch (const std::exception& e) {
        throw Error(ErrorCode::InvalidArgument, str("cannot be stored as OpenEXR (", e.what(), ")"),
                    {}, {.path = path});
    }
    file.write_array(std::span<const char>(stream.bytes()));
    file.commit();
}

} // namespace heddle
