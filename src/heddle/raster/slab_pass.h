#pragma once

#include <heddle/opengl/empty_framebuffer.h>
#include <heddle/raster/brick_grid.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/slice/section_textures.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace heddle::raster {

/// A part of the grid, in subvoxels from the origin.
struct RasterWindow {
    Vec3i lo, size;
};

/// Draws listed slabs along three axes into the sums of bricks: by fragments of quads, or by
/// compute invocations that walk over the same pixels. Both run one text for a pixel. Needs a
/// current Context.
class SlabPass {
public:
    /// @param path  Fragment or Compute
    /// @throws Error  Internal: as Program
    SlabPass(RasterPath path, Composition composition);

    /// To set what all draws have in common.
    [[nodiscard]] const opengl::Program& program() const { return program_; }
    /// Slices are bound as storage 0, slots 1, the list 2, the pool 3. Waits for nothing.
    /// @param command  as kListGlsl writes it
    void draw(const opengl::Buffer& command, const RasterWindow& view) const;

private:
    void walk(const opengl::Buffer& command) const;

    RasterPath path_;
    opengl::Program program_;
    opengl::EmptyFramebuffer frame_;
};

/// What slabs are drawn with, kept from one geometry to the next: programs, each made when it is
/// first asked for, and the memory of their sums.
class SlabResources {
public:
    /// @param path  Auto: what is faster on a software driver; on another it is left open
    SlabResources(const opengl::Context& context, RasterPath path, Composition composition);

    [[nodiscard]] Composition composition() const { return composition_; }
    [[nodiscard]] const opengl::Program& list() const { return list_; }
    [[nodiscard]] const SlabPass& pass(RasterPath path);
    /// Fragment or Compute; Auto until one is chosen.
    [[nodiscard]] RasterPath path() const { return path_; }
    void choose(RasterPath path) { path_ = path; }
    /// Memory for sums, `bytes` or up to twice as many. A reference from an earlier call is no
    /// longer good.
    /// @throws Error  OutOfMemory
    [[nodiscard]] const opengl::Buffer& pool(std::size_t bytes);

private:
    Composition composition_;
    RasterPath path_;
    opengl::Program list_;
    std::optional<SlabPass> fragment_, compute_;
    std::optional<opengl::Buffer> pool_;
};

} // namespace heddle::raster
