#include <heddle/render/volume/sheet_voxel.h>

#include <heddle/render/volume/traversal_level.h>
#include <heddle/voxel/plane_slab.h>

#include <algorithm>

namespace heddle {
namespace detail {
namespace {

/// Returns the probability that the sum of three numbers, uniform in [-w / 2, w / 2] each, is below
/// `height`: the part of a box below a plane.
double part_below(Vec3d widths, double height) {
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        double at = height;
        double sign = 1.0;
        for (int a = 0; a < 3; ++a) {
            const bool upper = (corner >> a & 1) != 0;
            at += (upper ? 0.5 : -0.5) * widths[a];
            if (!upper) sign = -sign;
        }
        if (at > 0.0) sum += sign * at * at * at;
    }
    return sum / (6.0 * widths.x * widths.y * widths.z);
}

/// Returns the extent in x that the line p x + q y = level has in the square [-0.5, 0.5]^2.
double extent(double p, double q, double level) {
    const double half = 0.5 * std::fabs(q);
    if (p == 0.0) return std::fabs(level) < half ? 1.0 : 0.0;
    const double x0 = std::clamp((level - half) / std::fabs(p), -0.5, 0.5);
    const double x1 = std::clamp((level + half) / std::fabs(p), -0.5, 0.5);
    return x1 - x0;
}

} // namespace

std::array<double, 3> project_sheet(Vec3d gradient, double lo, double hi) {
    Vec3d widths;
    double largest = 0.0;
    for (int a = 0; a < 3; ++a) largest = std::max(largest, std::fabs(gradient[a]));
    // a plane that is parallel to an edge: a slope so small that the formula keeps its precision
    for (int a = 0; a < 3; ++a) widths[a] = std::max(std::fabs(gradient[a]), 1e-4 * largest);
    const double density = (part_below(widths, hi) - part_below(widths, lo)) / (hi - lo);
    std::array<double, 3> out{};
    for (int a = 0; a < 3; ++a) {
        const double area = density * std::fabs(gradient[a]);
        out[static_cast<std::size_t>(a)] = std::clamp(area, 0.0, 1.0);
    }
    return out;
}

std::array<double, 3> border_of_sheet(Vec3d gradient, double height) {
    std::array<double, 3> out{};
    for (int a = 0; a < 3; ++a) {
        const double p = gradient[(a + 1) % 3];
        const double q = gradient[(a + 2) % 3];
        for (const double face : {-0.5, 0.5}) { // where the plane leaves the voxel along the axis
            const double level = height - face * gradient[a];
            out[static_cast<std::size_t>(a)] += extent(p, q, level) + extent(q, p, level);
        }
    }
    return out;
}

} // namespace detail

namespace {

std::uint16_t pack_depth(double depth) {
    const double x = std::round(depth / static_cast<double>(kDepthUnit));
    return static_cast<std::uint16_t>(std::clamp(x, 0.0, 65535.0));
}

/// What a sheet would cover if it had no holes, per axis, and how well coverage tells.
struct WholeSheet {
    std::array<double, 3> covers;
    std::array<double, 3> error;
};

WholeSheet whole_sheet(const Lattice& lattice, PlaneSlab slab, Vec3d normal) {
    const Vec3d gradient = normal * lattice.voxel_size;
    const double half = slab_half_extent(normal, lattice.voxel_size);
    const double round = half / 255.0; // half a step: the planes are rounded
    const double lo = slab_position(slab.lo, half);
    const double hi = slab_position(slab.hi, half);
    WholeSheet out{detail::project_sheet(gradient, lo - round, hi + round), {}};
    // The border of the projection runs through a row of columns anywhere in a column, so the count
    // is off by up to half a column in each row; in all rows alike if the border is along an axis.
    const std::array<double, 3> border = detail::border_of_sheet(gradient, 0.5 * (lo + hi));
    for (std::size_t a = 0; a < 3; ++a) out.error[a] = 0.5 * border[a] / lattice.subvoxels;
    return out;
}

/// Returns the share of a whole sheet that must be there to cover what is covered: the least
/// squares over the axes. 1 if, within the error of counting columns, all is covered that a whole
/// sheet would cover as seen along its main axis.
double present_share(const WholeSheet& whole, const std::array<double, 3>& covered) {
    double product = 0.0;
    double square = 0.0;
    double error = 0.0;
    std::size_t main = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        product += whole.covers[a] * std::min(covered[a], whole.covers[a]);
        square += whole.covers[a] * whole.covers[a];
        error += whole.covers[a] * whole.error[a];
        if (whole.covers[a] > whole.covers[main]) main = a;
    }
    const bool is_whole =
        product + error >= square || covered[main] + whole.error[main] >= whole.covers[main];
    return is_whole ? 1.0 : product / square;
}

} // namespace

SheetVoxel make_sheet(const Lattice& lattice, const SheetSource& source) {
    SheetVoxel out;
    out.lo = source.slab.lo;
    out.hi = source.slab.hi;
    const Vec3d normal = slab_normal(source.slab);
    for (int a = 0; a < 3; ++a) {
        out.normal[static_cast<std::size_t>(a)] =
            static_cast<std::int16_t>(std::lround(normal[a] * 32767.0));
    }
    const WholeSheet whole = whole_sheet(lattice, source.slab, normal);
    const double present = present_share(whole, source.covered);
    double p = 1.0;
    out.depth = kOpaqueSheet;
    if (present < 1.0) {
        // matter all over the voxel is no sheet: as far as the slab is thick, it is in the rest
        const double thin = 1.0 - (source.slab.hi - source.slab.lo) / 255.0;
        const double depth = -std::log1p(-present) * thin;
        p = -std::expm1(-depth);
        out.depth = std::min<std::uint16_t>(pack_depth(depth), kOpaqueSheet - 1);
    }
    const double columns = static_cast<double>(lattice.subvoxels) * lattice.subvoxels;
    const double most = 1.0 - 0.5 / columns; // as in the field `density`
    for (std::size_t a = 0; a < 3; ++a) {
        const double sheet = p * whole.covers[a];
        const double error = present < 1.0 ? 0.0 : whole.error[a];
        if (source.covered[a] <= sheet + error || sheet >= most) continue;
        out.rest[a] =
            pack_depth(std::log1p(-sheet) - std::log1p(-std::min(source.covered[a], most)));
    }
    return out;
}

} // namespace heddle
