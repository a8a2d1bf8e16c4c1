#include "cases.h"

#include <heddle/geom/generate.h>

#include <cmath>
#include <utility>

namespace heddle::check {
namespace {

/// Plies of fibers, about as in the fit of cotton by Zhao et al. 2016.
YarnType procedural(int fibers, bool flyaways) {
    YarnType y;
    y.model = YarnModel::Procedural;
    y.plies = 3;
    y.fibers_per_ply = fibers / 3;
    y.ply_offset = 0.5f;
    y.ellipse_long = 0.5f;
    y.ellipse_short = 0.4f;
    y.ply_pitch = 7.0f;
    y.fiber_pitch = 5.0f;
    y.density_epsilon = 0.1f;
    y.migration = true;
    y.migration_frequency = 1.4f;
    y.migration_min = 0.6f;
    y.fiber_radius = 0.5f / std::sqrt(static_cast<float>(fibers));
    y.flyaways = flyaways;
    y.hair_density = 4.0f;
    y.hair_ze = {0.8f, 0.4f};
    y.hair_r0 = {0.2f, 0.1f};
    y.hair_re = {0.6f, 0.2f};
    y.hair_pe = {0.8f, 0.4f};
    y.loop_density = 2.0f;
    y.loop_r1 = {0.8f, 0.2f};
    return y;
}

/// A slice of two round plies, one red and one blue.
YarnType slice() {
    YarnType y;
    y.model = YarnModel::Slice;
    y.twist = 1.5f;
    y.slice_fibers = 40;
    Texture& image = y.slice;
    image.width = image.height = 32;
    image.channels = 4;
    image.srgb = true;
    image.texels.resize(32 * 32 * 4);
    for (std::size_t i = 0; i < 32 * 32; ++i) {
        const float x = (static_cast<float>(i % 32) + 0.5f) / 16.0f - 1.0f;
        const float y2 = (static_cast<float>(i / 32) + 0.5f) / 16.0f - 1.0f;
        const float r = std::hypot(std::fabs(x) - 0.5f, y2);
        image.texels[4 * i + (x < 0.0f ? 0 : 2)] = 200;
        image.texels[4 * i + 3] = r < 0.45f ? 120 : 0;
    }
    return y;
}

Geometry generated(GenerateKind kind, std::int64_t nx, std::int64_t ny) {
    GenerateOptions o;
    o.kind = kind;
    o.nx = nx;
    o.ny = ny;
    return generate(o);
}

Geometry with_yarn(Geometry g, YarnType yarn) {
    g.yarns.push_back(std::move(yarn));
    for (CurveSet& set : g.curves) set.yarn = 0;
    return g;
}

VoxelizeOptions voxels(std::int64_t n) {
    VoxelizeOptions o;
    o.voxels = n;
    o.seed = 3;
    return o;
}

Case flat_voxels(Case c, double factor, bool region) {
    const VoxelizePlan plan = plan_voxelize(c.geometry, c.options);
    const double h = plan.lattice.voxel_size.x;
    c.options.voxels = 0;
    c.options.voxel_size = {h, h * 1.25, h * factor};
    if (!region) return c;
    Bounds part;
    part.grow(plan.bounds.lo + plan.bounds.size() * 0.3);
    part.grow(plan.bounds.lo + plan.bounds.size() * 0.8);
    c.options.bounds = part;
    return c;
}

} // namespace

std::vector<Case> parity_cases() {
    using enum GenerateKind;
    std::vector<Case> out;
    const auto add = [&](std::string name, Geometry g, std::int64_t n, std::int64_t batches = 1) {
        out.push_back({std::move(name), std::move(g), voxels(n), batches});
    };
    add("knit, solid", generated(Knit, 4, 4), 200);
    add("knit, plies", with_yarn(generated(Knit, 4, 4), procedural(60, false)), 200);
    add("knit, plies, 8 batches", with_yarn(generated(Knit, 4, 4), procedural(60, false)), 200, 8);
    add("knit, plies, 64 batches", with_yarn(generated(Knit, 4, 4), procedural(60, false)), 300,
        64);
    add("rib, flyaways", with_yarn(generated(Rib, 8, 4), procedural(30, true)), 200);
    add("cable, slice", with_yarn(generated(Cable, 8, 6), slice()), 200);
    add("plain, plies", with_yarn(generated(Plain, 8, 8), procedural(30, false)), 150);
    add("twill, slice", with_yarn(generated(Twill, 8, 8), slice()), 150);
    add("satin, thick", generated(Satin, 10, 10), 300);
    add("hair", generated(Hair, 500, 12), 200);
    add("curls", generated(Curls, 640, 40), 200);
    add("brushed", generated(Brushed, 64, 64), 150);
    add("grass", generated(Grass, 40, 6), 150);
    out.push_back(flat_voxels(
        {"knit, flat voxels", with_yarn(generated(Knit, 4, 4), procedural(30, true)), voxels(150)},
        0.5, false));
    out.push_back(flat_voxels(
        {"rib, region", with_yarn(generated(Rib, 8, 4), procedural(30, true)), voxels(200), 8}, 0.7,
        true));
    return out;
}

std::vector<Case> small_cases() {
    std::vector<Case> out;
    out.push_back({"knit, plies",
                   with_yarn(generated(GenerateKind::Knit, 2, 2), procedural(12, true)),
                   voxels(40)});
    out.push_back({"hair", generated(GenerateKind::Hair, 20, 6), voxels(40)});
    out.push_back({"grass", generated(GenerateKind::Grass, 6, 3), voxels(40)});
    return out;
}

Geometry cloth(const std::string& shape, double nodes, int fibers) {
    GenerateOptions o;
    o.kind = GenerateKind::Knit;
    o.shape = shape == "folded"    ? GenerateShape::Folded
              : shape == "hanging" ? GenerateShape::Hanging
                                   : GenerateShape::Flat;
    o.nx = o.ny = 64;
    const double per_loop = static_cast<double>(predict_nodes(o)) / (64.0 * 64.0);
    o.nx = o.ny = static_cast<std::int64_t>(std::sqrt(nodes / fibers / per_loop));
    return with_yarn(generate(o), procedural(fibers, false));
}

Geometry body(int triangles) {
    const auto n = static_cast<std::uint32_t>(std::sqrt(triangles / 2));
    Geometry g;
    g.name = "body";
    g.materials.resize(1);
    g.materials[0].kind = MaterialKind::Surface;
    Mesh mesh;
    for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const double a = 3.14159265358979 * i / n;
            const double b = 6.28318530717959 * j / n;
            const double r = 1.0 + 0.1 * std::sin(8.0 * a) * std::cos(9.0 * b);
            mesh.positions.push_back(to_float(Vec3d{
                r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), r * std::cos(a)}));
        }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t next = (j + 1) % n;
            mesh.triangles.push_back({i * n + j, (i + 1) * n + j, (i + 1) * n + next});
            mesh.triangles.push_back({i * n + j, (i + 1) * n + next, i * n + next});
        }
    }
    g.meshes.push_back(std::move(mesh));
    return g;
}

} // namespace heddle::check
