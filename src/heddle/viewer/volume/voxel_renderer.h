#pragma once

#include <heddle/base/progress.h>
#include <heddle/opengl/context.h>
#include <heddle/render/camera.h>
#include <heddle/viewer/orbit.h>
#include <heddle/viewer/render_target.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace heddle::viewer {

class VoxelTables;

enum class VoxelColor : std::uint8_t {
    Shaded,   ///< fibers by Kajiya and Kay's model, surfaces by |cosine| to the normal
    Density,  ///< the mean of a voxel's coverage over the three axes, 0 blue to 1 red
    Tangent,  ///< x^2, y^2, z^2 of the heaviest lobe's direction as red, green, blue
    Width,    ///< of the heaviest lobe: needles blue, isotropic ones red
    Material, ///< one colour per material id
    Block,    ///< one colour per block of 32^3 of the finest voxels
    Level     ///< one colour per level of detail
};

/// The appearance of voxels.
struct VoxelLook {
    VoxelColor color = VoxelColor::Shaded;
    /// From the object to the light, nonzero length. None: the light is at the eye, with the
    /// shading of render_preview, without shadows.
    std::optional<Vec3d> light = Vec3d{-0.5, 0.6, 1.0};
    bool shadows = true; ///< by a cone towards the light for each clump of voxels that a ray hits
    int level = -1;      ///< for all pixels; -1: the finest whose edges are wider than a pixel
    double level_offset = 0.0;  ///< added to the level of each pixel
    double density_scale = 1.0; ///< multiplies the optical depth of voxels, > 0
    bool blocks = false; ///< edges of occupied blocks (32^3 of the finest voxels); dim if hidden
    std::optional<Vec3i> white_block{}; ///< this block is drawn in solid white cells
    bool operator==(const VoxelLook&) const = default;
};

struct VoxelRendererOptions {
    std::int64_t storage_bytes = 0; ///< largest storage block to plan for; 0: the driver's
};

/// Draws voxels by ray casting: one ray per pixel, front to back through occupied leaves.
///                                                            [LopezMoreno17, 3.6; docs/raster.md]
class VoxelRenderer {
public:
    /// Uploads the levels into the driver's memory.
    /// @param levels  finest first, as returned by sources_of; not stored
    /// @throws Error  as VoxelTables
    VoxelRenderer(const opengl::Context& context,
                  std::span<const VoxelLevel* const> levels,
                  const VoxelRendererOptions& options,
                  Progress& progress);
    ~VoxelRenderer();
    VoxelRenderer(const VoxelRenderer&) = delete;
    VoxelRenderer& operator=(const VoxelRenderer&) = delete;

    /// Draws over the contents of the target, within its limit. Parallel rays have no start: voxels
    /// behind the eye are visible, as with slices. The lens is ignored.
    /// @throws Error  InvalidArgument: a direction of length 0, a look out of range; Device
    void
    draw(const RenderTarget& target, const CameraParameters& camera, const VoxelLook& look) const;

    /// Draws only the edges of occupied blocks over the target; dim where voxels hide them.
    /// @throws Error  as draw
    void draw_blocks(const RenderTarget& target,
                     const CameraParameters& camera,
                     const VoxelLook& look) const;

    /// The first occupied block under a pixel, in blocks of 32^3 of the finest voxels; none if
    /// there is none. The ray may miss the voxels of the block that it hits.
    /// @param width, height  of the picture, pixels
    /// @param x, y           pixels from its upper left corner; the middle of a pixel is at 0.5
    /// @throws Error  InvalidArgument: the eye is at its target
    [[nodiscard]] std::optional<Vec3i> block_at(const CameraParameters& camera,
                                                std::int32_t width,
                                                std::int32_t height,
                                                double x,
                                                double y) const;

    /// Binds the tables for shaders with kVoxelTableGlsl: storage blocks 8 to 13, uniform block 8.
    void bind_tables() const;

    [[nodiscard]] const VoxelTables& tables() const;
    [[nodiscard]] Ball ball() const; ///< around the voxels of the finest level that fits

private:
    struct Impl;
    std::unique_ptr<Impl> scene_;
};

} // namespace heddle::viewer
