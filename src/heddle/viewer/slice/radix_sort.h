#pragma once

#include <heddle/opengl/buffer.h>
#include <heddle/opengl/shader.h>

#include <cstdint>

namespace heddle::viewer {

/// Sorts 32-bit keys with their numbers in compute shaders, four bits per pass; stable. Needs a
/// current Context while it lives.                                             [LopezMoreno17, 4.1]
class RadixSort {
public:
    /// @param count  number of keys, at least 1
    /// @throws Error  OutOfMemory
    explicit RadixSort(std::uint32_t count);

    /// The buffers into which the caller's shader writes `count` keys and their numbers.
    [[nodiscard]] const opengl::Buffer& keys() const { return keys_[0]; }
    [[nodiscard]] const opengl::Buffer& values() const { return values_[0]; }

    /// Sorts them in place, ascending. Uses storage bindings 0 to 5. Does not wait.
    void sort() const;

private:
    void scan() const;

    std::uint32_t count_;
    std::uint32_t tiles_;
    std::uint32_t entries_; ///< number of counts: 16 digits per tile
    opengl::Buffer keys_[2];
    opengl::Buffer values_[2];
    opengl::Buffer counts_;
    opengl::Buffer sums_;
    opengl::Program count_program_;
    opengl::Program sum_program_;
    opengl::Program top_program_;
    opengl::Program add_program_;
    opengl::Program scatter_program_;
};

} // namespace heddle::viewer
