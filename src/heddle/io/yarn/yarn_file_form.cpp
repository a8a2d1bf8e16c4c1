#include <heddle/io/yarn/yarn_file_form.h>

#include <heddle/base/error.h>
#include <heddle/base/nearest_name.h>
#include <heddle/io/yarn/yarn_file.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace heddle::yarn_form {
namespace {

/// of lengths, in model units: far above real ones, far from overflow
constexpr double kLong = 1e9;
constexpr auto kAny = YarnModel::Solid;
constexpr auto kPly = YarnModel::Procedural;
constexpr auto kSlice = YarnModel::Slice;

std::string range_text(const Field& field) {
    return str(field.above ? "above " : "from ", field.least, field.above ? " and up to " : " to ",
               field.most);
}

/// The fraction of the slice's square that its alpha marks as fiber; 0 if there is no image.
double mean_alpha(const Texture& slice) {
    if (slice.texels.empty()) return 0.0;
    if (slice.channels != 4) return 1.0;
    double sum = 0.0;
    for (std::size_t i = 3; i < slice.texels.size(); i += 4) sum += slice.texels[i];
    return sum / (255.0 * static_cast<double>(slice.texels.size() / 4));
}

} // namespace

const std::vector<Field>& fields() {
    using Y = YarnType;
    static const std::vector<Field> table{
        {"radius", "", kAny, &Y::radius, 0, kLong},
        {"model_radius", "yarn_radius", kAny, &Y::model_radius, 0, kLong, true, true},
        {"fiber_radius", "", kAny, &Y::fiber_radius, 0, kLong, true},
        {"albedo", "", kAny, &Y::albedo, 0, 1},
        {"plies", "ply_num", kPly, &Y::plies, 1, 1e6, false, true},
        {"fibers_per_ply", "fiber_num", kPly, &Y::fibers_per_ply, 1, 1e6, false, true},
        {"ply_clockwise", "yarn_clock_wise", kPly, &Y::ply_clockwise, 0, 1},
        {"fiber_clockwise", "fiber_clock_wise", kPly, &Y::fiber_clockwise, 0, 1},
        {"ply_pitch", "yarn_alpha", kPly, &Y::ply_pitch, 0, kLong, true, true},
        {"fiber_pitch", "alpha", kPly, &Y::fiber_pitch, 0, kLong, true, true},
        {"ply_offset", "", kPly, &Y::ply_offset, 0, kLong},
        {"ellipse_long", "ellipse_long", kPly, &Y::ellipse_long, 0, kLong, true, true},
        {"ellipse_short", "ellipse_short", kPly, &Y::ellipse_short, 0, kLong, true, true},
        {"density_epsilon", "epsilon", kPly, &Y::density_epsilon, 0, 0.5, false, true},
        {"density_beta", "beta", kPly, &Y::density_beta, 0, 1e3, false, true},
        // outside of the unit section the density of fibers is not defined
        {"density_r_max", "R_max", kPly, &Y::density_r_max, 0, 1, true, true},
        {"migration", "use_migration", kPly, &Y::migration, 0, 1, false, true},
        {"migration_frequency", "s_i", kPly, &Y::migration_frequency, 0, 1e6},
        {"migration_min", "rho_min", kPly, &Y::migration_min, 0, 10},
        {"migration_max", "rho_max", kPly, &Y::migration_max, 0, 10},
        {"flyaways", "use_flyaways", kPly, &Y::flyaways, 0, 1, false, true},
        {"hair_density", "flyaway_hair_density", kPly, &Y::hair_density, 0, kLong},
        {"hair_ze", "flyaway_hair_ze", kPly, &Y::hair_ze, -kLong, kLong},
        {"hair_r0", "flyaway_hair_r0", kPly, &Y::hair_r0, -kLong, kLong},
        {"hair_re", "flyaway_hair_re", kPly, &Y::hair_re, -kLong, kLong},
        {"hair_pe", "flyaway_hair_pe", kPly, &Y::hair_pe, -kLong, kLong},
        {"loop_density", "flyaway_loop_density", kPly, &Y::loop_density, 0, kLong},
        {"loop_r1", "flyaway_loop_r1", kPly, &Y::loop_r1, -kLong, kLong},
        {"twist", "", kSlice, &Y::twist, -kLong, kLong},
        {"slice_fibers", "", kSlice, &Y::slice_fibers, 1, 1e6},
    };
    return table;
}

