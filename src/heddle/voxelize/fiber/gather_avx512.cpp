// The only file that is compiled for AVX-512. gather_kernels.cpp calls it if the machine has
// AVX-512.
#include <heddle/voxelize/fiber/gather_kernels.h>

#include <heddle/voxelize/fiber/lanes_avx512.h>
#include <heddle/voxelize/fiber/mark_lanes.h>

namespace heddle::avx512 {

void gather(const ChordArrays& chords, const GatherTarget& target) {
    gather_with<Lanes>(chords, target);
}

} // namespace heddle::avx512
