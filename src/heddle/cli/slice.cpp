#include <heddle/cli/commands.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/job/slice_yarn.h>

namespace heddle::cli {
namespace {

void run_slice(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const job::SliceFiles files{.image = arguments.text("output"),
                                .yarn_file = arguments.find_text("yarn-file"),
                                .occlusion = arguments.find_text("occlusion"),
                                .mipmaps = arguments.find_text("mipmaps")};
    const job::SliceYarnOptions options{
        .size = static_cast<std::int32_t>(arguments.integer("size")),
        .fibers = arguments.find_integer("fibers"),
        .seed = static_cast<std::uint64_t>(arguments.integer("seed"))};
    const job::SlicedYarn made =
        job::slice_yarn_to_files(arguments.text("YARN"), files, options, bar);
    report_notes(report, made.notes);
    report.text("output", files.image);
    for (const char* option : {"occlusion", "mipmaps", "yarn-file"}) {
        if (arguments.given(option)) report.text(option, arguments.text(option));
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
