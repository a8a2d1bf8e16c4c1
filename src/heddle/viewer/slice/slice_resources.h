#pragma once

#include <heddle/opengl/buffer.h>
#include <heddle/opengl/empty_framebuffer.h>
#include <heddle/opengl/shader.h>
#include <heddle/slice/section_layers.h>
#include <heddle/viewer/shader_camera.h>
#include <heddle/viewer/slice/section_mipmaps.h>
#include <heddle/viewer/slice/slice_renderer.h>
#include <heddle/viewer/slice/sorted_slices.h>
#include <heddle/viewer/slice/weighted_blend.h>
#include <heddle/voxel/lattice_units.h>

#include <cstdint>
#include <map>
#include <optional>

namespace heddle::viewer {

/// The programs that draw segments as quads facing the eye.
struct SegmentPrograms {
    SegmentPrograms();
    opengl::Program nearest; ///< the depth at which half of the light is blocked
    opengl::Program over;    ///< each segment over those behind it
    opengl::Program weigh;   ///< for WeightedBlend
};

/// The same programs with colours of voxels.
struct GridPrograms {
    GridPrograms();
    opengl::Program over;
    opengl::Program weigh;
};

/// The data of a SliceRenderer on the driver, and its drawing.
struct SliceResources {
    const opengl::Context& context;
    SliceRendererOptions options;
    Geometry geometry;
    Ball ball;
    double pixel = 0.0; ///< for which slices were placed, scene units
    LatticeUnits units;
    slice::SectionLayers layers;
    SectionMipmaps sections;
    opengl::EmptyFramebuffer frame;
    std::optional<SortedSlices> slices;
    SegmentPrograms programs;
    std::optional<GridPrograms> grid_programs; ///< compiled when they are needed

    struct ShadowMap {
        Vec3d light; ///< of which the map was drawn
        double opacity;
        Ball over; ///< the part that it covers
        opengl::Buffer depths;
    };
    std::map<std::int32_t, ShadowMap> shadows; ///< by size
    std::optional<opengl::Buffer> front;       ///< nearest depths seen from the eye
    std::optional<WeightedBlend> blend;
    std::int32_t blend_width = 0, blend_height = 0;

    SliceResources(const opengl::Context& on, Geometry what, const SliceRendererOptions& asked)
        : context(on),
          options(asked),
          geometry(std::move(what)),
          layers(slice::build_sections(geometry, asked.seed)),
          sections(layers, bake_light(geometry, layers)) {}

    [[nodiscard]] Vec3d middle() const { return ball.middle * (1.0 / units.unit); }
    void place(double asked_pixel);
    void set_common(const opengl::Program& program,
                    const ShaderCamera& eye,
                    const SliceLook& look) const;
    void
    set_light(const opengl::Program& program, const ShaderCamera& eye, const SliceLook& look) const;
    /// The smallest depth of anything in a map of `part`, units.
    [[nodiscard]] double shadow_depth(const Ball& part) const {
        return -(ball.radius + length(part.middle - ball.middle)) / units.unit;
    }
    void set_depths(const opengl::Program& program, double shift) const;
    void draw_nearest(const ShaderCamera& eye,
                      const SliceLook& look,
                      double shift,
                      const opengl::Buffer& map);
    [[nodiscard]] Ball shadowed_part(const CameraParameters& camera, double aspect) const;
    void draw_shadows(const SliceLook& look, const Ball& part);
    void set_grid(const opengl::Program& program,
                  const ShaderCamera& eye,
                  const SliceLook& look,
                  const VoxelRenderer& voxels) const;
    void draw_sorted(const RenderTarget& target,
                     const opengl::Program& program,
                     const ShaderCamera& eye,
                     const SliceLook& look,
                     std::uint32_t segments);
    void draw_weighted(const RenderTarget& target,
                       const opengl::Program& program,
                       const ShaderCamera& eye,
                       const SliceLook& look);
    /// The program for a look, with all its uniforms of voxels set.
    /// @param grid  not null if the look's colour is Grid
    [[nodiscard]] const opengl::Program& program_for(const SliceLook& look,
                                                     bool weighted,
                                                     const ShaderCamera& eye,
                                                     const VoxelRenderer* grid);
};

} // namespace heddle::viewer
