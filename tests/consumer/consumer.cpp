// A program of another project that uses the installed core: it calls one function of each library.
#include <heddle/base/parallel.h>
#include <heddle/geom/geometry.h>
#include <heddle/sggx/sggx.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdio>
#include <functional>

int main() {
    const std::size_t sum = heddle::reduce_chunks(
        100, 7, std::size_t{0}, [](std::size_t b, std::size_t e) { return e - b; }, std::plus<>());
    heddle::Bounds bounds;
    bounds.grow({1.0, 2.0, 3.0}, 0.5);
    const float area = heddle::projected_area({1.0f, 1.0f, 1.0f}, {0.0f, 0.0f, 1.0f});
    const heddle::MemoryLevel grid;
    std::printf("%zu %g %g %zu\n", sum, bounds.size().x, double{area}, grid.block_count());
    return sum == 100 && bounds.size().x == 1.0 && area == 1.0f && grid.block_count() == 0 ? 0 : 1;
}
