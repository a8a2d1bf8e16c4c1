#pragma once

#include <heddle/device/level/batch_levels.h>
#include <heddle/device/level/build_level.h>
#include <heddle/device/level/store_level.h>

#include <utility>

// The body of build_batch_levels(), which build_batch.cpp and build_batch.cu instantiate.

namespace heddle {

template <typename Exec>
void build_batch_levels(Exec& exec,
                        LevelArrays level0,
                        std::size_t blocks,
                        const BatchOptions& options,
                        BatchLevels& out) {
    out.options = options;
    store_level_arrays(exec, level0, blocks, options.level0, out.level[0]);
    LevelArrays level = std::move(level0);
    for (int l = 1; l <= options.levels; ++l) {
        level = build_level_arrays(exec, std::move(level), options.above);
        store_level_arrays(exec, level, blocks, options.above,
                           out.level[static_cast<std::size_t>(l)]);
    }
    if (!options.top) return;
    detail::download_array(exec, std::move(level.key), out.top.key);
    detail::download_array(exec, std::move(level.hits), out.top.hits);
    detail::download_array(exec, std::move(level.first_lobe), out.top.first_lobe);
    detail::download_array(exec, std::move(level.order), out.top.order);
    detail::download_array(exec, std::move(level.columns), out.top.columns);
    detail::download_array(exec, std::move(level.occupancy), out.top.occupancy);
    detail::download_array(exec, std::move(level.lobes), out.top.lobes);
    detail::download_array(exec, std::move(level.maps), out.top.maps);
    detail::download_array(exec, std::move(level.slabs), out.top.slabs);
}

} // namespace heddle
