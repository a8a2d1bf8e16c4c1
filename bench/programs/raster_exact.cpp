// raster_exact: compares the rasterizing with the sampling voxelizer on equal slices.
#include <heddle/geom/generate.h>
#include <heddle/raster/test_difference.h>
#include <heddle/raster/voxelize_slices.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace heddle::raster::test {

using namespace heddle::slice::test;
namespace {

void print_row(const std::string& name, const Geometry& geometry, double voxel_size) {
    VoxelizeOptions options;
    options.voxel_size = {voxel_size, voxel_size, voxel_size};
    options.keep_sums = true;
    const VoxelizePlan plan = plan_voxelize(geometry, options);
    Progress silent;
    const std::unique_ptr<VoxelLevel> sampled = voxelize(geometry, options, plan, silent);
    const std::unique_ptr<VoxelLevel> drawn = voxelize_slices(geometry, options, {}, plan, silent);
    const Difference d = compare(*sampled, *drawn);
    std::printf("| %s | %lld | %.4f | %.4f | %.4f | %.2f | %.2f |\n", name.c_str(),
                static_cast<long long>(sampled->info().voxel_count), d.density, d.coverage,
                d.volume, d.angle_deg, d.far_deg);
}

void print_cloth(const char* name, GenerateKind kind, std::int64_t nx, std::int64_t ny) {
    Geometry cloth = generate({.kind = kind, .nx = nx, .ny = ny});
    set_yarn(cloth, slice_yarn(0.0f, 60));
    const double radius = static_cast<double>(cloth.curves[0].default_radius);
    print_row(name, cloth, radius / 3.0);
}

void print_table() {
    std::puts("| slices | voxels | density | coverage | volume | median angle | 9 of 10 below |\n"
              "|---|---|---|---|---|---|---|");
    for (int k = 0; k < 20; ++k) {
        const double turn = 90.0 * k / 19.0; // from x to y, and every other one upwards
        const double up = k % 2 == 0 ? 0.0 : turn;
        const double a = turn * 0.017453292519943295;
        const double b = up * 0.017453292519943295;
        const Vec3f along =
            to_float({std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)});
        char name[64];
        std::snprintf(name, sizeof name, "straight, %.0f across, %.0f up", turn, up);
        print_row(name, straight_yarn(along, slice_yarn(0.06f)), 0.02);
    }
    print_cloth("satin", GenerateKind::Satin, 5, 5);
    print_cloth("cable", GenerateKind::Cable, 8, 4);
}

} // namespace
} // namespace heddle::raster::test

int main() {
    heddle::raster::test::print_table();
}
