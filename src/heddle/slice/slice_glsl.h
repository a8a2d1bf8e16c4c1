#pragma once

#include <string_view>

namespace heddle::slice {

/// GLSL: a placed slice as stored in buffers (PlacedSlice), and the direction of the fiber through
/// a point of it.
inline constexpr std::string_view kSliceGlsl = R"(
struct Slice {
    vec3 center; float scale;
    vec3 tangent; float turn;
    vec3 normal; uint layer;
    uint color; float extent; float fiber_radius; uint flags;
};
const uint kLastOfYarn = 1u;

vec3 any_perpendicular(vec3 n) { // [Duff 2017]
    float s = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (s + n.z);
    return vec3(1.0 + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}

// The difference of a fiber's positions on two slices that are `turn` apart, half a step before and
// half a step after `at`: eq. 1 of [LopezMoreno17], which looks back one whole step from the second
// position, written for the middle of the two.
vec2 fiber_step(vec2 at, float turn) {
    return 2.0 * sin(0.5 * turn) * vec2(-at.y, at.x);
}

// The unit direction of the fiber at `at` (units, in the frame of the section), for slices that are
// `rise` apart.
vec3 fiber_direction(vec2 at, float turn, float rise, vec3 normal, vec3 binormal, vec3 tangent) {
    vec2 step_in_plane = fiber_step(at, turn);
    vec3 d = step_in_plane.x * normal + step_in_plane.y * binormal + max(rise, 1e-6) * tangent;
    return normalize(d);
}
)";

/// GLSL: placed slices, and the segment between two of them. Needs kSliceGlsl. Binding 0.
inline constexpr std::string_view kSpanGlsl = R"(
layout(std430, binding = 0) readonly buffer Slices { Slice slices[]; };

// Half the length of the segment from slice a to b, including what a bend adds to its sections.
float half_length(Slice a, Slice b, float reach) {
    return 0.5 * length(b.center - a.center) + reach * length(b.tangent - a.tangent);
}

float reach_of(Slice a, Slice b) { return a.extent * max(a.scale, b.scale); }
)";

/// GLSL: curves and their control points, and the cubic of a span. Bindings 0 to 5.
inline constexpr std::string_view kCurveGlsl = R"(
struct Curve {
    uint first_point; uint points; uint spans; uint flags;
    uint first_knot; uint layer; uint pad0; uint pad1;
    float twist; float model_radius; float extent; float fiber_radius;
    float yarn_radius; float spacing; float pad2; float pad3;
};
const uint kClosed = 1u;
const uint kLinear = 2u;
const uint kBSpline = 4u;
const uint kColored = 8u;
struct Knot { vec3 normal; uint before; }; // before: number of slices of the curve before it
struct Course { double length; double turns; double slices; double most; }; // of a span

layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 1) readonly buffer Colors { uint colors[]; };
layout(std430, binding = 2) readonly buffer Curves { Curve curves[]; };

// P(t) = c0 + c1 t + c2 t^2 + c3 t^3
struct Cubic { vec3 c0, c1, c2, c3; };

vec3 cubic_at(Cubic c, float t) { return c.c0 + t * (c.c1 + t * (c.c2 + t * c.c3)); }
vec3 cubic_slope(Cubic c, float t) { return c.c1 + t * (2.0 * c.c2 + 3.0 * t * c.c3); }

uint point_of(Curve curve, uint i) {
    return curve.first_point + ((curve.flags & kClosed) != 0u ? i % curve.points : i);
}

// The point at the start of a span; the next one is at its end.
uint knot_point(Curve curve, uint knot) {
    bool plain = (curve.flags & (kClosed | kLinear)) != 0u;
    return point_of(curve, plain ? knot : knot + 1u);
}

Cubic span_cubic(Curve curve, uint k) {
    if ((curve.flags & kLinear) != 0u) {
        vec3 a = points[point_of(curve, k)].xyz;
        return Cubic(a, points[point_of(curve, k + 1u)].xyz - a, vec3(0.0), vec3(0.0));
    }
    uint back = (curve.flags & kClosed) != 0u ? k + curve.points - 1u : k;
    vec3 p0 = points[point_of(curve, back)].xyz;
    vec3 p1 = points[point_of(curve, back + 1u)].xyz;
    vec3 p2 = points[point_of(curve, back + 2u)].xyz;
    vec3 p3 = points[point_of(curve, back + 3u)].xyz;
    if ((curve.flags & kBSpline) != 0u) {
        return Cubic((p0 + 4.0 * p1 + p2) / 6.0, 0.5 * (p2 - p0), 0.5 * (p0 - 2.0 * p1 + p2),
                     (p3 - p0) / 6.0 + 0.5 * (p1 - p2));
    }
    return Cubic(p1, 0.5 * (p2 - p0), p0 - 2.5 * p1 + 2.0 * p2 - 0.5 * p3,
                 0.5 * (p3 - p0) + 1.5 * (p1 - p2));
}

