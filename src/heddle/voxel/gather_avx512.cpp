// The only file that is compiled for AVX-512: gather_kernels.cpp calls it where the machine has that.
#include <heddle/voxel/gather_kernels.h>

#include <heddle/voxel/lanes_avx512.h>

#include <bit>

#define HEDDLE_ISA avx512
#include <heddle/voxel/pool_lanes.h>
// mark_lanes.h stands on pool_lanes.h
#include <heddle/voxel/mark_lanes.h>
