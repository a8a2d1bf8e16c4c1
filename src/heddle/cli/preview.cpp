#include <heddle/base/error.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/job/render/preview_volume.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace heddle::cli {
namespace {

const std::vector<std::string>& color_names() {
    static const std::vector<std::string> names{"albedo", "tangent", "width", "material", "block"};
    return names; // in the order of PreviewColor
}

PreviewOptions preview_options_from(const Arguments& arguments) {
    PreviewOptions options;
    const auto color =
        std::find(color_names().begin(), color_names().end(), arguments.text("color"));
    options.color = static_cast<PreviewColor>(color - color_names().begin());
    if (arguments.given("from")) {
        const std::vector<double> from = arguments.numbers("from");
        options.from = Vec3d{from[0], from[1], from[2]};
    }
    if (arguments.given("up")) options.up_axis = arguments.text("up").front() - 'x';
    const std::vector<double> size = arguments.numbers("size", 'x');
    options.width = static_cast<std::int32_t>(size[0]);
    options.height = static_cast<std::int32_t>(size[1]);
    options.field_of_view = arguments.number("view-angle") * std::numbers::pi / 180.0;
    options.rays = static_cast<std::int32_t>(arguments.integer("rays"));
    options.transparent = arguments.given("transparent");
    return options;
}

void run_preview(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const std::string& output = arguments.text("output");
    const job::PreviewReport done = job::preview_volume_to_file(
        arguments.text("FILE"), output, static_cast<int>(arguments.integer("level")),
        preview_options_from(arguments), bar);
    report.text("output", output);
    report.count("voxels", done.voxels);
    report.add("size", "size", {done.width, done.height},
               str(done.width, " x ", done.height, " pixels"));
    report_phases(report, done.phases);
}

} // namespace

Command preview_command() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    return {
        "preview", "Draws a quick picture of a .vdb, for inspection.",
        joined({
            grouped("Input and output",
                    {
                        {"FILE", "", "", any_text(), "", "A .vdb written by heddle.", true},
                        {"-o, --output", "OUT.png", "", any_text(), "", "Output picture.", true},
                    }),
            grouped(
                "Picture",
                {
                    {"--size", "WxH", "1024x1024", numbers(2, 2, 1, 16384, 'x'), "pixels",
                     "Size of the picture."},
                    {"--color", "BY", "albedo", one_of(color_names()), "",
                     "Quantity shown as colour; tangent and width are those of the heaviest lobe, block is a cell of 32^3 voxels."},
                    {"--level", "N", "0", integer(0, 1000), "",
                     "Level of detail; 0 = the finest. Each level doubles the voxel size."},
                    {"--rays", "N", "1", integer(1, 8), "per pixel and axis",
                     "Rays for antialiasing; N x N per pixel."},
                    {"--transparent", "", "", flag(), "",
                     "Keeps the alpha channel; otherwise the background is white."},
                }),
            grouped("Camera",
                    {
                        {"--from", "X,Y,Z", "(three-quarter view from the front and above)",
                         numbers(3, 3, -kInf, kInf), "any length",
                         "Direction from the object to the camera."},
                        {"--up", "AXIS", "(z if the object is flat in x and y, else y)",
                         one_of({"x", "y", "z"}), "", "Axis that points up in the picture."},
                        {"--view-angle", "A", "0", number(0, 179), "degrees",
                         "Field of view across the picture's height; 0 = parallel projection."},
                    }),
        }),
        run_preview};
}

} // namespace heddle::cli
