#include <heddle/base/error.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/load.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/io/file/output_file.h>
#include <heddle/io/image/image.h>
#include <heddle/io/yarn/yarn_file.h>
#include <heddle/yarn/slice_image.h>

#include <algorithm>
#include <filesystem>

namespace heddle::cli {
namespace {

/// The outputs that were asked for beside the image, with the suffix that each must have.
struct Extra {
    const char* option;
    const char* suffix;
};
constexpr Extra kExtras[] = {{"occlusion", ".png"}, {"mipmaps", ".png"}, {"yarn-file", ".toml"}};

void write_texture(const std::string& path, const Texture& image) {
    write_output([&] { write_png(path, image.width, image.height, image.channels, image.texels); });
}

/// All sizes of a slice side by side, the largest first.
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

/// The yarn of the image at `image`, so that --yarn takes the file.
void write_yarn_file(const std::string& path, YarnType yarn, const std::string& image) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::absolute(path).parent_path();
    yarn.slice.name = fs::absolute(image).lexically_relative(folder).generic_string();
    write_output([&] {
        OutputFile file(path);
        const std::string text = write_yarn_toml(yarn);
        file.write(text.data(), text.size());
        file.commit();
    });
}

void run_slice(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const std::string output = arguments.text("output");
    check_output(output, ".png");
    for (const auto& [option, suffix] : kExtras) {
        if (arguments.given(option))
            check_output(arguments.text(option), suffix, str("--", option));
    }
    bar.begin("read", "files", 1);
    YarnFile file =
        read_yarn(arguments.text("YARN"), [](const std::string& path) { return read_image(path); });
    if (arguments.given("fibers")) {
        const std::string note = set_fiber_count(file.yarn, arguments.integer("fibers"));
        if (!note.empty()) file.notes.push_back(note);
    }
    bar.begin("slice", "images", 1);
    const SliceImage made =
        make_slice(file.yarn, {.size = static_cast<std::int32_t>(arguments.integer("size")),
                               .seed = static_cast<std::uint64_t>(arguments.integer("seed"))});
    for (const std::string& note : file.notes) report.note(note);
    for (const std::string& note : made.notes) report.note(note);
    write_texture(output, made.yarn.slice);
    report.text("output", output);
    if (arguments.given("occlusion")) {
        write_texture(arguments.text("occlusion"), bake_occlusion(made.yarn));
        report.text("occlusion", arguments.text("occlusion"));
    }
    if (arguments.given("mipmaps")) {
        write_texture(arguments.text("mipmaps"), mipmap_sheet(made.yarn.slice));
        report.text("mipmaps", arguments.text("mipmaps"));
    }
    if (arguments.given("yarn-file")) {
        write_yarn_file(arguments.text("yarn-file"), made.yarn, output);
        report.text("yarn-file", arguments.text("yarn-file"));
    }
    report.count("fibers", made.yarn.slice_fibers);
    report.number("twist", static_cast<double>(made.yarn.twist), "radians per yarn model unit");
    report.number("yarn radius", static_cast<double>(made.yarn.model_radius),
                  "yarn model units, half of the image's side");
}

} // namespace

Command slice_command() {
    return {
        "slice",
        "Draws the cross-section of a procedural yarn as an image: albedo, and the fibers' volume fraction as alpha.",
        joined({
            grouped(
                "Input and output",
                {
                    {"YARN", "", "", any_text(), "",
                     "Yarn model: a preset, a .toml file, or a .txt file of a fit after Zhao et al. 2016.",
                     true},
                    {"-o, --output", "OUT.png", "", any_text(), "",
                     "Output image of the cross-section.", true},
                    {"--yarn-file", "OUT.toml", "", any_text(), "",
                     "Also writes a yarn model of this image, for voxelize --yarn."},
                    {"--occlusion", "OUT.png", "", any_text(), "",
                     "Also writes the ambient light that reaches each texel, for previews."},
                    {"--mipmaps", "OUT.png", "", any_text(), "",
                     "Also writes all smaller sizes side by side; each keeps the opacity seen from the side."},
                }),
            grouped("Image",
                    {
                        {"--size", "N", "256", integer(1, 4096), "texels",
                         "Width and height of the image."},
                        {"--fibers", "N", "(from the yarn model)", integer(1, 1'000'000), "",
                         "Number of fibers in the yarn, over all plies."},
                    }),
        }),
        run_slice};
}

} // namespace heddle::cli
