// The only file that is compiled for AVX2. gather_kernels.cpp calls it if the machine has AVX2.
#include <heddle/voxelize/fiber/gather_kernels.h>

#include <heddle/voxelize/fiber/expand_lanes.h>
#include <heddle/voxelize/fiber/lanes_avx2.h>
#include <heddle/voxelize/fiber/mark_lanes.h>

namespace heddle::avx2 {

void gather(const ChordArrays& chords, const GatherTarget& target) {
    gather_with<Lanes>(chords, target);
}

void expand(FiberTile& tile,
            std::span<const PlyPart> parts,
            const PlySection& section,
            const FiberTable& table) {
    expand_with<Lanes>(tile, parts, section, table);
}

} // namespace heddle::avx2
