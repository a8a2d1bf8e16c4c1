#include <heddle/viewer/slice/sorted_slices.h>

#include <heddle/slice/slice_glsl.h>
#include <heddle/viewer/slice/view_glsl.h>

#include <algorithm>

namespace heddle::viewer {
namespace {

std::uint32_t most_slices(const std::vector<slice::SliceChunk>& chunks) {
    std::uint32_t most = 0;
    for (const slice::SliceChunk& c : chunks) most = std::max(most, c.count);
    return most;
}

} // namespace

SortedSlices::SortedSlices(std::vector<slice::SliceChunk> chunks)
    : chunks_(std::move(chunks)),
      capacity_(most_slices(chunks_)),
      sort_(capacity_),
      seen_("slices in view", capacity_ * sizeof(slice::PlacedSlice)),
      program_(opengl::Program::compute("see slices", slice::kSliceGlsl, kSeeGlsl)) {}

std::int64_t SortedSlices::slice_count() const {
    std::int64_t sum = 0;
    for (const slice::SliceChunk& c : chunks_) sum += c.count;
    return sum;
}

std::uint32_t
SortedSlices::see(std::size_t chunk, const ShaderCamera& eye, Vec3d middle, bool sorted) {
    const Last now{chunk, eye, middle, sorted};
    if (!last_ || !(*last_ == now)) {
        chunks_[chunk].slices.bind_storage(0);
        seen_.bind_storage(1);
        sort_.keys().bind_storage(2);
        sort_.values().bind_storage(3);
        program_.set("slice_count", chunks_[chunk].count);
        program_.set("capacity", capacity_);
        program_.set("right", to_float(eye.axes.right));
        program_.set("up", to_float(eye.axes.up));
        program_.set("away", to_float(eye.axes.away));
        program_.set("middle", to_float(middle));
        program_.set("shift", eye.seen(middle));
        program_.set("parallel", eye.parallel ? 1 : 0);
        program_.set("sorted", sorted ? 1 : 0);
        program_.dispatch(capacity_);
        sort_.sort(); // even if not sorted: segments come before other slices
        last_ = now;
    }
    seen_.bind_storage(0);
    sort_.values().bind_storage(2);
    return chunks_[chunk].segments;
}

} // namespace heddle::viewer
