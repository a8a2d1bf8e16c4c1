#include <heddle/device/deliver_blocks.h>

#include <heddle/base/parallel.h>

namespace heddle {

BatchOptions batch_options(const FitOptions& fit, const LevelBuilder* levels) {
    BatchOptions out;
    out.level0 = fit;
    if (levels == nullptr) return out;
    const LevelOptions* above = levels->options_of_built();
    if (above == nullptr) {
        out.level0.fields.masks = true;
        return out;
    }
    out.above = fit;
    out.above.max_lobes = above->merge.max_lobes;
    out.above.fields = above->fields;
    out.levels = levels->built_levels();
    out.top = levels->wants_top();
    return out;
}

void deliver_blocks(const BatchLevels& built,
                    std::size_t first,
                    std::span<const BatchBlock> blocks,
                    BlockSink& sink,
                    LevelBuilder* levels) {
    const bool takes_built = levels != nullptr && levels->options_of_built() != nullptr;
    parallel_chunks(blocks.size(), 1, [&](std::size_t b, std::size_t) {
        VoxelBlock block;
        BuiltBlock above;
        built.cut(b, blocks[b].index, block, above);
        if (!takes_built) {
            sink.take(first + b, block);
            return;
        }
        levels->accept(first + b, block, above);
        sink.keep(first + b, block);
    });
}

} // namespace heddle
