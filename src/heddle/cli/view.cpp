#include <heddle/base/error.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/load.h>
#include <heddle/cli/progress_bar.h>
#include <heddle/cli/report.h>
#include <heddle/io/image/image.h>
#include <heddle/raster/context.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/viewer/slice_view.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>

namespace heddle::cli {
namespace {

Vec3d direction(const Arguments& arguments, const char* name) {
    const std::vector<double> v = arguments.numbers(name);
    return {v[0], v[1], v[2]};
}

viewer::ViewOptions view_options(const Arguments& arguments) {
    const std::vector<double> size = arguments.numbers("size", 'x');
    return {.width = static_cast<std::int32_t>(size[0]),
            .height = static_cast<std::int32_t>(size[1]),
            .sorted = !arguments.given("unsorted"),
            .shadows = !arguments.given("no-shadows"),
            .occlusion = !arguments.given("no-occlusion"),
            .opacity = arguments.number("opacity"),
            .seed = static_cast<std::uint64_t>(arguments.integer("seed"))};
}

Vec3d axis_of(const std::string& name) {
    return {name == "x" ? 1.0 : 0.0, name == "y" ? 1.0 : 0.0, name == "z" ? 1.0 : 0.0};
}

/// `v` turned about the unit vector `axis`.
Vec3d turn_about(Vec3d v, Vec3d axis, double angle) {
    const Vec3d along = axis * dot(axis, v);
    const Vec3d across = v - along;
    return along + across * std::cos(angle) + cross(axis, across) * std::sin(angle);
}

std::string frame_path(const std::string& folder, std::int64_t frame) {
    std::ostringstream name;
    name << "frame_" << std::setw(4) << std::setfill('0') << frame << ".png";
    return (std::filesystem::path(folder) / name.str()).string();
}

void make_folder(const std::string& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (!std::filesystem::is_directory(folder, failed)) {
        throw Error(ErrorCode::CannotWrite, "cannot make this folder", "write to another place",
                    {.path = folder});
    }
}

void draw_frames(const viewer::SliceView& view,
                 const Arguments& arguments,
                 Report& report,
                 ProgressBar& bar) {
    const std::int64_t frames = arguments.integer("frames");
    const Vec3d up = axis_of(arguments.text("up"));
    viewer::ViewTimes sum;
    bar.begin("draw", "frames", frames);
    for (std::int64_t f = 0; f < frames; ++f) {
        bar.check();
        const double angle =
            2.0 * std::numbers::pi * static_cast<double>(f) / static_cast<double>(frames);
        viewer::ViewTimes times;
        const viewer::ViewImage image =
            view.draw({.from = turn_about(direction(arguments, "from"), up, angle),
                       .up = up,
                       .light = direction(arguments, "light"),
                       .zoom = arguments.number("zoom")},
                      &times);
        write_output([&] {
            write_png(frame_path(arguments.text("output"), f), image.width, image.height, 3,
                      image.rgb);
        });
        sum.sort += times.sort;
        sum.shadow += times.shadow;
        sum.draw += times.draw;
        bar.advance(1);
    }
    const auto each = 1.0 / static_cast<double>(frames);
    report.seconds("sort a frame", sum.sort * each);
    report.seconds("shadow a frame", sum.shadow * each);
    report.seconds("draw a frame", sum.draw * each);
}

void run_view(const Arguments& arguments, Report& report, ProgressBar& bar) {
    bar.begin("read", "files", 1);
    Geometry geometry = load_geometry(arguments.text("FILE"), arguments);
    apply_model(geometry, arguments);
    const viewer::ViewOptions options = view_options(arguments);
    for (std::string& note : raster::make_slices_of_yarns(geometry, options.seed)) {
        geometry.notes.push_back(std::move(note));
    }
    for (const std::string& note : geometry.notes) report.note(note);
    make_folder(arguments.text("output"));
    bar.begin("place slices", "files", 1);
    const raster::Context context;
    const viewer::SliceView view(context, std::move(geometry), options);
    report.text("output", arguments.text("output"));
    report.text("driver", context.driver());
    report.count("slices", view.slice_count());
    draw_frames(view, arguments, report, bar);
    bar.finish();
    for (const auto& [stage, seconds] : bar.stages()) report.seconds(stage, seconds);
}

} // namespace

Command view_command() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    std::vector<Option> options{
        {"FILE", "", "", any_text(), "", "curves: .bcc .hair .data .pyp", true},
        {"--headless", "", "", flag(), "", "into pictures: there is no window yet", true},
        {"-o, --output", "DIR", "", any_text(), "", "folder of the pictures, frame_0000.png on",
         true},
        {"--frames", "N", "1", integer(1, 10000), "pictures", "once around the object"},
    };
    for (const std::vector<Option>& more : {load_options(), model_options()}) {
        for (const Option& row : more) {
            if (row.key().rfind("height-", 0) != 0) options.push_back(row);
        }
    }
    const std::vector<Option> more{
        {"--from", "X,Y,Z", "0.3,-0.6,1", numbers(3, 3, -kInf, kInf), "any length",
         "direction from the object to the eye, of the first picture"},
        {"--up", "AXIS", "y", one_of({"x", "y", "z"}), "",
         "points up in the picture; pictures go around it"},
        {"--light", "X,Y,Z", "-0.5,0.6,1", numbers(3, 3, -kInf, kInf), "any length",
         "direction from the object to the light"},
        {"--zoom", "Z", "1", positive(), "", "1 = all of the object, from any side"},
        {"--size", "WxH", "960x960", numbers(2, 2, 1, 8192, 'x'), "pixels", "of a picture"},
        {"--opacity", "K", "1", positive(), "", "multiplies how much a slice hides"},
        {"--no-shadows", "", "", flag(), "", "leaves out the shadow map"},
        {"--no-occlusion", "", "", flag(), "", "leaves out what fibers hide in their section"},
        {"--unsorted", "", "", flag(), "", "draws slices as they were placed, to compare"},
    };
    options.insert(options.end(), more.begin(), more.end());
    return {"view", "pictures of yarns as shaded slices, by OpenGL", options, run_view};
}

} // namespace heddle::cli
