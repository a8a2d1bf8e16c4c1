#include <heddle/job/slice_yarn.h>

#include <heddle/io/image/image.h>
#include <heddle/io/yarn/yarn_file.h>
#include <heddle/job/phase_clock.h>
#include <heddle/job/write_output.h>
#include <heddle/yarn/slice_image.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace heddle::job {
namespace {

void write_texture(const std::string& path, const Texture& image) {
    write_output([&] { write_png(path, image.width, image.height, image.channels, image.texels); });
}

/// Writes a yarn file that refers to the image at `image` by a relative path.
void write_yarn_file(const std::string& path, YarnType yarn, const std::string& image) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::absolute(path).parent_path();
    yarn.slice.name = fs::absolute(image).lexically_relative(folder).generic_string();
    write_text(path, write_yarn_toml(yarn));
}

void check_files(const SliceFiles& files) {
    check_output(files.image, ".png");
    if (files.occlusion) check_output(*files.occlusion, ".png", "occlusion");
    if (files.mipmaps) check_output(*files.mipmaps, ".png", "mipmaps");
    if (files.yarn_file) check_output(*files.yarn_file, ".toml", "yarn_file");
}

} // namespace

SlicedYarn
slice_yarn(const std::string& yarn, const SliceYarnOptions& options, Progress& progress) {
    progress.begin("read", "files", 1);
    YarnFile file = read_yarn(yarn, [](const std::string& path) { return read_image(path); });
    std::vector<std::string> notes = std::move(file.notes);
    if (options.fibers) {
        const std::string note = set_fiber_count(file.yarn, *options.fibers);
        if (!note.empty()) notes.push_back(note);
    }
    progress.check();
    progress.begin("slice", "images", 1);
    SliceImage made = make_slice(file.yarn, {.size = options.size, .seed = options.seed});
    notes.insert(notes.end(), made.notes.begin(), made.notes.end());
    progress.check();
    SlicedYarn out{std::move(made.yarn), {}};
    take_notes(out.notes, notes, progress);
    return out;
}

Texture mipmap_sheet(const Texture& slice) {
    const std::vector<Texture> levels = shrink_slice(slice);
    Texture sheet = slice;
    for (std::size_t l = 1; l < levels.size(); ++l) sheet.width += levels[l].width;
    const auto row = 4 * static_cast<std::size_t>(sheet.width);
    sheet.texels.assign(row * static_cast<std::size_t>(sheet.height), 0);
    std::size_t left = 0;
    for (const Texture& level : levels) {
        const auto width = 4 * static_cast<std::size_t>(level.width);
        for (std::size_t y = 0; y < static_cast<std::size_t>(level.height); ++y) {
            std::copy_n(level.texels.data() + y * width, width,
                        sheet.texels.data() + y * row + left);
        }
        left += width;
    }
    return sheet;
}

SlicedYarn slice_yarn_to_files(const std::string& yarn,
                               const SliceFiles& files,
                               const SliceYarnOptions& options,
                               Progress& progress) {
    check_files(files);
    SlicedYarn made = slice_yarn(yarn, options, progress);
    write_texture(files.image, made.yarn.slice);
    if (files.occlusion) write_texture(*files.occlusion, bake_occlusion(made.yarn));
    if (files.mipmaps) write_texture(*files.mipmaps, mipmap_sheet(made.yarn.slice));
    if (files.yarn_file) write_yarn_file(*files.yarn_file, made.yarn, files.image);
    return made;
}

} // namespace heddle::job
