#include <heddle/device/fiber_tables.h>

#include <heddle/base/parallel.h>

namespace heddle {

PlacedFibers::PlacedFibers(const FiberSource& source) {
    const std::vector<CurveSet>& sets = source.geometry().curves;
    for (std::uint32_t s = 0; s < sets.size(); ++s) {
        yarn_of_set_.push_back(first_.size() - 1);
        ply_of_set_.push_back(ply_.size());
        set_fiber_radius_.push_back(0.0f);
        const YarnType* yarn = source.yarn_of(s);
        if (yarn == nullptr || yarn->model == YarnModel::Solid) continue;
        std::vector<FiberTable> tables(sets[s].curve_count());
        parallel_chunks(tables.size(), 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                tables[c] = place_fibers(*yarn, source.seed() + s, c);
            }
        });
        for (const FiberTable& t : tables) append(t);
        if (tables.empty()) continue;
        set_fiber_radius_.back() = tables[0].fiber_radius;
        for (std::size_t p = 0; p < tables[0].ply_cos.size(); ++p) {
            ply_.push_back({tables[0].ply_sin[p], tables[0].ply_cos[p]});
        }
    }
}

void PlacedFibers::append(const FiberTable& table) {
    const auto count = static_cast<std::ptrdiff_t>(table.size());
    const auto add = [&](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.begin() + count);
    };
    add(radius_, table.radius);
    add(cos_angle_, table.cos_angle);
    add(sin_angle_, table.sin_angle);
    add(cos_migration_, table.cos_migration);
    add(sin_migration_, table.sin_migration);
    add(migration_turns_, table.migration_turns);
    add(color_, table.color);
    first_.push_back(first_.back() + table.size());
}

std::int64_t PlacedFibers::byte_count() const {
    const std::size_t bytes = (first_.size() + yarn_of_set_.size() + ply_of_set_.size()) * 8 +
                              set_fiber_radius_.size() * 4 + ply_.size() * sizeof(SinCos) +
                              radius_.size() * 7 * 4;
    return static_cast<std::int64_t>(bytes);
}

} // namespace heddle
