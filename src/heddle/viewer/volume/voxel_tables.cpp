#include <heddle/viewer/volume/voxel_tables.h>

#include <heddle/base/error.h>
#include <heddle/preview/preview_volume.h>
#include <heddle/voxel/index_box.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

namespace heddle::viewer {
namespace {

using Table = preview::PreviewVolume::Table;

constexpr std::uint32_t kFirstStorage = 8;
constexpr std::uint32_t kLevelsUniform = 8;
constexpr std::size_t kBatchWords = 1 << 18; ///< words that are written at once

/// How often the edges of a level double those of the finest.
int doublings(Vec3d finest, Vec3d edges) {
    const int out = static_cast<int>(std::lround(std::log2(edges.x / finest.x)));
    for (int a = 0; a < 3; ++a) {
        if (std::fabs(std::ldexp(finest[a], out) / edges[a] - 1.0) > 1e-6) return -1;
    }
    return out;
}

void check_levels(std::span<const VoxelLevel* const> levels) {
    if (levels.size() > static_cast<std::size_t>(kMaxVoxelLevels)) {
        throw Error(
            ErrorCode::InvalidArgument,
            str("view: ", levels.size(), " levels of voxels (allowed: ", kMaxVoxelLevels, ")"),
            "give fewer of them");
    }
    for (std::size_t i = 0, last = 0; i < levels.size(); ++i) {
        const int now =
            doublings(levels[0]->info().lattice.voxel_size, levels[i]->info().lattice.voxel_size);
        if (i == 0 || now > static_cast<int>(last)) {
            last = static_cast<std::size_t>(now);
            continue;
        }
        throw Error(ErrorCode::InvalidArgument,
                    str("view: voxels of level ", i, " are ",
                        levels[i]->info().lattice.voxel_size.x, " wide, of the finest ",
                        levels[0]->info().lattice.voxel_size.x,
                        ": edges must double from level to level"),
                    "give levels of one object, finest first");
    }
}

void check_bindings() {
    GLint storage = 0;
    GLint blocks = 0;
    glGetIntegerv(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, &storage);
    glGetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &blocks);
    if (storage >= 15 && blocks >= 7) return;
    throw Error(ErrorCode::Device,
                str("opengl: the driver has ", blocks, " storage blocks in fragment shaders at ",
                    storage, " bindings; 7 at 15 are needed to show voxels"),
                "use another driver, or heddle preview");
}

/// Writes words to a buffer in sequence.
class Words {
public:
    explicit Words(const opengl::Buffer& to) : to_(to) {}

    void push(std::uint32_t word) {
        batch_.push_back(word);
        if (batch_.size() == kBatchWords) flush();
    }
    void flush() {
        to_.write(std::as_bytes(std::span(batch_)), at_);
        at_ += batch_.size() * 4;
        batch_.clear();
    }
    [[nodiscard]] std::uint32_t count() const {
        return static_cast<std::uint32_t>(at_ / 4 + batch_.size());
    }

private:
    const opengl::Buffer& to_;
    std::size_t at_ = 0; ///< bytes
    std::vector<std::uint32_t> batch_;
};

/// The tiles of a table, which shaders call cells, in their bounding box.
struct CellBox {
    Vec3i lo;                         ///< index of the first cell
    Vec3i size;                       ///< number of cells
    std::vector<std::uint32_t> tiles; ///< numbers of the tiles, z fastest; kNone for an empty cell

    explicit CellBox(const Table& table) {
        IndexBox box;
        for (const Vec3i& tile : table.tiles()) box.grow(tile);
        lo = box.lo;
        size = box.hi - box.lo + Vec3i{1, 1, 1};
        const auto wide = [](std::int32_t n) { return static_cast<std::size_t>(n); };
        tiles.assign(wide(size.x) * wide(size.y) * wide(size.z), Table::kNone);
        for (std::uint32_t t = 0; t < table.tiles().size(); ++t) {
            const Vec3i at = table.tiles()[t] - lo;
            tiles[(wide(at.x) * wide(size.y) + wide(at.y)) * wide(size.z) + wide(at.z)] = t;
        }
    }
};

/// Writes tables in sequence; all numbers in them count from the first table.
struct Writer {
    std::array<Words, 6> to; ///< cells, leaf table, leaves, words of voxels

