#pragma once

#include <heddle/base/trig.h>
#include <heddle/executor/array.h>
#include <heddle/yarn/fiber_source.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// The fibers of all yarns of a geometry, one yarn after the other, with the columns of a
/// FiberTable.
/// @tparam Column  container of a column: a vector, an executor's array or a pointer
template <template <typename> class Column>
struct FiberColumns {
    Column<std::uint64_t> first{};       ///< first fiber of each yarn, and the end
    Column<std::uint64_t> yarn_of_set{}; ///< per set of curves: its first yarn
    Column<std::uint64_t> ply_of_set{};  ///< per set: its first ply
    Column<float> set_fiber_radius{};    ///< per set, model units
    Column<SinCos> ply{};                ///< base angles
    Column<float> radius{}, cos_angle{}, sin_angle{};
    Column<float> cos_migration{}, sin_migration{}, migration_turns{};
    Column<std::uint32_t> color{};
};

/// Calls f(column of a, column of b) for each pair of columns.
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

/// The tables on the host.
using HostFiberTables = FiberColumns<HostColumn>;
/// The tables in an executor's arrays.
using DeviceFiberTables = FiberColumns<executor::Array>;
/// The tables for ops, as pointers. It is uploaded as it is.
using FiberTablesView = FiberColumns<PointedColumn>;
static_assert(sizeof(FiberTablesView) == 96, "the same on host and device");

/// Places all fibers of a geometry, on the host since exp and pow differ between machines.
[[nodiscard]] HostFiberTables place_all_fibers(const FiberSource& source);

/// Uploads the tables.
/// @throws Error  OutOfMemory, Device
template <typename Exec>
[[nodiscard]] DeviceFiberTables upload_tables(Exec& exec, const HostFiberTables& placed) {
    exec.set_phase("upload of fibers");
    DeviceFiberTables out;
    for_each_column(placed, out,
                    [&](const auto& from, auto& to) { to = exec.make_from(std::span(from)); });
    return out;
}

/// Returns the tables as pointers, which are valid while `tables` lives.
[[nodiscard]] inline FiberTablesView view_of(const DeviceFiberTables& tables) {
    FiberTablesView out;
    for_each_column(tables, out, [](const auto& from, auto& to) { to = from.data(); });
    return out;
}

} // namespace heddle
