#pragma once

#include <heddle/device/level/batch_levels.h>
#include <heddle/device/level/build_level.h>
#include <heddle/device/level/store_level.h>

#include <utility>

// The body of build_batch_levels(), for the files that make it for an executor: build_batch.cpp, .cu.

namespace heddle {

template <typename Exec>
void build_batch_levels(Exec& exec,
                        LevelArrays level0,
                        std::size_t blocks,
                        const BatchSettings& settings,
                        BatchLevels& out) {
    out.settings = settings;
    store_level_arrays(exec, level0, blocks, settings.level0, out.level[0]);
    LevelArrays level = std::move(level0);
    for (int l = 1; l <= settings.levels; ++l) {
        level = build_level_arrays(exec, std::move(level), settings.above.max_lobes);
        store_level_arrays(exec, level, blocks, settings.above,
                           out.level[static_cast<std::size_t>(l)]);
    }
    if (!settings.top) return;
    detail::bring_down(exec, std::move(level.key), out.top.key);
    detail::bring_down(exec, std::move(level.hits), out.top.hits);
    detail::bring_down(exec, std::move(level.first_lobe), out.top.first_lobe);
    detail::bring_down(exec, std::move(level.order), out.top.order);
    detail::bring_down(exec, std::move(level.columns), out.top.columns);
    detail::bring_down(exec, std::move(level.lobes), out.top.lobes);
    detail::bring_down(exec, std::move(level.maps), out.top.maps);
}

} // namespace heddle
