#include <heddle/device/fiber_tables.h>

#include <heddle/base/parallel.h>

namespace heddle {
namespace {

void append(const FiberTable& table, HostFiberTables& out) {
    const auto count = static_cast<std::ptrdiff_t>(table.size());
    const auto add = [&](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.begin() + count);
    };
    add(out.radius, table.radius);
    add(out.cos_angle, table.cos_angle);
    add(out.sin_angle, table.sin_angle);
    add(out.cos_migration, table.cos_migration);
    add(out.sin_migration, table.sin_migration);
    add(out.migration_turns, table.migration_turns);
    add(out.color, table.color);
    out.first.push_back(out.first.back() + table.size());
}

} // namespace

HostFiberTables place_all_fibers(const FiberSource& source) {
    const std::vector<CurveSet>& sets = source.geometry().curves;
    HostFiberTables out;
    out.first.push_back(0);
    for (std::uint32_t s = 0; s < sets.size(); ++s) {
        out.yarn_of_set.push_back(out.first.size() - 1);
        out.ply_of_set.push_back(out.ply.size());
        out.set_fiber_radius.push_back(0.0f);
        const YarnType* yarn = source.yarn_of(s);
        if (yarn == nullptr || yarn->model == YarnModel::Solid) continue;
        std::vector<FiberTable> tables(sets[s].curve_count());
        parallel_chunks(tables.size(), 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                tables[c] = place_fibers(*yarn, source.seed() + s, c);
            }
        });
        for (const FiberTable& t : tables) append(t, out);
        if (tables.empty()) continue;
        out.set_fiber_radius.back() = tables[0].fiber_radius;
        for (std::size_t p = 0; p < tables[0].ply_cos.size(); ++p) {
            out.ply.push_back({tables[0].ply_sin[p], tables[0].ply_cos[p]});
        }
    }
    return out;
}

} // namespace heddle
