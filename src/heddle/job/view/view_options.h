#pragma once

#include <heddle/job/geometry_input.h>
#include <heddle/viewer/session/session.h>
#include <heddle/viewer/session/settings.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// What is looked at.
struct ViewInput {
    std::string path{}; ///< curves, or a .vdb
    GeometryOptions geometry{};
    std::optional<std::string> volume{}; ///< a .vdb beside curves
    std::string folder = ".";            ///< where files are saved
    std::uint64_t seed = 0;
    std::optional<std::int64_t> memory_bytes{}; ///< of slices and their order; none: one buffer's
};

/// How slices are put over each other.
enum class SliceBlend : std::uint8_t { Sorted, Weighted, Placed };

/// How it is looked at first. Nothing is required.
struct ViewOptions {
    std::int32_t width = 960; ///< px, 1 to 8192
    std::int32_t height = 960;
    Vec3d from{0.3, -0.6, 1.0};               ///< from the object to the eye, any length but 0
    std::optional<int> up_axis{};             ///< 0, 1, 2; none: z of what lies flat, else y
    Vec3d light{-0.5, 0.6, 1.0};              ///< from the object to the light, any length but 0
    std::optional<Vec3d> target{};            ///< scene units; none: the middle of all
    double zoom = 1.0;                        ///< > 0; 1: all of the object, from any side
    double view_angle_deg = 35.0;             ///< across the picture's height; 0: parallel rays
    viewer::Show show = viewer::Show::Slices; ///< of curves with a volume
    std::string color = "shaded";             ///< of slice_color_names() or voxel_color_names()
    double opacity = 1.0;                     ///< multiplies how much slices and voxels hide, > 0
    std::optional<int> level{};               ///< of voxels; none: by each pixel's width
    bool blocks = false;                      ///< edges of occupied blocks
    std::optional<Vec3i> white_block{};
    SliceBlend blend = SliceBlend::Sorted;
    bool shadows = true;
    bool occlusion = true;
};

/// In the order of viewer::SliceColor and of viewer::VoxelColor.
[[nodiscard]] const std::vector<std::string>& slice_color_names();
[[nodiscard]] const std::vector<std::string>& voxel_color_names();

/// What does not go together, before anything is read.
/// @param scene  a scene file will be wanted, which shows voxels
/// @throws OptionError
void check_view(const ViewInput& input, const ViewOptions& options, bool scene);

/// What a view begins with; its orbit is about the unit ball (Settings::framed).
/// @throws OptionError  a color that there is not
[[nodiscard]] viewer::Settings view_settings(const ViewOptions& options,
                                             const viewer::ViewedObject& subject);

} // namespace heddle::job
