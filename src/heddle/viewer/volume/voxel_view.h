#pragma once

#include <heddle/base/progress.h>
#include <heddle/opengl/context.h>
#include <heddle/render/camera.h>
#include <heddle/viewer/orbit.h>
#include <heddle/viewer/view_target.h>
#include <heddle/voxel/voxel_grid.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace heddle::viewer {

class VoxelTables;

enum class VoxelColor : std::uint8_t {
    Shaded,  ///< fibers by Kajiya and Kay's model, surfaces by the cosine to their normal, unsigned
    Density, ///< the mean of a voxel's coverage over the three axes, 0 blue to 1 red
    Tangent, ///< x^2, y^2, z^2 of the heaviest lobe's direction as red, green, blue
    Width,   ///< of the heaviest lobe: needles blue, round ones red
    Material, ///< one colour a material id
    Block,    ///< one colour a cell of 32^3 of the finest voxels
    Level     ///< one colour a level of detail
};

/// How voxels look.
struct VoxelLook {
    VoxelColor color = VoxelColor::Shaded;
    /// From the object to the light, any length but 0. None: at the eye, shaded as render_preview
    /// does, without shadows.
    std::optional<Vec3d> light = Vec3d{-0.5, 0.6, 1.0};
    bool shadows = true; ///< a cone towards the light for each clump of voxels that a ray meets
    int level = -1;      ///< everywhere; -1: the one whose edges are next above a pixel's width
    double level_offset = 0.0;  ///< added to the level that a pixel asks for
    double density_scale = 1.0; ///< multiplies what voxels hide, > 0
    bool blocks = false; ///< edges of occupied blocks, 32^3 of the finest voxels; dim where hidden
    std::optional<Vec3i> white_block{}; ///< this one is drawn in solid white cells
    bool operator==(const VoxelLook&) const = default;
};

struct VoxelViewOptions {
    std::int64_t storage_bytes = 0; ///< largest storage block that is planned for; 0: the driver's
};

/// Voxels by ray casting: one ray a pixel, front to back through occupied leaves.
///                                                            [LopezMoreno17, 3.6; docs/raster.md]
class VoxelView {
public:
    /// Takes the levels into the driver's memory.
    /// @param levels  finest first, as sources_of gives them; not kept
    /// @throws Error  as VoxelTables
    VoxelView(const opengl::Context& context,
              std::span<const VoxelSource* const> levels,
              const VoxelViewOptions& options,
              Progress& progress);
    ~VoxelView();
    VoxelView(const VoxelView&) = delete;
    VoxelView& operator=(const VoxelView&) = delete;

    /// Draws over what the target holds, within its limit. Parallel rays have no beginning: voxels
    /// behind the eye are seen as slices are. The lens is not used.
    /// @throws Error  InvalidArgument: a direction without length, a look out of range; Device
    void draw(const ViewTarget& target, const CameraView& camera, const VoxelLook& look) const;

    /// The edges of occupied blocks alone, over what the target holds; dim where voxels hide them.
    /// @throws Error  as draw
    void
    draw_blocks(const ViewTarget& target, const CameraView& camera, const VoxelLook& look) const;

    /// The first occupied block under a pixel, counted in blocks of 32^3 of the finest voxels; none
    /// where there is none. A block may be met where the ray passes its voxels by.
    /// @param width, height  of the picture, pixels
    /// @param x, y           pixels from its upper left corner; a pixel's middle is at .5
    /// @throws Error  InvalidArgument: an eye at its target
    [[nodiscard]] std::optional<Vec3i> block_at(const CameraView& camera,
                                                std::int32_t width,
                                                std::int32_t height,
                                                double x,
                                                double y) const;

    /// For other shaders, with kVoxelTableGlsl: storage blocks 8 to 13, uniform block 8.
    void bind_tables() const;

    [[nodiscard]] const VoxelTables& tables() const;
    [[nodiscard]] Ball ball() const; ///< around the voxels of the finest level that fits

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace heddle::viewer
