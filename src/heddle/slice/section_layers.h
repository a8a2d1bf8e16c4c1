#pragma once

#include <heddle/geom/geometry.h>

#include <cstdint>
#include <vector>

namespace heddle::slice {

/// A yarn's section for shaders: two square images over [-extent, extent]^2, with rows from the
/// bottom.
struct SectionLayer {
    float extent = 0.0f;             ///< model units; contains all fibers
    float fiber_radius = 0.0f;       ///< model units
    std::vector<float> distance;     ///< to the nearest fiber's surface, across the fiber, which
                                     ///< the twist tilts; model units; < 0 inside
    std::vector<std::uint8_t> color; ///< RGB of the nearest fiber, linear; A: the volume fraction
};

/// The sections of all curves of a geometry: one for each yarn type and for plain fibers. The
/// fibers of a slice are placed at random, so slices have several sections, which the yarns share.
struct SectionLayers {
    std::int32_t size = 0; ///< texels along a side, the same for all sections
    std::vector<SectionLayer> layers;
    std::vector<std::uint32_t> first; ///< first layer by set of curves, and the end
    std::uint64_t key = 0;            ///< a hash of the input they are drawn from

    /// The layer of curve `curve` of set `set`.
    [[nodiscard]] std::uint32_t of(std::size_t set, std::size_t curve) const {
        const std::uint32_t count = first[set + 1] - first[set];
        return first[set] + static_cast<std::uint32_t>(curve % count);
    }
};

/// The number of different sections for the yarns of one set of curves.
constexpr std::uint32_t kMaxVariants = 8;

/// In the first kMaxVariants curves of a set, the fibers are where the sampling voxelizer places
/// them (place_fibers with the same seed and number).
/// @throws Error  Unsupported: a procedural yarn, which one section cannot represent
[[nodiscard]] SectionLayers build_sections(const Geometry& geometry, std::uint64_t seed);

/// Updates `layers` to this geometry; does nothing if they are up to date.
/// @return  true if they were drawn again
/// @throws Error  as build_sections; `layers` is then unchanged
bool update_sections(SectionLayers& layers, const Geometry& geometry, std::uint64_t seed);

} // namespace heddle::slice
