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

/// A slice that is placed on its yarn's centreline, as the driver stores it (slice_glsl.h).
struct PlacedSlice {
    Vec3f center;              ///< units, relative to the origin
    float scale = 0.0f;        ///< units per model unit
    Vec3f tangent;             ///< unit
    float turn = 0.0f;         ///< twist to the next slice about the tangent, radians
    Vec3f normal;              ///< unit: the x axis of the section
    std::uint32_t layer = 0;   ///< index into SectionLayers
    std::uint32_t color = 0;   ///< multiplies the colour of the section: linear RGB, 8 bits each
    float extent = 0.0f;       ///< model units
    float fiber_radius = 0.0f; ///< model units
    std::uint32_t flags = 0;   ///< 1: last slice of its yarn
};
static_assert(sizeof(PlacedSlice) == 64, "as in slice_glsl.h");

/// The slices in one buffer: those of whole curves of one material.
struct SliceChunk {
    opengl::Buffer slices;
    std::uint32_t count = 0;
    std::uint32_t segments = 0; ///< segments between two slices of a yarn
    std::uint32_t first = 0;    ///< index of its first slice among all chunks
    std::uint32_t material = 0;
};

/// The programs that place slices: compiled once if slices are placed repeatedly.
struct PlacePrograms {
    opengl::Program measure, place;
    PlacePrograms();
};

/// Options for placing slices.
struct PlaceOptions {
    Vec3i origin{};           ///< voxel whose corner is the origin of all positions
    double spacing = 0.0;     ///< largest distance, units; 0: half of the yarn's radius, at
                              ///< least 1, on a lattice at most 16
    double most_slices = 0.0; ///< limit of their number; 0: 2^32 - 1
    /// largest chunk; 0, or more than a buffer of the driver can hold: the size of that buffer
    std::int64_t chunk_bytes = 0;
    bool lattice = true; ///< for voxels: a twist that a lattice of these units cannot resolve is
                         ///< refused
    const PlacePrograms* programs = nullptr; ///< null: compiled in this call
};

/// The approximate number of slices that place_slices would place, from the chords between points,
/// without those that bends add.
[[nodiscard]] std::int64_t
estimate_slices(const Geometry& geometry, const LatticeUnits& units, const PlaceOptions& options);

/// Resamples all curves on the driver. Neighbouring slices are at most `spacing` apart, with at
/// most 0.2 radians of bend and 0.4 of twist. Their frames are carried along without rotation and
/// then twisted; a closed yarn is twisted by whole turns. There is one more slice than intervals.
/// @throws Error  InvalidArgument: more slices than `most_slices`; OutOfMemory
[[nodiscard]] std::vector<SliceChunk> place_slices(const opengl::Context& context,
                                                   const Geometry& geometry,
                                                   const SectionLayers& sections,
                                                   const LatticeUnits& units,
                                                   const PlaceOptions& options);

/// Reads back the slices of a chunk, for tests.
[[nodiscard]] std::vector<PlacedSlice> read_slices(const SliceChunk& chunk);

} // namespace heddle::slice
