#pragma once

#include <heddle/base/random.h>
#include <heddle/flake/flake_field.h>
#include <heddle/geom/affine.h>
#include <heddle/geom/bounds.h>
#include <heddle/leaf_table/leaf_table.h>
#include <heddle/render/volume/ray.h>
#include <heddle/render/volume/walk.h>
#include <heddle/scatter/scatterer.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace heddle {

/// A FlakeField in the layout that rays traverse: leaves of 8^3 cells between voxel centres, each
/// with the 9^3 flakes that trilinear interpolation needs, and a majorant. Leaves without
/// extinction are left out.
///
/// sigma_t is stored in 1 / 65535 of the leaf's largest, S in units of kFlakeUnit. Memory: 10.2 KB
/// per leaf, and 2.2 KB more if albedo varies. Immutable, so any number of threads may use it.
class FlakeGrid {
public:
    explicit FlakeGrid(const FlakeField& field);

    static constexpr std::int32_t kSide = 9; ///< flakes along a leaf's edge
    static constexpr std::size_t kFlakes = std::size_t{kSide} * kSide * kSide;
    static constexpr std::uint32_t kNone = LeafTable<3>::kNone;

    /// Finds the leaf of a cell (cell i spans voxel centres i and i + 1), or the size of the empty
    /// cube around it.
    [[nodiscard]] LeafTable<3>::LeafLookup find_leaf(Vec3i cell) const { return table_.find(cell); }
    /// Returns the largest sigma_t in a leaf, per unit of the object.
    [[nodiscard]] float majorant(std::uint32_t leaf) const { return majorant_[leaf]; }

    /// A point in a leaf: the first flake of its cell, and the weights of the cell's corners.
    struct TrilinearLookup {
        std::size_t first;
        std::array<float, 8> weight;
    };
    /// Finds the flakes around a point.
    /// @param at  relative to the leaf's corner, in cells, in [0, 8]
    [[nodiscard]] static TrilinearLookup look_up(std::uint32_t leaf, const Vec3f& at);
    [[nodiscard]] float sigma_t(std::uint32_t leaf, const TrilinearLookup& at) const;
    [[nodiscard]] SggxMatrix S(const TrilinearLookup& at) const;
    [[nodiscard]] Vec3f albedo(const TrilinearLookup& at) const;

    /// Bounds of the cells with extinction: [lo, hi).
    [[nodiscard]] Vec3i lo() const { return lo_; }
    [[nodiscard]] Vec3i hi() const { return hi_; }
    [[nodiscard]] Vec3d voxel_size() const { return voxel_size_; }
    [[nodiscard]] std::int64_t byte_count() const;

private:
    void add_leaves(const FlakeField& field, const std::vector<Vec3i>& corners);
    void store(std::size_t leaf, const FlakeBlock& block);

    Vec3d voxel_size_{};
    Vec3i lo_{}, hi_{};
    Vec3f one_albedo_{};
    LeafTable<3> table_;
    std::vector<float> majorant_;
    std::vector<std::uint16_t> sigma_t_;
    std::vector<PackedFlake> S_;
    std::vector<std::array<std::uint8_t, 3>> albedo_;
};

/// Where a free flight ended.
struct FlakeHit {
    float t = 0.0f;
    SggxMatrix S; ///< in the object's axes
    Vec3f albedo{};
};

/// A FlakeGrid placed in the world: a medium of microflakes whose extinction at p along w is
/// sigma_t(p) sqrt(w^T S(p) w). As in Mitsuba 3, sigma_t and S are interpolated separately.
class FlakeMedium {
public:
    /// @param to_world  its determinant is not 0
    /// @param material  index among the scene's materials, for the pictures' channel
    FlakeMedium(std::shared_ptr<const FlakeGrid> grid,
                const Affine& to_world,
                std::uint32_t material);

    /// Draws a free flight by delta tracking with one majorant per leaf.     [Woodcock 1965]
    /// @return  false: the ray passes until ray.t_max
    [[nodiscard]] bool sample_flight(const Ray& ray, StreamRandom& random, FlakeHit& hit) const;
    /// Returns an unbiased estimate of the transmittance until ray.t_max, by ratio tracking
    /// [Novak 2014] and Russian roulette at low values.
    [[nodiscard]] float transmittance(const Ray& ray, StreamRandom& random) const;
    /// Returns the scatterer at a hit, in world space.
    /// @param wi  unit, towards the origin of the ray
    [[nodiscard]] Scatterer scatterer(const FlakeHit& hit, Vec3f wi) const;

    [[nodiscard]] std::uint32_t material() const { return material_; }
    [[nodiscard]] Bounds bounds() const { return bounds_; } ///< in the world
    [[nodiscard]] const FlakeGrid& grid() const { return *grid_; }

private:
    struct GridRay;
    [[nodiscard]] GridRay enter(const Ray& ray) const;
    template <typename Visit>
    void walk(const GridRay& ray, const Visit& visit) const;
    template <typename Collide>
    void track(const GridRay& ray, StreamRandom& random, const Collide& collide) const;

    std::shared_ptr<const FlakeGrid> grid_;
    Affine to_object_;
    bool moved_ = false; ///< the object's axes are not the world's
    std::uint32_t material_;
    Bounds bounds_;
    Vec3d per_voxel_{};
};

} // namespace heddle
