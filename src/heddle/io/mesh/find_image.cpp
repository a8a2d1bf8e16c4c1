#include <heddle/io/mesh/find_image.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/image/image.h>

#include <algorithm>

namespace heddle {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

bool is_image_suffix(const fs::path& path) {
    const std::string suffix = suffix_of(path.string());
    return suffix == ".png" || suffix == ".jpg" || suffix == ".jpeg";
}

/// The first file by name in `folder` with this stem and an image's suffix; empty if there is none.
fs::path same_stem(const fs::path& folder, const fs::path& stem) {
    std::vector<fs::path> found;
    std::error_code error;
    const fs::path listed = folder.empty() ? fs::path(".") : folder;
    for (const auto& entry : fs::directory_iterator(listed, error)) {
        if (entry.path().stem() == stem && is_image_suffix(entry.path()) && is_file(entry.path()))
            found.push_back(entry.path());
    }
    return found.empty() ? fs::path{} : *std::min_element(found.begin(), found.end());
}

fs::path locate(const fs::path& folder, const fs::path& name) {
    const fs::path beside = folder / name.filename();
    if (is_file(folder / name)) return folder / name;
    if (is_file(beside)) return beside;
    const fs::path sibling = same_stem((folder / name).parent_path(), name.stem());
    return sibling.empty() ? same_stem(folder, name.stem()) : sibling;
}

} // namespace

std::optional<Texture>
find_image(const fs::path& folder, const std::string& name, std::vector<std::string>& notes) {
    std::string slashed = name;
    std::replace(slashed.begin(), slashed.end(), '\\', '/'); // written on Windows
    const fs::path path = locate(folder, slashed);
    if (path.empty()) {
        notes.push_back(str("image '", name, "' is missing: its map is left out"));
        return std::nullopt;
    }
    if (path != folder / slashed)
        notes.push_back(str("image '", name, "' is missing: '", path.filename().string(),
                            "' is taken in its place"));
    try {
        Texture image = read_image(path);
        image.name = path.filename().string();
        widen_grey(image);
        return image;
    } catch (const Error& e) {
        if (e.code() == ErrorCode::OutOfMemory) throw;
        notes.push_back(str("image left out: ", e.what()));
        return std::nullopt;
    }
}

void widen_grey(Texture& image) {
    if (image.channels > 2) return;
    const auto from = static_cast<std::size_t>(image.channels);
    const std::size_t count = image.texels.size() / from;
    std::vector<std::uint8_t> wide;
    wide.reserve(count * (from + 2));
    for (std::size_t i = 0; i < count; ++i) {
        wide.insert(wide.end(), 3, image.texels[i * from]);
        if (from == 2) wide.push_back(image.texels[i * from + 1]);
    }
    image.texels = std::move(wide);
    image.channels += 2;
}

} // namespace heddle