    void write(const preview::PreviewVolume& scene, const CellBox& cells) {
        const auto first_cell = static_cast<std::uint32_t>(to[1].count() / Table::kTileLeaves);
        const auto first_leaf = static_cast<std::uint32_t>(to[2].count() / kLeafWords);
        for (const std::uint32_t tile : cells.tiles)
            to[0].push(tile == Table::kNone ? tile : tile + first_cell);
        for (const std::uint32_t leaf : scene.table().leaves_by_tile())
            to[1].push(leaf == Table::kNone ? 0 : leaf + 1 + first_leaf);
        std::vector<std::uint32_t> first; // first voxel of each block
        std::uint32_t count = to[3].count();
        for (const std::vector<preview::PreviewVoxel>& block : scene.voxels_by_block()) {
            first.push_back(count);
            count += static_cast<std::uint32_t>(block.size());
            for (const preview::PreviewVoxel& v : block) push(v);
        }
        for (const preview::PreviewLeaf& leaf : scene.leaves())
            push(leaf, first[leaf.block] + leaf.first);
    }
    void push(const preview::PreviewVoxel& voxel) {
        std::array<std::uint32_t, 3> words{};
        std::memcpy(words.data(), &voxel, sizeof(voxel));
        for (std::size_t i = 0; i < 3; ++i) to[3 + i].push(words[i]);
    }
    void push(const preview::PreviewLeaf& leaf, std::uint32_t first) {
        for (const std::uint64_t word : leaf.mask.active) {
            to[2].push(static_cast<std::uint32_t>(word));
            to[2].push(static_cast<std::uint32_t>(word >> 32));
        }
        for (std::size_t x = 0; x < 8; x += 2) {
            to[2].push(leaf.mask.before[x] | static_cast<std::uint32_t>(leaf.mask.before[x + 1])
                                                 << 16);
        }
        to[2].push(first);
    }
};

} // namespace

std::vector<const VoxelLevel*> sources_of(const VoxelLevels& levels) {
    std::vector<const VoxelLevel*> out;
    for (const auto& level : levels) out.push_back(level.get());
    return out;
}

/// As in kVoxelTableGlsl.
struct VoxelTables::LevelTable {
    std::array<float, 4> per{};           ///< voxels per scene unit; longest edge
    std::array<float, 4> shift{};         ///< the middle from the corner, voxels; shortest edge
    std::array<std::int32_t, 4> corner{}; ///< first voxel index of the table; doublings
    std::array<std::int32_t, 4> cells{};  ///< of the table; index of the first in the list of all
    std::array<std::int32_t, 4> lo{};     ///< first leaf, relative to the corner
    std::array<std::int32_t, 4> hi{-1, -1, -1, 0}; ///< last leaf, inclusive
};

VoxelTables::VoxelTables(const opengl::Context& context,
                         std::span<const VoxelLevel* const> levels,
                         std::int64_t storage_bytes,
                         Progress& progress) {
    check_levels(levels);
    check_bindings();
    if (!levels.empty()) voxel_size_ = levels[0]->info().lattice.voxel_size;
    const std::int64_t most = context.limits().storage_bytes;
    plan(levels, storage_bytes > 0 ? std::min(storage_bytes, most) : most, progress);
    fill(levels, progress);
}

void VoxelTables::plan(std::span<const VoxelLevel* const> levels,
                       std::int64_t most,
                       Progress& progress) {
    std::size_t total = 0;
    for (const VoxelLevel* level : levels) total += level->block_count();
    progress.begin("measure", "blocks", static_cast<std::int64_t>(total));
    std::vector<Bounds> bounds;
    for (const VoxelLevel* level : levels) {
        VoxelMeasure found = measure_voxels(*level, progress);
        if (bytes_.empty()) blocks_ = std::move(found.blocks);
        bytes_.push_back(found.bytes);
        bounds.push_back(found.bounds);
    }
    VoxelTableBytes sum;
    first_ = level_count();
    while (first_ > 0) {
        const auto next = static_cast<std::size_t>(first_ - 1);
        sum += bytes_[next];
        if (sum.largest() > most) break;
        bounds_.grow(bounds[next]);
        finest_bounds_ = bounds[next];
        --first_;
    }
    if (first_ < level_count() || bytes_.empty()) return;
    throw Error(ErrorCode::OutOfMemory,
                str("opengl: the coarsest of ", bytes_.size(), " levels of voxels takes ",
                    bytes_.back().largest(), " bytes in one storage block (allowed: ", most, ")"),
                "use larger voxels, or build coarser levels too");
}

