#pragma once

#include <heddle/geom/geometry.h>

#include <cstdint>
#include <vector>

namespace heddle::slice {

/// A yarn's section as shaders read it: two square images over [-extent, extent]^2, rows from
/// below.
struct SectionLayer {
    float extent = 0.0f;             ///< model units; no fiber reaches past it
    float fiber_radius = 0.0f;       ///< model units
    std::vector<float> distance;     ///< of the nearest fiber's surface, square to the fiber, which
                                     ///< the twist tilts; model units; < 0 inside
    std::vector<std::uint8_t> color; ///< RGB the nearest fiber's, linear; A the volume fraction
};

/// The sections of all curves of a geometry: one for each kind of yarn and of plain fiber, and of
/// slices that many yarns share a few, as the fibers that stand for a slice are drawn anew for
/// each.
struct SectionLayers {
    std::int32_t size = 0; ///< texels along a side, the same for all
    std::vector<SectionLayer> layers;
    std::vector<std::uint32_t> first; ///< by set of curves, and the end: its layers
    std::uint64_t key = 0;            ///< a hash of what they are drawn from

    /// Layer of curve `curve` of set `set`.
    [[nodiscard]] std::uint32_t of(std::size_t set, std::size_t curve) const {
        const std::uint32_t count = first[set + 1] - first[set];
        return first[set] + static_cast<std::uint32_t>(curve % count);
    }
};

/// Yarns that share no section, of one set of curves.
constexpr std::uint32_t kMostVariants = 8;

/// The fibers of the first kMostVariants curves of a set lie where the sampling voxelizer has them
/// (place_fibers of the same seed and number).
/// @throws Error  Unsupported: a procedural yarn, which no one section stands for
[[nodiscard]] SectionLayers build_sections(const Geometry& geometry, std::uint64_t seed);

/// Makes `layers` those of this geometry; draws nothing where they are that already.
/// @return  true where they were drawn anew
/// @throws Error  as build_sections; `layers` is then as it was
bool update_sections(SectionLayers& layers, const Geometry& geometry, std::uint64_t seed);

} // namespace heddle::slice
