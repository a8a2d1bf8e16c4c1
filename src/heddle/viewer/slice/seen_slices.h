#pragma once

#include <heddle/opengl/buffer.h>
#include <heddle/opengl/shader.h>
#include <heddle/slice/slices.h>
#include <heddle/viewer/eye_frame.h>
#include <heddle/viewer/slice/radix_sort.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace heddle::viewer {

/// Bytes in the driver's memory for each slice of the largest chunk: in view, its keys and numbers.
constexpr std::int64_t kSeenBytes = 64 + 4 * 4 + 1;

/// Placed slices, and how they look from an eye: a chunk at a time, as one buffer of the driver
/// holds it.
class SeenSlices {
public:
    /// @param chunks  one at least
    /// @throws Error  OutOfMemory
    explicit SeenSlices(std::vector<slice::SliceChunk> chunks);

    [[nodiscard]] std::size_t chunk_count() const { return chunks_.size(); }
    [[nodiscard]] std::int64_t slice_count() const;

    /// Turns a chunk's slices into an eye's axes, numbers its slabs and, if asked to, sorts them
    /// from the farthest to the nearest. Then what draws them finds slices at storage binding 0 and
    /// numbers at binding 2.
    /// @param middle  units: a place near to what is seen
    /// What was seen last is not done again.
    /// @return        slabs, the first of the numbers
    [[nodiscard]] std::uint32_t
    see(std::size_t chunk, const EyeFrame& eye, Vec3d middle, bool sorted);

private:
    std::vector<slice::SliceChunk> chunks_;
    std::uint32_t capacity_; ///< slices of the largest chunk
    RadixSort sort_;
    opengl::Buffer seen_;
    opengl::Program program_;
    struct Last {
        std::size_t chunk;
        EyeFrame eye;
        Vec3d middle;
        bool sorted;
        bool operator==(const Last&) const = default;
    };
    std::optional<Last> last_;
};

} // namespace heddle::viewer
