#pragma once

#include <heddle/base/trig.h>
#include <heddle/executor/array.h>
#include <heddle/yarn/fiber_source.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// The fibers of all yarns of a geometry, one after the other, as FiberTable has them of one. Crosses to
/// the device as it lies.
struct FiberTablesView {
    const std::uint64_t* first = nullptr;       ///< per yarn, and the end: its first fiber
    const std::uint64_t* yarn_of_set = nullptr; ///< per set of curves: its first yarn
    const std::uint64_t* ply_of_set = nullptr;  ///< per set: its first ply
    const float* set_fiber_radius = nullptr;    ///< per set, model units
    const SinCos* ply = nullptr;                ///< base angles
    const float* radius = nullptr;
    const float* cos_angle = nullptr;
    const float* sin_angle = nullptr;
    const float* cos_migration = nullptr;
    const float* sin_migration = nullptr;
    const float* migration_turns = nullptr;
    const std::uint32_t* color = nullptr;
};
static_assert(sizeof(FiberTablesView) == 96, "the same on host and device");

/// The same, where an executor works.
struct FiberTables {
    executor::Array<std::uint64_t> first, yarn_of_set, ply_of_set;
    executor::Array<float> set_fiber_radius;
    executor::Array<SinCos> ply;
    executor::Array<float> radius, cos_angle, sin_angle, cos_migration, sin_migration,
        migration_turns;
    executor::Array<std::uint32_t> color;

    [[nodiscard]] FiberTablesView view() const {
        return {first.data(),
                yarn_of_set.data(),
                ply_of_set.data(),
                set_fiber_radius.data(),
                ply.data(),
                radius.data(),
                cos_angle.data(),
                sin_angle.data(),
                cos_migration.data(),
                sin_migration.data(),
                migration_turns.data(),
                color.data()};
    }
};

/// Host side of FiberTables: fibers are placed here, since exp and pow differ between machines.
class PlacedFibers {
public:
    explicit PlacedFibers(const FiberSource& source);

    /// Bytes that upload() takes.
    [[nodiscard]] std::int64_t byte_count() const;

    template <typename Exec>
    [[nodiscard]] FiberTables upload(Exec& exec) const {
        exec.set_stage("upload of fibers");
        const auto up = [&](const auto& v) { return exec.make_from(std::span(v)); };
        return {up(first_),         up(yarn_of_set_),   up(ply_of_set_),      up(set_fiber_radius_),
                up(ply_),           up(radius_),        up(cos_angle_),       up(sin_angle_),
                up(cos_migration_), up(sin_migration_), up(migration_turns_), up(color_)};
    }

private:
    void append(const FiberTable& table);

    std::vector<std::uint64_t> first_{0}, yarn_of_set_, ply_of_set_;
    std::vector<float> set_fiber_radius_;
    std::vector<SinCos> ply_;
    std::vector<float> radius_, cos_angle_, sin_angle_, cos_migration_, sin_migration_,
        migration_turns_;
    std::vector<std::uint32_t> color_;
};

} // namespace heddle
