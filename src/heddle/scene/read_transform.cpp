#include <heddle/scene/scene_parts.h>

#include <heddle/base/error.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heddle::scene_form {
namespace {

/// Relative to the product of the axes' lengths; a smaller volume of the mapped unit cube is noise.
constexpr double kSingular = 1e-9;

/// Rodrigues' rotation.
Affine rotation(Vec3d axis, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const auto turn = [&](Vec3d v) {
        return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1.0 - c));
    };
    return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1}), {}};
}

Affine read_rotate(TableReader& reader) {
    const auto v = reader.numbers("rotate", {4});
    if (!v) return {};
    const Vec3d axis{(*v)[0], (*v)[1], (*v)[2]};
    const double largest = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
    if (!(largest > 0.0)) {
        reader.problem("rotate", "the axis of 'rotate' has no length",
                       "write [axis x, y, z, degrees]");
        return {};
    }
    const Vec3d unit = normalize(axis * (1.0 / largest));
    // multiples of a quarter turn are exact
    const double degrees = std::remainder((*v)[3], 360.0);
    Affine r = rotation(unit, degrees * (std::numbers::pi / 180.0));
    if (std::remainder(degrees, 90.0) == 0.0) {
        for (Vec3d* column : {&r.x, &r.y, &r.z}) {
            const Vec3d whole{std::round(column->x), std::round(column->y), std::round(column->z)};
            if (length(whole - *column) < 1e-12) *column = whole;
        }
    }
    return r;
}

Affine read_scale(TableReader& reader) {
    Affine a;
    const auto v = reader.numbers("scale", {1, 3});
    if (!v) return a;
    const auto at = [&](std::size_t i) { return v->size() == 1 ? (*v)[0] : (*v)[i]; };
    if (at(0) == 0.0 || at(1) == 0.0 || at(2) == 0.0) {
        reader.problem("scale", "'scale' has a zero, which leaves no volume",
                       "write 1 for no change");
        return a;
    }
    return {{at(0), 0, 0}, {0, at(1), 0}, {0, 0, at(2)}, {}};
}

Affine read_matrix(TableReader& reader) {
    const auto v = reader.numbers("matrix", {12});
    if (!v) return {};
    const std::vector<double>& m = *v;
    return {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
}

} // namespace

Affine read_transform(TableReader& reader) {
    const Affine matrix = read_matrix(reader);
    Affine move;
    reader.vector("translate", move.offset);
    const Affine parts = move * read_rotate(reader) * read_scale(reader);
    if (reader.has("matrix")) {
        for (const char* key : {"translate", "rotate", "scale"}) {
            if (reader.has(key)) {
                reader.problem(key, str("'", key, "' stands beside 'matrix'"), "keep one of them");
            }
        }
    }
    const Affine a = reader.has("matrix") ? matrix : parts;
    const double product = length(a.x) * length(a.y) * length(a.z);
    if (!(std::abs(a.determinant()) > kSingular * product)) {
        reader.problem(reader.has("matrix") ? "matrix" : "scale",
                       str("the transform is singular: its determinant is ", a.determinant()),
                       "it must not flatten the object; rows are [x, y, z, offset]");
    }
    return a;
}

} // namespace heddle::scene_form
