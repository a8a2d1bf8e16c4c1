#pragma once

#include <heddle/base/trig.h>
#include <heddle/executor/array.h>
#include <heddle/yarn/fiber_source.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// The fibers of all yarns of a geometry, one after the other, as FiberTable has them of one.
/// @tparam Column  what holds the numbers of one kind: a vector, an executor's array, a pointer
template <template <typename> class Column>
struct FiberColumns {
    Column<std::uint64_t> first{};       ///< per yarn, and the end: its first fiber
    Column<std::uint64_t> yarn_of_set{}; ///< per set of curves: its first yarn
    Column<std::uint64_t> ply_of_set{};  ///< per set: its first ply
    Column<float> set_fiber_radius{};    ///< per set, model units
    Column<SinCos> ply{};                ///< base angles
    Column<float> radius{}, cos_angle{}, sin_angle{};
    Column<float> cos_migration{}, sin_migration{}, migration_turns{};
    Column<std::uint32_t> color{};
};

/// Calls f(column of a, column of b) for each column.
template <typename A, typename B, typename F>
void for_each_column(A& a, B& b, const F& f) {
    f(a.first, b.first);
    f(a.yarn_of_set, b.yarn_of_set);
    f(a.ply_of_set, b.ply_of_set);
    f(a.set_fiber_radius, b.set_fiber_radius);
    f(a.ply, b.ply);
    f(a.radius, b.radius);
    f(a.cos_angle, b.cos_angle);
    f(a.sin_angle, b.sin_angle);
    f(a.cos_migration, b.cos_migration);
    f(a.sin_migration, b.sin_migration);
    f(a.migration_turns, b.migration_turns);
    f(a.color, b.color);
}

template <typename T>
using HostColumn = std::vector<T>;
template <typename T>
using PointedColumn = const T*;

/// On the host.
using HostFiberTables = FiberColumns<HostColumn>;
/// Where an executor works.
using DeviceFiberTables = FiberColumns<executor::Array>;
/// What ops read; crosses to the device as it lies.
using FiberTablesView = FiberColumns<PointedColumn>;
static_assert(sizeof(FiberTablesView) == 96, "the same on host and device");

/// Places all fibers of a geometry: on the host, since exp and pow differ between machines.
[[nodiscard]] HostFiberTables place_all_fibers(const FiberSource& source);

/// @throws Error  OutOfMemory, Device
template <typename Exec>
[[nodiscard]] DeviceFiberTables upload_tables(Exec& exec, const HostFiberTables& placed) {
    exec.set_phase("upload of fibers");
    DeviceFiberTables out;
    for_each_column(placed, out,
                    [&](const auto& from, auto& to) { to = exec.make_from(std::span(from)); });
    return out;
}

/// Valid while `tables` lives.
[[nodiscard]] inline FiberTablesView view_of(const DeviceFiberTables& tables) {
    FiberTablesView out;
    for_each_column(tables, out, [](const auto& from, auto& to) { to = from.data(); });
    return out;
}

} // namespace heddle
