#pragma once

#include <heddle/base/vec.h>

#include <cstdint>
#include <limits>

namespace heddle {

/// The fiber of a volume that a ray leaves, and what is known of the way on which light came to it.
struct FiberStart {
    float radius = 0.0f; ///< scene units; 0: the ray does not leave a fiber, or it is unknown
    float cosine = 0.0f; ///< between the ray and the way back
    float free = 0.0f;   ///< length of the way back that is known to be free, scene units
};

class VolumeInstance;

/// The sheet of a voxel on which a ray starts (sheet_law.h).
struct SheetStart {
    const VolumeInstance* volume = nullptr; ///< null: the ray starts elsewhere
    int level = 0;
    std::int64_t voxel = 0; ///< number in the level's arrays
    int side = 0;           ///< 1: starts above the sheet; -1: below
};

/// A ray with the width of its footprint.
struct Ray {
    Vec3d origin;                                         ///< scene units
    Vec3f direction;                                      ///< unit
    float t_max = std::numeric_limits<float>::infinity(); ///< scene units
    float width = 0.0f;                                   ///< of the footprint at the origin
    float spread = 0.0f;                                  ///< growth of the width per unit of t
    float clear = 0.0f; ///< volumes are ignored for t < clear (self-shadowing)
    FiberStart from_fiber{};
    float sheet = 0.5f; ///< where in their slabs the sheets are that the ray meets, 0 to 1
    SheetStart from_sheet{};

    [[nodiscard]] Vec3d at(double t) const { return origin + to_double(direction) * t; }
    [[nodiscard]] float width_at(float t) const { return width + spread * t; }
};

} // namespace heddle
