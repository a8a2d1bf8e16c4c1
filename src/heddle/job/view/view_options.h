#pragma once

#include <heddle/job/geometry_input.h>
#include <heddle/viewer/session/session.h>
#include <heddle/viewer/session/settings.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// What a view shows.
struct ViewInput {
    std::string path{}; ///< curves, or a .vdb
    GeometryOptions geometry{};
    std::optional<std::string> volume{}; ///< a .vdb that is shown beside curves
    std::string folder = ".";            ///< in which files are saved
    std::uint64_t seed = 0;
    std::optional<std::int64_t> memory_bytes{}; ///< for slices and their order; none: one buffer
};

/// How slices are blended.
enum class SliceBlend : std::uint8_t { Sorted, Weighted, Placed };

/// The initial settings of a view. Nothing is required.
struct ViewOptions {
    std::int32_t width = 960; ///< px, 1 to 8192
    std::int32_t height = 960;
    Vec3d from{0.3, -0.6, 1.0};    ///< from the object to the eye, any length but 0
    std::optional<int> up_axis{};  ///< 0, 1 or 2; none: z if the object lies flat, else y
    Vec3d light{-0.5, 0.6, 1.0};   ///< from the object to the light, any length but 0
    std::optional<Vec3d> target{}; ///< scene units; none: the middle of the bounds
    double zoom = 1.0;             ///< > 0; 1: the object fits in from all sides
    double view_angle_deg = 35.0;  ///< across the picture's height; 0: parallel rays
    viewer::Show show = viewer::Show::Slices; ///< for curves with a volume
    std::string color = "shaded";             ///< one of slice_color_names() or voxel_color_names()
    double opacity = 1.0;       ///< scales the optical depth of slices and voxels, > 0
    std::optional<int> level{}; ///< of voxels; none: by the footprint of each pixel
    bool blocks = false;        ///< draws the edges of occupied blocks
    std::optional<Vec3i> white_block{};
    SliceBlend blend = SliceBlend::Sorted;
    bool shadows = true;
    bool occlusion = true;
};

/// Return the names of colour modes, in the order of viewer::SliceColor and viewer::VoxelColor.
[[nodiscard]] const std::vector<std::string>& slice_color_names();
[[nodiscard]] const std::vector<std::string>& voxel_color_names();

/// Checks, before any file is read, that the options can be used together.
/// @param scene  a scene file, which needs voxels, will be written
/// @throws OptionError  they cannot be used together, or are out of range
void check_view(const ViewInput& input, const ViewOptions& options, bool scene);

/// Returns the initial settings of a view. It orbits the unit ball (Settings::framed).
/// @throws OptionError  the colour name is unknown
[[nodiscard]] viewer::Settings view_settings(const ViewOptions& options,
                                             const viewer::ViewedObject& subject);

} // namespace heddle::job
