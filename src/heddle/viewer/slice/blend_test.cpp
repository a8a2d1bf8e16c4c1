#include <heddle/viewer/slice/slice_renderer.h>
#include <heddle/viewer/slice/test_blend.h>

#include <heddle/geom/generate.h>
#include <heddle/slice/test_slices.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle::viewer {
namespace {

constexpr std::int32_t kSize = 200;
constexpr double kPixel = 0.05; ///< pixel for which slices are placed, scene units

/// A knit of more than 10,000 slices.
Geometry knit() {
    Geometry geometry = generate({.kind = GenerateKind::Knit, .nx = 17, .ny = 10});
    slice::test::set_yarn(geometry, slice::test::slice_yarn(0.1f, 60));
    for (CurveSet& set : geometry.curves) set.color.assign(set.points.size(), 0x6090e0u);
    for (Material& m : geometry.materials) m.albedo = {1.0f, 1.0f, 1.0f};
    return geometry;
}

TEST(Blend, TenThousandSortedSlicesAreWithinOneOf255OfTheReferenceOnAllButATenthOfAPercent) {
    const opengl::Context context;
    const Geometry geometry = knit();
    SliceRenderer renderer(context, geometry, {.pixel = kPixel});
    ASSERT_GT(renderer.slice_count(), 10000);
    const slice::SectionLayers layers = slice::build_sections(geometry, 0);
    const LatticeUnits units({.voxel_size = {kPixel, kPixel, kPixel}, .subvoxels = 1});
    const std::vector<slice::SliceChunk> chunks =
        slice::place_slices(context, geometry, layers, units, {.lattice = false});
    ASSERT_EQ(chunks.size(), 1u);
    test::BlendReference reference(geometry, layers, slice::read_slices(chunks[0]), units.unit);
    const SliceLook look{.shadows = false};
    for (const double angle : {0.0, 0.6}) {
        Orbit orbit{.view_angle = angle};
        orbit.frame(renderer.ball(), 1.0);
        orbit.zoom(1.5);
        const RenderTarget target(kSize, kSize);
        target.clear();
        renderer.draw(target, orbit.camera(), look);
        const std::vector<float> drawn = target.read();
        const std::vector<double> truth = reference.draw(orbit.camera(), kSize, kSize, look.light);
        int off = 0;
        double worst = 0.0;
        double covered = 0.0;
        for (std::size_t p = 0; p < drawn.size(); p += 4) {
            double apart = 0.0;
            for (std::size_t c = 0; c < 4; ++c) {
                apart =
                    std::max(apart, std::fabs(static_cast<double>(drawn[p + c]) - truth[p + c]));
            }
            off += apart > 1.0 / 255.0 ? 1 : 0;
            worst = std::max(worst, apart);
            covered += truth[p + 3];
        }
        EXPECT_LE(off, kSize * kSize / 1000) << "worst " << worst << " at angle " << angle;
        EXPECT_GT(covered, 0.2 * kSize * kSize);
    }
}

} // namespace
} // namespace heddle::viewer
