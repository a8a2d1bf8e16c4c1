#pragma once

#include <heddle/io/vdb/grid_name.h>
#include <heddle/io/vdb/grid_values.h>

#include <cstddef>

namespace heddle {

/// The properties of a level that decide which grids it has.
struct LevelGrids {
    int level = 0;
    VoxelFields fields;
    int lobes = 0;      ///< largest number of any voxel
    bool merge = false; ///< has merge orders
};

/// Whether a level has masks: only level 0 does, although all levels have the same fields.
[[nodiscard]] inline bool has_masks(const VoxelFields& fields, int level) {
    return fields.masks && level == 0;
}

/// Calls visit(name, values) for the grids with one value per voxel, in the file's order.
template <typename Visit>
void for_each_voxel_grid(const LevelGrids& of, const Visit& visit) {
    const auto name = [&](GridKind kind, std::size_t axis = 0) {
        return grid_name(kind, static_cast<int>(axis), of.level);
    };
    visit(name(GridKind::Coverage), CoverageValues{});
    for (std::size_t a = 0; a < 3 && has_masks(of.fields, of.level); ++a) {
        visit(name(GridKind::Columns, a), ColumnValues{{}, a});
    }
    if (of.fields.footprints == 4) visit(name(GridKind::Footprint), FootprintValues{});
    for (std::size_t a = 0; a < 3 && of.fields.footprints == 8; ++a) {
        visit(name(GridKind::FootprintAxis, a), FootprintAxisValues{{}, a});
    }
    if (of.fields.occupancy) visit(name(GridKind::Occupancy), OccupancyValues{});
    if (of.fields.correlation) visit(name(GridKind::Correlation), CorrelationValues{});
    if (of.fields.slabs) visit(name(GridKind::Slab), SlabValues{});
    if (of.merge) visit(name(GridKind::Merge), MergeValues{});
}

/// Calls visit(name, values) for the grids of lobe `k`, in the file's order.
template <typename Visit>
void for_each_lobe_grid(const LevelGrids& of, int k, const Visit& visit) {
    const OfLobe lobe{static_cast<std::size_t>(k)};
    visit(grid_name(GridKind::Lobe, k, of.level), LobeValues{lobe});
    if (of.fields.albedo) visit(grid_name(GridKind::Albedo, k, of.level), AlbedoValues{lobe});
    if (of.fields.surface) visit(grid_name(GridKind::Surface, k, of.level), SurfaceValues{lobe});
    if (of.fields.tangents) visit(grid_name(GridKind::Aniso, k, of.level), AnisoValues{lobe});
    if (!has_masks(of.fields, of.level)) return;
    const std::size_t sums = kMomentSums + (of.fields.map_sums() ? kMapSums : 0);
    for (std::size_t j = 0; j < sums; ++j) {
        visit(grid_name(GridKind::Sums, k, of.level, static_cast<int>(j)), SumValues{lobe, j});
    }
}

/// Calls visit(name, values) for every grid of a level that a reader needs: all but the density and
/// the directions, which are derived from the others.
template <typename Visit>
void for_each_grid(const LevelGrids& of, const Visit& visit) {
    for_each_voxel_grid(of, visit);
    for (int k = 0; k < of.lobes; ++k) for_each_lobe_grid(of, k, visit);
}

} // namespace heddle
