#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/opengl/context.h>
#include <heddle/render/camera.h>
#include <heddle/viewer/orbit.h>
#include <heddle/viewer/view_target.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace heddle::viewer {

/// How yarns are made slices.
struct SliceViewOptions {
    double pixel = 0.0; ///< scene units: slices are no closer; 0: 1/1000 of all that is there
    std::int64_t memory_bytes = 0; ///< of slices in view and their order, at most; 0: one buffer's
    std::uint64_t seed = 0;        ///< of the fibers' places
};

enum class SliceColor : std::uint8_t {
    Shaded,    ///< Kajiya and Kay's model
    Direction, ///< x^2, y^2, z^2 of the fiber's direction as red, green, blue
    Grid       ///< the same of the direction that voxels store there; grey where there is no voxel
};

/// How slices look.
struct SliceLook {
    Vec3d light{-0.5, 0.6, 1.0}; ///< from the object to the light, any length but 0
    bool sorted = true;    ///< slabs from the farthest to the nearest; else as they were placed
    bool weighted = false; ///< blends so that no order shows, instead; always where slices fill
                           ///< more than one chunk
    bool shadows = true;   ///< a shadow map
    bool occlusion = true; ///< of fibers within their section
    double opacity = 1.0;  ///< multiplies what a texel of a slice hides, > 0
    std::int32_t map_size = 1024; ///< of the shadow map, pixels, 16 to 8192
    SliceColor color = SliceColor::Shaded;
    std::optional<Vec3i> white_block{}; ///< with Grid: what lies in this block is white
    bool operator==(const SliceLook&) const = default;
};

class VoxelView;
struct SliceScene;

/// Seconds of a picture's stages, each waited for.
struct SliceTimes {
    double sort = 0.0;   ///< places in the view and their order
    double shadow = 0.0; ///< the shadow map; 0 where the last one serves
    double draw = 0.0;
};

/// Yarns as alpha-blended slices, shaded by Kajiya and Kay's model.
///   [LopezMoreno17, 4; docs/raster.md]
class SliceView {
public:
    /// Makes the sections and places the slices.
    /// @param geometry  of yarns of the models slice and solid, or hair
    /// @throws Error  Unsupported: nothing to draw, meshes; as slice::build_sections and place
    SliceView(const opengl::Context& context, Geometry geometry, const SliceViewOptions& options);
    ~SliceView();
    SliceView(const SliceView&) = delete;
    SliceView& operator=(const SliceView&) = delete;

    /// Places the slices again: other radii, twists, colours or centrelines of the same kinds of
    /// yarn.
    /// @throws Error  OutOfMemory, InvalidArgument: see slice::place_slices; what was there stays
    void place(Geometry geometry);
    /// Places them again, closer or farther apart, where pixels have become four times as small or
    /// large.
    /// @param pixel   scene units, at what is looked at
    /// @throws Error  as place
    void fit(double pixel);
    /// Draws over what the target holds, within its limit. Shadow maps are kept, one of each size,
    /// and so is the order, until what they are made of changes.
    /// @param grid   voxels for SliceColor::Grid; null: none
    /// @param times  waited for and filled in where it is there
    /// @throws Error  InvalidArgument: a direction without length, Grid without voxels; Device,
    ///                OutOfMemory
    void draw(const ViewTarget& target,
              const CameraView& camera,
              const SliceLook& look,
              const VoxelView* grid = nullptr,
              SliceTimes* times = nullptr);

    [[nodiscard]] std::int64_t slice_count() const;
    [[nodiscard]] Ball ball() const; ///< around all yarns
    /// Slices fill more than one chunk: they are not sorted but blended by weights.
    [[nodiscard]] bool is_split() const;

private:
    std::unique_ptr<SliceScene> scene_;
};

} // namespace heddle::viewer
