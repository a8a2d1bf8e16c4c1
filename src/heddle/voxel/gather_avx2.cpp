// The one file that is compiled for AVX2: gather_kernels.cpp calls it where the machine has that.
#include <heddle/voxel/gather_kernels.h>

#include <heddle/voxel/lanes_avx2.h>

#include <bit>

#define HEDDLE_ISA avx2
#include <heddle/voxel/pool_lanes.h>
// mark_lanes.h stands on pool_lanes.h
#include <heddle/voxel/expand_lanes.h>
#include <heddle/voxel/mark_lanes.h>
