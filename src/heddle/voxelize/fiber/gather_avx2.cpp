// The one file that is compiled for AVX2: gather_kernels.cpp calls it where the machine has that.
#include <heddle/voxelize/fiber/gather_kernels.h>

#include <heddle/voxelize/fiber/lanes_avx2.h>

#include <bit>

#define HEDDLE_ISA avx2
#include <heddle/voxelize/fiber/pool_lanes.h>
// mark_lanes.h stands on pool_lanes.h
#include <heddle/voxelize/fiber/expand_lanes.h>
#include <heddle/voxelize/fiber/mark_lanes.h>
