#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/opengl/buffer.h>
#include <heddle/opengl/context.h>
#include <heddle/opengl/shader.h>
#include <heddle/slice/section_layers.h>
#include <heddle/voxel/lattice_units.h>

#include <cstdint>
#include <vector>

namespace heddle::slice {

/// A slice on its yarn's centreline, as the driver holds it (slice_glsl.h).
struct PlacedSlice {
    Vec3f center;              ///< units, from the origin
    float scale = 0.0f;        ///< units per model unit
    Vec3f tangent;             ///< unit
    float turn = 0.0f;         ///< radians to the next slice, about the tangent
    Vec3f normal;              ///< unit: the section's x
    std::uint32_t layer = 0;   ///< of SectionLayers
    std::uint32_t color = 0;   ///< multiplies the section's: linear RGB, 8 bits each
    float extent = 0.0f;       ///< model units
    float fiber_radius = 0.0f; ///< model units
    std::uint32_t flags = 0;   ///< 1: the last of its yarn
};
static_assert(sizeof(PlacedSlice) == 64, "as slice_glsl.h has it");

/// Slices that one buffer holds: those of whole curves of one material.
struct SliceChunk {
    opengl::Buffer slices;
    std::uint32_t count = 0;
    std::uint32_t slabs = 0; ///< stretches between two slices of a yarn
    std::uint32_t first = 0; ///< number of its first slice over all chunks
    std::uint32_t material = 0;
};

/// The programs that place slices: compiled once where slices are placed again and again.
struct PlacePrograms {
    opengl::Program measure, place;
    PlacePrograms();
};

/// How slices are placed.
struct PlaceOptions {
    Vec3i origin{};           ///< voxel whose corner all places are relative to
    double spacing = 0.0;     ///< units, at most; 0: half of the yarn's radius, 1 at
                              ///< least, on a lattice at most 16
    double most_slices = 0.0; ///< over all; 0: 2^32 - 1
    /// of a chunk; 0, or more than that: what one buffer of the driver holds
    std::int64_t chunk_bytes = 0;
    bool lattice = true; ///< they are to be voxels: a twist that no lattice of these units shows is
                         ///< refused
    const PlacePrograms* programs = nullptr; ///< null: they are compiled for this call
};

/// About how many slices place_slices would place: by chords between points, without what bends
/// add.
[[nodiscard]] std::int64_t
estimate_slices(const Geometry& geometry, const LatticeUnits& units, const PlaceOptions& options);

/// Resamples all curves on the driver: slices at most `spacing` apart, at most .2 radians of bend
/// and .4 of twist between neighbours, frames carried along without turn and then twisted; over a
/// closed yarn the twist is whole turns. One slice more than the spaces between them.
/// @throws Error  InvalidArgument: more slices than `most_slices`; OutOfMemory
[[nodiscard]] std::vector<SliceChunk> place_slices(const opengl::Context& context,
                                                   const Geometry& geometry,
                                                   const SectionLayers& sections,
                                                   const LatticeUnits& units,
                                                   const PlaceOptions& options);

/// The slices of a chunk, for tests.
[[nodiscard]] std::vector<PlacedSlice> read_slices(const SliceChunk& chunk);

} // namespace heddle::slice
