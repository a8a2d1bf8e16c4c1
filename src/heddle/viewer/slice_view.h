#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/raster/context.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace heddle::viewer {

/// How yarns are looked at.
struct ViewOptions {
    std::int32_t width = 960; ///< pixels, 1 to 8192
    std::int32_t height = 960;
    bool sorted = true;     ///< slabs from the farthest to the nearest; else as they were placed
    bool shadows = true;    ///< a shadow map
    bool occlusion = true;  ///< of fibers within their section
    double opacity = 1.0;   ///< multiplies what a texel of a slice hides, > 0
    std::uint64_t seed = 0; ///< of the fibers' places
};

/// From where; parallel rays.
struct ViewPose {
    Vec3d from{0.3, -0.6, 1.0};  ///< from the object to the eye, any length but 0
    Vec3d up{0.0, 1.0, 0.0};     ///< not along `from`
    Vec3d light{-0.5, 0.6, 1.0}; ///< from the object to the light
    double zoom = 1.0;           ///< 1: all of the object is in the picture from any side
};

/// 8 bits a channel, sRGB, over white, rows from the top.
struct ViewImage {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Seconds of a picture's stages, each waited for.
struct ViewTimes {
    double sort = 0.0;   ///< places in the view and their order
    double shadow = 0.0; ///< the shadow map
    double draw = 0.0;
};

/// Yarns as alpha-blended slices, shaded by Kajiya and Kay's model.     [LopezMoreno17, 4; docs/raster.md]
class SliceView {
public:
    /// Places the slices, once.
    /// @param geometry  of yarns of the models slice and solid, or hair
    /// @throws Error  InvalidArgument: sizes; Unsupported: nothing to draw, meshes, more slices than one
    ///                buffer of the driver holds; as raster::place_slices
    SliceView(const raster::Context& context, Geometry geometry, const ViewOptions& options);
    ~SliceView();

    /// @throws Error  InvalidArgument: a pose without direction; Device, OutOfMemory
    [[nodiscard]] ViewImage draw(const ViewPose& pose, ViewTimes* times = nullptr) const;
    [[nodiscard]] std::int64_t slice_count() const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace heddle::viewer
