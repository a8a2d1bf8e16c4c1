#include <heddle/job/view/view_options.h>

#include <heddle/io/file/input_file.h>
#include <heddle/job/option_error.h>

#include <algorithm>
#include <numbers>

namespace heddle::job {
namespace {

void check_color(const std::string& color, bool voxels) {
    const std::vector<std::string>& names = voxels ? voxel_color_names() : slice_color_names();
    if (std::find(names.begin(), names.end(), color) != names.end()) return;
    std::string known;
    for (const std::string& name : names) known += str(known.empty() ? "" : ", ", name);
    throw OptionError(str("`color` ", color, " is not available for ", voxels ? "voxels" : "slices",
                          "; known: ", known));
}

/// Returns the index of `name` in `names`, which must contain it.
template <typename Color>
Color color_of(const std::vector<std::string>& names, const std::string& name) {
    return static_cast<Color>(std::find(names.begin(), names.end(), name) - names.begin());
}

viewer::SliceLook slice_look(const ViewOptions& options) {
    viewer::SliceLook look;
    look.light = options.light;
    look.sorted = options.blend != SliceBlend::Placed;
    look.weighted = options.blend == SliceBlend::Weighted;
    look.shadows = options.shadows;
    look.occlusion = options.occlusion;
    look.opacity = options.opacity;
    return look;
}

viewer::VoxelLook voxel_look(const ViewOptions& options) {
    viewer::VoxelLook look;
    look.shadows = options.shadows;
    look.level = options.level.value_or(-1);
    look.density_scale = options.opacity;
    look.blocks = options.blocks;
    look.white_block = options.white_block;
    return look;
}

/// Returns the axis of the options, or as in a preview: z if the object lies flat, else y.
Vec3d up_of(const ViewOptions& options, const viewer::ViewedObject& subject) {
    int axis = options.up_axis.value_or(1);
    if (!options.up_axis) {
        const Vec3d size = viewer::bounds_of(subject).size();
        if (size.z < 0.5 * size.x && size.z < 0.5 * size.y) axis = 2;
    }
    Vec3d up{};
    up[axis] = 1.0;
    return up;
}

/// Returns an orbit about the unit ball.
viewer::Orbit orbit_of(const ViewOptions& options, const viewer::ViewedObject& subject) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    viewer::Orbit orbit{.from = options.from,
                        .up = up_of(options, subject),
                        .view_angle = options.view_angle_deg * kDegree};
    orbit.frame({.radius = 1.0},
                static_cast<double>(options.width) / static_cast<double>(options.height));
    if (options.target) orbit.target = *options.target;
    orbit.zoom(options.zoom);
    return orbit;
}

} // namespace

const std::vector<std::string>& slice_color_names() {
    static const std::vector<std::string> names{"shaded", "direction", "grid"};
    return names;
}

const std::vector<std::string>& voxel_color_names() {
    static const std::vector<std::string> names{"shaded",   "density", "tangent", "width",
                                                "material", "block",   "level"};
    return names;
}

void check_view(const ViewInput& input, const ViewOptions& options, bool scene) {
    check_geometry_options(input.geometry);
    const bool volume = suffix_of(input.path) == ".vdb";
    if (input.volume && volume) {
        throw OptionError(
            "`volume` cannot be used with a .vdb as FILE; it shows voxels beside curves");
    }
    const bool voxels = volume || options.show == viewer::Show::Voxels;
    if (!volume && !input.volume && (scene || voxels || options.color == "grid")) {
        throw OptionError("there are no voxels to show; open a .vdb, or give `volume` X.vdb");
    }
    check_color(options.color, voxels);
    if (!(options.zoom > 0.0)) throw OptionError("`zoom` must be above 0");
    if (!(options.opacity > 0.0)) throw OptionError("`opacity` must be above 0");
    if (options.up_axis && (*options.up_axis < 0 || *options.up_axis > 2)) {
        throw OptionError(str("`up_axis` is ", *options.up_axis, "; it must be 0, 1 or 2"));
    }
}

viewer::Settings view_settings(const ViewOptions& options, const viewer::ViewedObject& subject) {
    const bool voxels = !subject.geometry || options.show == viewer::Show::Voxels;
    check_color(options.color, voxels);
    viewer::Settings out;
    out.orbit = orbit_of(options, subject);
    out.target_given = options.target.has_value();
    out.framed = true;
    out.slices = slice_look(options);
    out.volume = voxel_look(options);
    out.show = voxels ? viewer::Show::Voxels : viewer::Show::Slices;
    if (voxels)
        out.volume.color = color_of<viewer::VoxelColor>(voxel_color_names(), options.color);
    else
        out.slices.color = color_of<viewer::SliceColor>(slice_color_names(), options.color);
    return out;
}

} // namespace heddle::job
