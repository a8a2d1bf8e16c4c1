#pragma once

#include <heddle/voxelize/fiber/gather_kernels.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace heddle {

/// Collects chords of single curves until there are enough to fill the lanes.
class ChordQueue {
public:
    static constexpr int kMax = 64;

    [[nodiscard]] bool full() const { return count_ == kMax; }
    void add(const Chord& chord, Vec3i anchor, std::uint32_t color) {
        const auto i = static_cast<std::size_t>(count_++);
        for (int a = 0; a < 3; ++a) {
            const auto axis = static_cast<std::size_t>(a);
            start_[axis][i] = chord.start[a];
            dir_[axis][i] = chord.dir[a];
            anchor_[axis][i] = anchor[a];
        }
        length_[i] = chord.length;
        before_[i] = chord.before;
        after_[i] = chord.after;
        radius_[i] = chord.radius;
        color_[i] = color;
    }
    void flush(const GatherTarget& target) {
        if (count_ == 0) return;
        std::fill(length_.begin() + count_, length_.end(), 0.0f);
        gather_thin({{start_[0].data(), start_[1].data(), start_[2].data()},
                     {dir_[0].data(), dir_[1].data(), dir_[2].data()},
                     {no_bend_.data(), no_bend_.data(), no_bend_.data()},
                     length_.data(),
                     before_.data(),
                     after_.data(),
                     radius_.data(),
                     {anchor_[0].data(), anchor_[1].data(), anchor_[2].data()},
                     color_.data(),
                     count_},
                    target);
        count_ = 0;
    }

private:
    std::array<std::array<float, kMax>, 3> start_{}, dir_{};
    std::array<float, kMax> no_bend_{};
    std::array<std::array<std::int32_t, kMax>, 3> anchor_{};
    std::array<float, kMax> length_{}, before_{}, after_{}, radius_{};
    std::array<std::uint32_t, kMax> color_{};
    int count_ = 0;
};

} // namespace heddle
