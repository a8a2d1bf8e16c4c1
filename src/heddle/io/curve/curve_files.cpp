#include <heddle/io/curve/curve_files.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>

#include <algorithm>
#include <array>

namespace heddle {
namespace {

struct CurveFormat {
    const char* suffix;
    Geometry (*read)(const std::string&, const CurveReadOptions&);
};

constexpr std::array<CurveFormat, 4> kFormats{
    {{".bcc", read_bcc}, {".hair", read_hair}, {".data", read_usc}, {".pyp", read_pyp}}};

const CurveFormat* find_format(const std::string& path) {
    const std::string suffix = suffix_of(path);
    const auto found = std::find_if(kFormats.begin(), kFormats.end(),
                                    [&](const CurveFormat& f) { return suffix == f.suffix; });
    return found == kFormats.end() ? nullptr : &*found;
}

} // namespace

bool is_curve_file(const std::string& path) {
    return find_format(path) != nullptr;
}

Geometry read_curves(const std::string& path, const CurveReadOptions& options) {
    const CurveFormat* format = find_format(path);
    if (format == nullptr) {
        throw Error(ErrorCode::Unsupported, "its suffix names no known kind of curve file",
                    "known: .bcc .hair .data .pyp", {.path = path});
    }
    return format->read(path, options);
}

} // namespace heddle
