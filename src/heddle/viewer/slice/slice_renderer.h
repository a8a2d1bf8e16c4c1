#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/opengl/context.h>
#include <heddle/render/camera.h>
#include <heddle/viewer/orbit.h>
#include <heddle/viewer/render_target.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace heddle::viewer {

/// Options for turning yarns into slices.
struct SliceRendererOptions {
    double pixel = 0.0; ///< scene units: least distance of slices; 0: 1/1000 of the object
    std::int64_t memory_bytes = 0; ///< limit of slices in view and their order; 0: one buffer
    std::uint64_t seed = 0;        ///< seed of the fibers' positions
};

enum class SliceColor : std::uint8_t {
    Shaded,    ///< Kajiya and Kay's model
    Direction, ///< x^2, y^2, z^2 of the fiber's direction as red, green, blue
    Grid       ///< the same for the direction that voxels store; grey without a voxel
};

/// The appearance of slices.
struct SliceLook {
    Vec3d light{-0.5, 0.6, 1.0}; ///< from the object to the light, nonzero length
    bool sorted = true;    ///< segments from the farthest to the nearest; else as they were placed
    bool weighted = false; ///< order-independent blending instead; always if slices fill
                           ///< more than one chunk
    bool shadows = true;   ///< with a shadow map
    bool occlusion = true; ///< ambient occlusion of fibers within their section
    double opacity = 1.0;  ///< multiplies the opacity of a slice's texels, > 0
    std::int32_t map_size = 1024; ///< size of the shadow map, pixels, 16 to 8192
    SliceColor color = SliceColor::Shaded;
    std::optional<Vec3i> white_block{}; ///< with Grid: voxels in this block are white
    bool operator==(const SliceLook&) const = default;
};

class VoxelRenderer;
struct SliceResources;

/// Seconds of the phases of a picture, each waited for.
struct SliceTimes {
    double sort = 0.0;   ///< moving slices into the view and sorting them
    double shadow = 0.0; ///< the shadow map; 0 if the last one is reused
    double draw = 0.0;
};

/// Draws yarns as alpha-blended slices, shaded with the model of Kajiya and Kay.
///   [LopezMoreno17, 4; docs/raster.md]
class SliceRenderer {
public:
    /// Makes the sections and places the slices.
    /// @param geometry  yarns of the models slice and solid, or hair
    /// @throws Error  Unsupported: nothing to draw, meshes; as slice::build_sections and place
    SliceRenderer(const opengl::Context& context,
                  Geometry geometry,
                  const SliceRendererOptions& options);
    ~SliceRenderer();
    SliceRenderer(const SliceRenderer&) = delete;
    SliceRenderer& operator=(const SliceRenderer&) = delete;

    /// Places the slices again, with other radii, twists, colours or centrelines of the same yarn
    /// types.
    /// @throws Error  OutOfMemory, InvalidArgument: as slice::place_slices; old slices then stay
    void place(Geometry geometry);
    /// Places them again, closer or farther apart, if pixels have become four times as small or
    /// large.
    /// @param pixel   scene units, at the objects
    /// @throws Error  as place
    void fit(double pixel);
    /// Draws over the contents of the target, within its limit. Shadow maps, one of each size, and
    /// the draw order are reused until their input changes.
    /// @param grid   voxels for SliceColor::Grid; null: none
    /// @param times  filled in, after waiting, if not null
    /// @throws Error  InvalidArgument: a direction of length 0, Grid without voxels; Device,
    ///                OutOfMemory
    void draw(const RenderTarget& target,
              const CameraParameters& camera,
              const SliceLook& look,
              const VoxelRenderer* grid = nullptr,
              SliceTimes* times = nullptr);

    [[nodiscard]] std::int64_t slice_count() const;
    [[nodiscard]] Ball ball() const; ///< around all yarns
    /// True if slices fill more than one chunk: they are then blended by weights, not sorted.
    [[nodiscard]] bool is_split() const;

private:
    std::unique_ptr<SliceResources> scene_;
};

} // namespace heddle::viewer