void VoxelTables::fill(std::span<const VoxelLevel* const> levels, Progress& progress) {
    VoxelTableBytes sum;
    for (auto i = static_cast<std::size_t>(first_); i < bytes_.size(); ++i) sum += bytes_[i];
    const auto add = [&](const char* name, std::int64_t bytes) {
        buffers_.emplace_back(name, static_cast<std::size_t>(bytes));
    };
    add("cells of voxels", sum.cells);
    add("tables of leaves", sum.leaf_table);
    add("leaves of voxels", sum.leaves);
    for (int i = 0; i < 3; ++i) add("voxels", sum.voxels);
    const auto words = [&](std::size_t i) { return Words(buffers_[i]); };
    Writer writer{{words(0), words(1), words(2), words(3), words(4), words(5)}};
    std::vector<LevelTable> about(levels.size());
    for (auto i = static_cast<std::size_t>(first_); i < levels.size(); ++i) {
        const preview::PreviewVolume scene(*levels[i], false, progress);
        if (scene.empty()) continue;
        const CellBox cells(scene.table());
        const Vec3i corner = cells.lo * Table::kTileVoxels;
        const Vec3i leaf{corner.x >> 3, corner.y >> 3, corner.z >> 3};
        const Vec3i lo = scene.lo() - leaf, hi = scene.hi() - leaf;
        about[i].corner = {corner.x, corner.y, corner.z, 0};
        about[i].cells = {cells.size.x, cells.size.y, cells.size.z,
                          static_cast<std::int32_t>(writer.to[0].count())};
        about[i].lo = {lo.x, lo.y, lo.z, 0};
        about[i].hi = {hi.x, hi.y, hi.z, 0};
        writer.write(scene, cells);
    }
    for (Words& to : writer.to) to.flush();
    for (std::size_t i = 0; i < levels.size(); ++i) { // all have edges, even those that do not fit
        const Vec3d h = levels[i]->info().lattice.voxel_size;
        about[i].per[3] = static_cast<float>(std::max({h.x, h.y, h.z}));
        about[i].shift[3] = static_cast<float>(std::min({h.x, h.y, h.z}));
        about[i].corner[3] = doublings(voxel_size_, h);
    }
    write_levels(about);
}

void VoxelTables::write_levels(std::vector<LevelTable>& levels) {
    // rounded as in the shader: then only the distance of a point from it is rounded
    const Bounds& box = finest_bounds_;
    if (!box.empty()) middle_ = to_double(to_float((box.lo + box.hi) * 0.5));
    for (LevelTable& level : levels) {
        const Vec3d h = voxel_size_ * std::ldexp(1.0, level.corner[3]);
        for (int a = 0; a < 3; ++a) {
            const auto at = static_cast<std::size_t>(a);
            level.per[at] = static_cast<float>(1.0 / h[a]);
            level.shift[at] = static_cast<float>(middle_[a] / h[a] - level.corner[at]);
        }
    }
    levels.resize(kMaxVoxelLevels);
    const Vec3f middle = to_float(middle_);
    struct {
        std::array<float, 4> middle;
        std::array<std::int32_t, 4> range;
    } const head{{middle.x, middle.y, middle.z, 0.0f},
                 {first_, std::max(level_count() - 1, 0), 0, 0}};
    const opengl::Buffer& to = buffers_.emplace_back(
        "levels of voxels", sizeof(head) + kMaxVoxelLevels * sizeof(LevelTable));
    to.write(std::as_bytes(std::span(&head, 1)));
    to.write(std::as_bytes(std::span(levels)), sizeof(head));
}

void VoxelTables::bind() const {
    for (std::uint32_t i = 0; i < 6; ++i) buffers_[i].bind_storage(kFirstStorage + i);
    buffers_[6].bind_uniform(kLevelsUniform);
}

Vec3d VoxelTables::block_size() const {
    return voxel_size_ * static_cast<double>(1 << kBlockShift);
}

} // namespace heddle::viewer
