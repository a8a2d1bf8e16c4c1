#pragma once

#include <heddle/device/upload_array.h>
#include <heddle/executor/array.h>
#include <heddle/yarn/fiber_source.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heddle {

/// A FiberView for an executor, and the arrays that it points to.
struct DeviceFibers {
    /// The arrays of one curve set; those that the set does not have are empty.
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
    FiberView view; ///< valid while this lives, even if it is moved
};

/// Uploads the curves of the fibers to arrays of `exec`.
/// @throws Error  OutOfMemory, Device
template <typename Exec>
[[nodiscard]] DeviceFibers upload_fibers(Exec& exec, const FiberSource& source) {
    using upload_detail::replace;
    DeviceFibers out;
    out.view = source.view();
    std::vector<CurveSetView> sets(out.view.sets, out.view.sets + out.view.set_count);
    for (CurveSetView& set : sets) {
        DeviceFibers::Set& part = out.parts.emplace_back();
        if (set.curve_count == 0) continue; // it is never read
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
    exec.wait(); // `sets` must live until it is copied
    return out;
}

} // namespace heddle
