#include <heddle/yarn/fiber_table.h>

#include <heddle/base/random.h>
#include <heddle/base/trig.h>
#include <heddle/geom/color.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace heddle {
namespace {

/// Flyaways beyond this many standard deviations are not generated; io clamps its normal deviates
/// likewise.
constexpr float kMaxDeviate = 2.5f;

void push_fiber(
    FiberTable& table, float radius, float angle_turns, float phase, std::uint32_t color) {
    const SinCos angle = sincos_turns(static_cast<double>(angle_turns));
    const SinCos migration = sincos_turns(static_cast<double>(phase));
    table.radius.push_back(radius);
    table.cos_angle.push_back(angle.cos);
    table.sin_angle.push_back(angle.sin);
    table.cos_migration.push_back(migration.cos);
    table.sin_migration.push_back(migration.sin);
    table.migration_turns.push_back(phase);
    table.color.push_back(color);
}

/// Returns a radius in [0, r_max] with density p(R) R, as p is per area [Zhao 2016, eq. 2].
float draw_radius(const YarnType& type, CounterRandom& random) {
    constexpr float kE = 2.7182818f;
    for (int attempt = 0; attempt < 1000; ++attempt) {
        const float r = type.density_r_max * std::sqrt(random.uniform());
        const float base = std::max(0.0f, (kE - std::exp(r)) / (kE - 1.0f));
        const float p = (1.0f - 2.0f * type.density_epsilon) * std::pow(base, type.density_beta) +
                        type.density_epsilon;
        if (random.uniform() < p) return r;
    }
    return 0.0f; // p(0) = 1 - eps, so a thousand refusals do not happen for eps < 0.5
}

void place_plies(FiberTable& table, const YarnType& type, CounterRandom& random) {
    std::vector<std::array<float, 3>> fibers;
    for (std::int32_t p = 0; p < type.plies; ++p) {
        const SinCos base = sincos_turns(static_cast<double>(p) / type.plies);
        table.ply_cos.push_back(base.cos);
        table.ply_sin.push_back(base.sin);
        fibers.clear();
        for (std::int32_t f = 0; f < type.fibers_per_ply; ++f) {
            const float r = draw_radius(type, random);
            const float angle = random.uniform();
            fibers.push_back({angle, r, random.uniform()});
        }
        // neighbours in the table cross the same voxels, which helps code with eight lanes
        std::sort(fibers.begin(), fibers.end());
        for (const auto& [angle, r, phase] : fibers) push_fiber(table, r, angle, phase, 0xffffff);
        table.first_of_ply.push_back(static_cast<std::uint32_t>(table.radius.size()));
    }
}

/// The linear 8-bit RGB of a slice's texel, and its alpha in [0, 1].
struct SliceTexel {
    std::uint32_t color;
    float alpha;
};

SliceTexel slice_texel(const Texture& image, std::size_t index) {
    const std::uint8_t* t = image.texels.data() + index * static_cast<std::size_t>(image.channels);
    Vec3f linear;
    for (int c = 0; c < 3; ++c) {
        linear[c] =
            image.srgb ? linear_from_srgb_byte<float>(t[c]) : static_cast<float>(t[c]) / 255.0f;
    }
    return {pack_color(linear), static_cast<float>(t[3]) / 255.0f};
}

/// Distributes fibers over the image in proportion to alpha: fiber i is at a random point of the
/// texel where the running sum of alpha reaches (i + u) / n of the total.
void place_slice(FiberTable& table, const YarnType& type, CounterRandom& random) {
    const Texture& image = type.slice;
    const std::size_t texels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    double total = 0.0;
    for (std::size_t i = 0; i < texels; ++i)
        total += static_cast<double>(slice_texel(image, i).alpha);
    table.ply_cos.push_back(1.0f);
    table.ply_sin.push_back(0.0f);
    double sum = 0.0;
    std::size_t next = 0;
    double target = 0.0;
    const auto draw_target = [&] {
        target = (static_cast<double>(next) + static_cast<double>(random.uniform())) * total /
                 type.slice_fibers;
    };
    draw_target();
    const auto fibers = static_cast<std::size_t>(type.slice_fibers);
    for (std::size_t i = 0; i < texels && next < fibers && total > 0.0; ++i) {
        const SliceTexel texel = slice_texel(image, i);
        sum += static_cast<double>(texel.alpha);
        while (next < fibers && sum > target) {
            const float col = static_cast<float>(i % static_cast<std::size_t>(image.width));
            const float row = static_cast<float>(i / static_cast<std::size_t>(image.width));
            const float x =
                2.0f * (col + random.uniform()) / static_cast<float>(image.width) - 1.0f;
            const float y =
                1.0f - 2.0f * (row + random.uniform()) / static_cast<float>(image.height);
            const float r = std::sqrt(x * x + y * y);
            push_fiber(table, r, 0.0f, 0.0f, texel.color);
            if (r > 0.0f) {
                table.cos_angle.back() = x / r;
                table.sin_angle.back() = y / r;
            }
            ++next;
            draw_target();
        }
    }
    table.first_of_ply.push_back(static_cast<std::uint32_t>(table.radius.size()));
    // n pi r^2 = integral of alpha over the slice, which is 2 model radii wide
    const double side = 2.0 * static_cast<double>(type.model_radius);
    const double area = total / static_cast<double>(texels) * side * side;
    table.fiber_radius =
        static_cast<float>(std::sqrt(area / (3.14159265358979 * type.slice_fibers)));
}

} // namespace

FiberTable place_fibers(const YarnType& type, std::uint64_t seed, std::uint64_t yarn) {
    FiberTable table;
    table.first_of_ply.push_back(0);
    table.fiber_radius = type.fiber_radius;
    CounterRandom random{.seed = seed, .id = yarn};
    switch (type.model) {
    case YarnModel::Procedural: place_plies(table, type, random); break;
    case YarnModel::Slice: place_slice(table, type, random); break;
    case YarnModel::Solid:
        table.ply_cos.push_back(1.0f);
        table.ply_sin.push_back(0.0f);
        push_fiber(table, 0.0f, 0.0f, 0.0f, 0xffffff);
        table.first_of_ply.push_back(1);
        table.fiber_radius = type.model_radius;
        break;
    }
    const std::size_t whole = table.size() + FiberTable::kSpare;
    for (auto* values : {&table.radius, &table.cos_angle, &table.sin_angle, &table.cos_migration,
                         &table.sin_migration, &table.migration_turns}) {
        values->resize(whole);
    }
    table.color.resize(whole);
    return table;
}

float yarn_reach(const YarnType& type) {
    switch (type.model) {
    case YarnModel::Solid: return type.model_radius;
    case YarnModel::Slice: return type.model_radius * 1.4142136f + type.fiber_radius;
    case YarnModel::Procedural: break;
    }
    const float section = std::max(type.ellipse_long, type.ellipse_short) * type.density_r_max;
    const float migration =
        type.migration ? std::max(std::abs(type.migration_min), std::abs(type.migration_max))
                       : 1.0f;
    float reach = section * migration;
    if (type.flyaways) {
        const auto most = [](MeanSd v) { return std::abs(v.mean) + kMaxDeviate * v.sd; };
        reach = std::max({reach, most(type.hair_r0) + most(type.hair_re), most(type.loop_r1)});
    }
    return type.ply_offset + reach + type.fiber_radius;
}

} // namespace heddle