vec3 unit_or(vec3 v, vec3 fallback) {
    float n = length(v);
    return n > 0.0 ? v / n : fallback;
}

vec3 tangent_at(Cubic c, float t) {
    vec3 chord = unit_or(cubic_at(c, 1.0) - c.c0, vec3(0.0, 0.0, 1.0));
    return unit_or(cubic_slope(c, t), chord);
}
)";

/// GLSL, one curve per item: lengths, numbers of slices and frames at its knots, in sequence. One
/// dispatch does kSpansAtOnce spans, because software drivers silently end a shader's loop after
/// 65535 iterations.
inline constexpr std::string_view kCourseGlsl = R"(
layout(std430, binding = 3) buffer Courses { Course courses[]; };
layout(std430, binding = 4) buffer Lengths { double knot_length[]; };
layout(std430, binding = 5) buffer Frames { Knot knots[]; };
uniform uint curve_count;
uniform uint first_span; // first of the kSpansAtOnce that are measured now

const uint kSpansAtOnce = 16384u;
const float kMaxBend = 0.2;  // radians between neighbours
const float kMaxTurn = 0.4;  // radians of twist
const double kMaxSlices = 1.0e6; // per span: more are refused

double arc_length(Cubic c) { // five-point Gauss-Legendre on the speed
    const float x[5] = float[](0.046910077, 0.23076534, 0.5, 0.76923466, 0.95308992);
    const float w[5] = float[](0.11846344, 0.23931434, 0.28444444, 0.23931434, 0.11846344);
    double sum = 0.0LF;
    for (int i = 0; i < 5; ++i) sum += double(w[i] * length(cubic_slope(c, x[i])));
    return sum;
}

float bend_of(Cubic c) {
    float sum = 0.0;
    vec3 from = tangent_at(c, 0.0);
    for (int i = 1; i <= 8; ++i) {
        vec3 to = tangent_at(c, float(i) / 8.0);
        sum += length(to - from);
        from = to;
    }
    return sum;
}

// Carries a normal from one point to the next without rotation about the tangent. [Wang 2008]
vec3 transport(vec3 normal, vec3 p0, vec3 t0, vec3 p1, vec3 t1) {
    vec3 v1 = p1 - p0;
    float c1 = dot(v1, v1);
    if (c1 <= 0.0) return normal;
    vec3 r = normal - (2.0 / c1 * dot(v1, normal)) * v1;
    vec3 t = t0 - (2.0 / c1 * dot(v1, t0)) * v1;
    vec3 v2 = t1 - t;
    float c2 = dot(v2, v2);
    return c2 <= 0.0 ? r : r - (2.0 / c2 * dot(v2, r)) * v2;
}

void main() {
    if (item() >= curve_count) return;
    Curve curve = curves[item()];
    if (curve.spans == 0u) {
        courses[item()] = Course(0.0LF, 0.0LF, 0.0LF, 0.0LF);
        return;
    }
    if (first_span >= curve.spans) return; // the curve is done
    float head = curve.yarn_radius > 0.0 ? curve.yarn_radius
                                         : points[knot_point(curve, 0u)].w;
    double per_unit = double(curve.model_radius / max(head, 1e-30));
    Cubic cubic = span_cubic(curve, first_span == 0u ? 0u : first_span - 1u);
    vec3 tangent = tangent_at(cubic, first_span == 0u ? 0.0 : 1.0);
    vec3 normal = any_perpendicular(tangent);
    double sum = 0.0LF;
    double slices = 0.0LF;
    double wanted = 0.0LF;
    if (first_span > 0u) { // continues from the end of the previous part
        normal = knots[curve.first_knot + first_span].normal;
        sum = knot_length[curve.first_knot + first_span];
        slices = courses[item()].slices - 1.0LF;
        wanted = courses[item()].most;
    }
    uint end = min(first_span + kSpansAtOnce, curve.spans);
    for (uint k = first_span; k < end; ++k) {
        knot_length[curve.first_knot + k] = sum;
        knots[curve.first_knot + k] = Knot(normal, uint(slices));
        cubic = span_cubic(curve, k);
        double span = arc_length(cubic);
        sum += span;
        float most = max(float(span) / curve.spacing, bend_of(cubic) / kMaxBend);
        most = max(most, abs(curve.twist) * float(span * per_unit) / kMaxTurn);
        wanted = max(wanted, double(ceil(most)));
        slices += clamp(double(ceil(most)), 1.0LF, kMaxSlices);
        vec3 next = tangent_at(cubic, 1.0);
        normal = transport(normal, cubic.c0, tangent, cubic_at(cubic, 1.0), next);
        normal = unit_or(normal - dot(normal, next) * next, any_perpendicular(next));
        tangent = next;
    }
    knot_length[curve.first_knot + end] = sum;
    knots[curve.first_knot + end] = Knot(normal, uint(slices));
    courses[item()] = Course(sum, 0.0LF, slices + 1.0LF, wanted);
    if (end < curve.spans) return;
    vec3 start = knots[curve.first_knot].normal;
    double turns = double(curve.twist) / 6.283185307179586LF * per_unit; // per unit
    if ((curve.flags & kClosed) != 0u && sum > 0.0LF) { // whole turns, and closing the frame
        float closing = atan(dot(cross(normal, start), tangent), dot(normal, start)) / 6.2831853;
        turns = (floor(turns * sum + 0.5LF) + double(closing)) / sum;
    }
    courses[item()] = Course(sum, turns, slices + 1.0LF, wanted);
}
)";

