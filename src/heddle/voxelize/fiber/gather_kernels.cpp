#include <heddle/voxelize/fiber/gather_kernels.h>

#include <heddle/voxelize/fiber/expand_lanes.h>
#include <heddle/voxelize/fiber/lanes_portable.h>
#include <heddle/voxelize/fiber/mark_lanes.h>

namespace heddle {

namespace portable {

void gather(const ChordArrays& chords, const GatherTarget& target) {
    gather_with<Lanes>(chords, target);
}

void expand(FiberTile& tile,
            std::span<const PlyPart> parts,
            const PlySection& section,
            const FiberTable& table) {
    expand_with<Lanes>(tile, parts, section, table);
}

} // namespace portable

namespace {

bool use_avx2() {
#if HEDDLE_WITH_AVX2
    static const bool has =
        __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi2") != 0;
    return has;
#else
    return false;
#endif
}

bool use_avx512() {
#if HEDDLE_WITH_AVX2
    static const bool has =
        __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
        __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
        __builtin_cpu_supports("bmi2") != 0;
    return has;
#else
    return false;
#endif
}

} // namespace

void gather_thin(const ChordArrays& chords, const GatherTarget& target) {
    if constexpr (HEDDLE_WITH_AVX2) {
        if (use_avx512()) return avx512::gather(chords, target);
        if (use_avx2()) return avx2::gather(chords, target);
    }
    portable::gather(chords, target);
}

void expand_fibers(FiberTile& tile,
                   std::span<const PlyPart> parts,
                   const PlySection& section,
                   const FiberTable& table) {
    if constexpr (HEDDLE_WITH_AVX2) {
        if (use_avx2()) return avx2::expand(tile, parts, section, table);
    }
    portable::expand(tile, parts, section, table);
}

} // namespace heddle
