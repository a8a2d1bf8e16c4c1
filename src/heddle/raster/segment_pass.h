#pragma once

#include <heddle/opengl/empty_framebuffer.h>
#include <heddle/raster/brick_grid.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/slice/section_textures.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace heddle::raster {

/// A part of the grid, in subvoxels relative to the origin.
struct RasterWindow {
    Vec3i lo, size;
};

/// Draws listed segments along three axes into the sums of bricks, by fragments of quads or by
/// compute invocations that loop over the same pixels. Both run the same code for a pixel. Needs a
/// current Context.
class SegmentPass {
public:
    /// @param path  Fragment or Compute
    /// @throws Error  Internal: as Program
    SegmentPass(RasterPath path, Composition composition);

    /// Returns the program, to set the uniforms that all draws share.
    [[nodiscard]] const opengl::Program& program() const { return program_; }
    /// Draws the listed segments without waiting. Storage buffers 0 to 3 must be bound to the
    /// slices, the slots, the list and the pool.
    /// @param command  written by kListGlsl
    void draw(const opengl::Buffer& command, const RasterWindow& window) const;

private:
    void walk(const opengl::Buffer& command) const;

    RasterPath path_;
    opengl::Program program_;
    opengl::EmptyFramebuffer frame_;
};

/// The resources for drawing segments, reused from one geometry to the next: programs, each created
/// when it is first used, and the memory of the sums.
class SegmentResources {
public:
    /// @param path  Auto: the faster path on a software driver; undecided on other drivers
    SegmentResources(const opengl::Context& context, RasterPath path, Composition composition);

    [[nodiscard]] Composition composition() const { return composition_; }
    [[nodiscard]] const opengl::Program& list() const { return list_; }
    [[nodiscard]] const SegmentPass& pass(RasterPath path);
    /// Returns Fragment or Compute; Auto until one is chosen.
    [[nodiscard]] RasterPath path() const { return path_; }
    void choose(RasterPath path) { path_ = path; }
    /// Returns memory for sums, of `bytes` to twice as many. References from earlier calls become
    /// invalid.
    /// @throws Error  OutOfMemory
    [[nodiscard]] const opengl::Buffer& pool(std::size_t bytes);

private:
    Composition composition_;
    RasterPath path_;
    opengl::Program list_;
    std::optional<SegmentPass> fragment_, compute_;
    std::optional<opengl::Buffer> pool_;
};

} // namespace heddle::raster