/// GLSL, one slice per item: places it.
inline constexpr std::string_view kPlaceGlsl = R"(
layout(std430, binding = 3) readonly buffer Courses { Course courses[]; };
layout(std430, binding = 4) readonly buffer Lengths { double knot_length[]; };
layout(std430, binding = 5) readonly buffer Frames { Knot knots[]; };
layout(std430, binding = 6) readonly buffer Firsts { uint first_slice[]; }; // by curve, and the end
layout(std430, binding = 7) writeonly buffer Slices { Slice slices[]; };
uniform uint first_curve;
uniform uint curve_count;

uint before_knot(Curve curve, uint k) { return knots[curve.first_knot + k].before; }

uint find_curve(uint slice) {
    uint lo = 0u;
    uint hi = curve_count;
    while (hi - lo > 1u) {
        uint mid = (lo + hi) / 2u;
        if (first_slice[first_curve + mid] - first_slice[first_curve] <= slice) lo = mid;
        else hi = mid;
    }
    return first_curve + lo;
}

uint find_span(Curve curve, uint slice) {
    uint lo = 0u;
    uint hi = curve.spans;
    while (hi - lo > 1u) {
        uint mid = (lo + hi) / 2u;
        if (before_knot(curve, mid) <= slice) lo = mid;
        else hi = mid;
    }
    return lo;
}

uint mix_colors(uint a, uint b, float t) {
    vec4 mixed = mix(unpackUnorm4x8(a), unpackUnorm4x8(b), t);
    return packUnorm4x8(mixed);
}

void main() {
    uint end = first_slice[first_curve + curve_count] - first_slice[first_curve];
    if (item() >= end) return;
    uint number = find_curve(item());
    Curve curve = curves[number];
    uint local = item() - (first_slice[number] - first_slice[first_curve]);
    uint k = find_span(curve, local);
    uint before = before_knot(curve, k);
    uint count = before_knot(curve, k + 1u) - before;
    float t = float(local - before) / float(count);
    Cubic cubic = span_cubic(curve, k);
    vec3 tangent = tangent_at(cubic, t);
    uint knot = curve.first_knot + k;
    vec3 lerped = mix(knots[knot].normal, knots[knot + 1u].normal, t);
    vec3 normal = unit_or(lerped - dot(lerped, tangent) * tangent, any_perpendicular(tangent));
    vec3 binormal = cross(tangent, normal);
    double s0 = knot_length[curve.first_knot + k];
    double step_length = (knot_length[curve.first_knot + k + 1u] - s0) / double(count);
    double turned = courses[number].turns * (s0 + step_length * double(local - before));
    float angle = 6.2831853 * float(fract(turned));
    uint p0 = knot_point(curve, k);
    uint p1 = knot_point(curve, k + 1u);
    float radius = curve.yarn_radius > 0.0 ? curve.yarn_radius : mix(points[p0].w, points[p1].w, t);
    Slice slice;
    slice.center = cubic_at(cubic, t);
    slice.scale = radius / curve.model_radius;
    slice.tangent = tangent;
    slice.turn = 6.2831853 * float(courses[number].turns * step_length);
    slice.normal = cos(angle) * normal + sin(angle) * binormal;
    slice.layer = curve.layer;
    bool colored = (curve.flags & kColored) != 0u;
    slice.color = colored ? mix_colors(colors[p0], colors[p1], t) : 0xffffffu;
    slice.extent = curve.extent;
    slice.fiber_radius = curve.fiber_radius;
    bool last = local + 1u == first_slice[number + 1u] - first_slice[number];
    slice.flags = last ? kLastOfYarn : 0u;
    slices[item()] = slice;
}
)";

} // namespace heddle::slice
