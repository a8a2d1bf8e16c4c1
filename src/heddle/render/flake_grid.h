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

/// A FlakeField as rays cross it: leaves of 8^3 cells between voxel centres, each with the 9^3
/// flakes that a trilinear lookup in it needs, and one majorant. Leaves without extinction are left
/// out.
///
/// sigma_t in 1 / 65535 of its leaf's largest, S in kFlakeUnit. Memory: 10.2 KB a leaf, 2.2 more
/// where albedo varies. Never changes: any number of threads.
class FlakeGrid {
public:
    explicit FlakeGrid(const FlakeField& field);

    static constexpr std::int32_t kSide = 9; ///< flakes along a leaf's edge
    static constexpr std::size_t kFlakes = std::size_t{kSide} * kSide * kSide;
    static constexpr std::uint32_t kNone = LeafTable<3>::kNone;

    /// What is in a cell (i spans voxel centres i and i + 1): a leaf, or how much around it is
    /// empty.
    [[nodiscard]] LeafTable<3>::LeafLookup find_leaf(Vec3i cell) const { return table_.find(cell); }
    /// Largest sigma_t in a leaf: per scene unit of the object.
    [[nodiscard]] float majorant(std::uint32_t leaf) const { return majorant_[leaf]; }

    /// A place in a leaf: the cell's first flake, and how far into the cell.
    struct TrilinearLookup {
        std::size_t first;
        std::array<float, 8> weight;
    };
    /// @param at  from the leaf's corner, cells; in [0, 8]
    [[nodiscard]] static TrilinearLookup look_up(std::uint32_t leaf, Vec3f at);
    [[nodiscard]] float sigma_t(std::uint32_t leaf, const TrilinearLookup& at) const;
    [[nodiscard]] SggxMatrix S(const TrilinearLookup& at) const;
    [[nodiscard]] Vec3f albedo(const TrilinearLookup& at) const;

    /// Cells that hold all extinction: [lo, hi).
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

/// Where a flight ended.
struct FlakeHit {
    float t = 0.0f;
    SggxMatrix S; ///< of the object's axes
    Vec3f albedo{};
};

/// A FlakeGrid placed in the world: a medium of mirror flakes whose extinction at p along w is
/// sigma_t(p) sqrt(w^T S(p) w), sigma_t and S interpolated each for itself, as in Mitsuba 3.
class FlakeMedium {
public:
    /// @param to_world  its determinant is not 0
    /// @param material  of the scene's: named in pictures
    FlakeMedium(std::shared_ptr<const FlakeGrid> grid,
                const Affine& to_world,
                std::uint32_t material);

    /// Draws where a ray is stopped next: delta tracking, one majorant a leaf.     [Woodcock 1965]
    /// @return  false: it passes until ray.t_max
    [[nodiscard]] bool sample_flight(const Ray& ray, StreamRandom& random, FlakeHit& hit) const;
    /// An estimate of the share of light that passes until ray.t_max, of exact mean: ratio tracking
    /// [Novak 2014], and Russian roulette where little is left.
    [[nodiscard]] float transmittance(const Ray& ray, StreamRandom& random) const;
    /// What a flight hit, in the world.
    /// @param wi  unit, towards where the ray came from
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
    bool moved_ = false; ///< its axes are not the world's
    std::uint32_t material_;
    Bounds bounds_;
    Vec3d per_voxel_{};
};

} // namespace heddle
