#include <heddle/render/volume/cell_walk.h>

#include <heddle/render/volume/test_volume.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle {
namespace {

using namespace heddle::testing;

bool is_set(std::uint64_t cells, Vec3f at) {
    const auto cell = [](float x) { return std::clamp(static_cast<int>(4.0f * x), 0, 3); };
    return (cells >> ((cell(at.x) * 4 + cell(at.y)) * 4 + cell(at.z)) & 1) != 0;
}

/// Returns the t at which a ray leaves [0, 1]^3.
float length_inside(Vec3f in, Vec3f direction) {
    float t = 1e30f;
    for (int a = 0; a < 3; ++a) {
        if (direction[a] != 0.0f) {
            t = std::min(t, ((direction[a] > 0.0f ? 1.0f : 0.0f) - in[a]) / direction[a]);
        }
    }
    return t;
}

TEST(CellWalk, VisitsTheSetPartsOfARay) {
    StreamRandom random{8};
    for (int r = 0; r < 100; ++r) {
        const std::uint64_t cells = r == 0 ? ~std::uint64_t{0} : random.next() & random.next();
        const Vec3f in{random.uniform(), random.uniform(), random.uniform()};
        Vec3f direction = random_direction(random) * (0.1f + random.uniform());
        if (r % 5 == 1) direction = {0, direction.y, 0};
        const float length = length_inside(in, direction);
        std::vector<std::pair<float, float>> parts;
        EXPECT_TRUE(visit_set_cells(cells, in, direction, length, [&](float t0, float t1) {
            EXPECT_LE(t0, t1);
            EXPECT_TRUE(parts.empty() || parts.back().second <= t0);
            parts.push_back({t0, t1});
            return true;
        }));
        for (int i = 0; i < 200; ++i) {
            const float t = length * random.uniform();
            bool near = false, inside = false; // near an end of a part, either is right
            for (const auto& [t0, t1] : parts) {
                near |= std::fabs(t - t0) < 1e-4f * length || std::fabs(t - t1) < 1e-4f * length;
                inside |= t0 <= t && t <= t1;
            }
            const Vec3f at = in + direction * t;
            if (near) continue;
            EXPECT_EQ(inside, is_set(cells, at)) << r << ' ' << t;
        }
    }
}

TEST(CellWalk, EndsWhereTheVisitorSaysSo) {
    int visits = 0;
    EXPECT_FALSE(visit_set_cells(0x5, {0.1f, 0.1f, 0.0f}, {0, 0, 1}, 1.0f, [&](float, float) {
        ++visits;
        return false;
    }));
    EXPECT_EQ(visits, 1);
}

} // namespace
} // namespace heddle