std::string_view to_string(YarnModel model) {
    switch (model) {
    case YarnModel::Solid: return "solid";
    case YarnModel::Procedural: return "procedural";
    case YarnModel::Slice: return "slice";
    }
    return "solid";
}

void set_field(YarnType& yarn,
               const Field& field,
               std::string_view key,
               const std::vector<double>& numbers,
               std::int64_t line,
               FileProblems& problems) {
    const auto set = [&](auto member) {
        using T = std::remove_reference_t<decltype(yarn.*member)>;
        constexpr bool pair = std::is_same_v<T, MeanSd>;
        constexpr std::size_t count = pair ? 2 : std::is_same_v<T, Vec3f> ? 3 : 1;
        if (numbers.size() != count) {
            problems.add(line,
                         str("'", key, "' has ", numbers.size(), " numbers, it takes ", count));
            return;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const double least = pair && i == 1 ? 0.0 : field.least; // a deviation is at least 0
            const double x = numbers[i];
            const bool whole = !std::is_integral_v<T> || x == std::floor(x);
            // a number above 0 that becomes 0 as a float counts as 0
            const bool inside =
                x >= least && x <= field.most &&
                !(field.above && static_cast<float>(x) <= static_cast<float>(least));
            if (!inside || !whole) {
                problems.add(line, str("'", key, "' is ", x, ", it must be ",
                                       whole ? "" : "a whole number ", range_text(field)));
                return;
            }
        }
        if constexpr (pair) {
            yarn.*member = {static_cast<float>(numbers[0]), static_cast<float>(numbers[1])};
        } else if constexpr (count == 3) {
            yarn.*member = to_float({numbers[0], numbers[1], numbers[2]});
        } else {
            yarn.*member = static_cast<T>(numbers[0]);
        }
    };
    std::visit(set, field.member);
}

std::string complete(YarnType& yarn, FileProblems& problems) {
    if (yarn.fiber_count() > kMaxFibers) {
        problems.add(0, str("the yarn has ", yarn.fiber_count(), " fibers, at most ", kMaxFibers,
                            " are allowed"));
    }
    if (yarn.migration_min > yarn.migration_max) {
        problems.add(0, str("migration's least radius ", yarn.migration_min,
                            " is above its largest ", yarn.migration_max));
    }
    if (yarn.fiber_radius > 0.0f) return {};
    if (yarn.model == YarnModel::Solid) {
        yarn.fiber_radius = yarn.model_radius;
        return {};
    }
    double area = static_cast<double>(kDefaultFill) * static_cast<double>(yarn.ellipse_long) *
                  static_cast<double>(yarn.ellipse_short) / yarn.fibers_per_ply;
    std::string why = str("the fibers fill ", kDefaultFill, " of a ply's section");
    if (yarn.model == YarnModel::Slice) {
        const double r = static_cast<double>(yarn.model_radius);
        area = mean_alpha(yarn.slice) * 4.0 * r * r / (std::numbers::pi * yarn.slice_fibers);
        why = str(yarn.slice_fibers, " fibers fill the area that the slice's alpha gives");
    }
    yarn.fiber_radius = static_cast<float>(std::sqrt(area));
    if (!(yarn.fiber_radius > 0.0f)) problems.add(0, "the fibers are infinitely thin");
    return str("no fiber radius is given: ", yarn.fiber_radius, " is used (",
               yarn.fiber_radius / yarn.model_radius, " of the yarn's), so that ", why);
}

std::string suggest(std::string_view key, const std::vector<std::string_view>& known) {
    const std::string_view nearest = nearest_name(key, known);
    std::string text = nearest.empty() ? "" : str("; did you mean '", nearest, "'?");
    if (nearest.empty() || known.size() <= 6) {
        text += nearest.empty() ? "; known: " : " known: ";
        for (std::size_t i = 0; i < known.size(); ++i) text += str(i > 0 ? ", " : "", known[i]);
    }
    return text;
}

} // namespace heddle::yarn_form
