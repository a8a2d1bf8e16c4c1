#pragma once

#include <heddle/scatter/approximate.h>

#include <algorithm>
#include <cmath>

namespace heddle::detail {

/// `x` moved by whole turns into [-pi, pi].
[[nodiscard]] inline float wrap_angle(float x) {
    return x - kTwoPi * round_to_whole(x * (1.0f / kTwoPi));
}

/// The logistic distribution, cut off at -pi and pi and repeated around the circle. Like a Gaussian
/// with deviation 1.8 scale, but its integral has a closed form.    [Chiang16]
class CircleLogistic {
public:
    /// @param scale  > 0, radians
    explicit CircleLogistic(float scale)
        : scale_(scale),
          inverse_(1.0f / scale),
          low_(raw(-kPi)),
          range_(1.0f - 2.0f * low_),
          inverse_range_(1.0f / range_) {}

    [[nodiscard]] float scale() const { return scale_; }

    /// The density at `x`, for any angle.
    [[nodiscard]] float density(float x) const {
        const float e = exp_approx(-std::fabs(wrap_angle(x)) * inverse_);
        return e * inverse_ * inverse_range_ / ((1.0f + e) * (1.0f + e));
    }
    /// The integral of the density from -pi to `x`; each further turn adds 1.
    [[nodiscard]] float cumulative(float x) const {
        const float turns = round_to_whole(x * (1.0f / kTwoPi));
        return turns + (raw(x - kTwoPi * turns) - low_) * inverse_range_;
    }
    /// @param u  uniform in [0, 1)
    /// @return   in [-pi, pi]
    [[nodiscard]] float sample(float u) const {
        const float c = low_ + u * range_;
        return std::min(kPi, std::max(-kPi, scale_ * std::log(c / (1.0f - c))));
    }

private:
    [[nodiscard]] float raw(float x) const { return 1.0f / (1.0f + exp_approx(-x * inverse_)); }

    float scale_, inverse_, low_, range_, inverse_range_;
};

} // namespace heddle::detail
