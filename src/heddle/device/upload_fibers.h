#pragma once

#include <heddle/device/upload_array.h>
#include <heddle/executor/array.h>
#include <heddle/yarn/fiber_source.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heddle {

/// A FiberView where an executor works, and the arrays that it points to.
struct DeviceFibers {
    /// Of one curve set; arrays that the set lacks are empty.
    struct Set {
        executor::Array<Vec3f> points, normal;
        executor::Array<std::uint64_t> first, spans;
        executor::Array<std::uint8_t> closed;
        executor::Array<float> radius, closing;
        executor::Array<std::uint32_t> color;
        executor::Array<double> length;
    };
    std::vector<Set> parts;
    executor::Array<CurveSetView> sets;
    executor::Array<std::uint64_t> first_span;
    FiberView view; ///< valid while this lives, moved or not
};

/// Copies what fibers are made of to where `exec` works.
/// @throws Error  OutOfMemory, Device
template <typename Exec>
[[nodiscard]] DeviceFibers upload_fibers(Exec& exec, const FiberSource& source) {
    using upload_detail::replace;
    DeviceFibers out;
    out.view = source.view();
    std::vector<CurveSetView> sets(out.view.sets, out.view.sets + out.view.set_count);
    for (CurveSetView& set : sets) {
        DeviceFibers::Set& part = out.parts.emplace_back();
        if (set.curve_count == 0) continue; // nothing of it is read
        const std::size_t curves = set.curve_count;
        const std::size_t points = set.first[curves];
        const std::size_t knots = set.spans[curves] + curves;
        replace(exec, part.points, set.points, points);
        replace(exec, part.radius, set.radius, points);
        replace(exec, part.color, set.color, points);
        replace(exec, part.closed, set.closed, curves);
        replace(exec, part.closing, set.closing, curves);
        replace(exec, part.length, set.length, knots);
        replace(exec, part.normal, set.normal, knots);
        replace(exec, part.first, set.first, curves + 1);
        replace(exec, part.spans, set.spans, curves + 1);
    }
    const CurveSetView* from = sets.data();
    replace(exec, out.sets, from, sets.size());
    out.view.sets = from;
    replace(exec, out.first_span, out.view.first_span, out.view.set_count + 1);
    exec.wait(); // `sets` is read until then
    return out;
}

} // namespace heddle
