#pragma once

#include <heddle/opengl/buffer.h>
#include <heddle/opengl/shader.h>
#include <heddle/slice/slices.h>
#include <heddle/viewer/shader_camera.h>
#include <heddle/viewer/slice/radix_sort.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace heddle::viewer {

/// Bytes in the driver's memory per slice of the largest chunk: in view, with its key and number.
constexpr std::int64_t kSortedSliceBytes = 64 + 4 * 4 + 1;

/// Placed slices in the axes of an eye, one chunk at a time, as one buffer of the driver holds it.
class SortedSlices {
public:
    /// @param chunks  at least one
    /// @throws Error  OutOfMemory
    explicit SortedSlices(std::vector<slice::SliceChunk> chunks);

    [[nodiscard]] std::size_t chunk_count() const { return chunks_.size(); }
    [[nodiscard]] std::int64_t slice_count() const;

    /// Rotates a chunk's slices into the axes of an eye, numbers its segments and optionally sorts
    /// them from the farthest to the nearest. Draws then find slices at storage binding 0 and
    /// numbers at binding 2. If the last call was the same, nothing is done.
    /// @param middle  units: a point near the visible objects
    /// @return        number of segments, which are the first of the numbers
    [[nodiscard]] std::uint32_t
    see(std::size_t chunk, const ShaderCamera& eye, Vec3d middle, bool sorted);

private:
    std::vector<slice::SliceChunk> chunks_;
    std::uint32_t capacity_; ///< slices of the largest chunk
    RadixSort sort_;
    opengl::Buffer seen_;
    opengl::Program program_;
    struct Last {
        std::size_t chunk;
        ShaderCamera eye;
        Vec3d middle;
        bool sorted;
        bool operator==(const Last&) const = default;
    };
    std::optional<Last> last_;
};

} // namespace heddle::viewer
