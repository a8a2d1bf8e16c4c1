#include <heddle/io/vdb/read_vdb.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/io/vdb/grid_name.h>
#include <heddle/io/vdb/grid_reader.h>
#include <heddle/io/vdb/info_json.h>
#include <heddle/io/vdb/vdb_format.h>
#include <heddle/sggx/pack.h>

#include <algorithm>
#include <cstring>
#include <tuple>

namespace heddle {
namespace {

using Leaf = GridLeaves::Leaf;

auto key(Vec3i v) {
    return std::tuple(v.x, v.y, v.z);
}

/// Reads the values of one leaf in step with the voxels of `coverage`.
class LeafCursor {
public:
    LeafCursor(const GridLeaves& grid, Vec3i origin) {
        const auto at =
            std::lower_bound(grid.leaves.begin(), grid.leaves.end(), origin,
                             [](const Leaf& leaf, Vec3i o) { return key(leaf.origin) < key(o); });
        if (at == grid.leaves.end() || !(at->origin == origin)) return;
        leaf_ = &*at;
        next_ = grid.values.data() + at->first * grid.value_bytes;
        value_bytes_ = grid.value_bytes;
    }
    [[nodiscard]] bool active(std::size_t x, int bit) const {
        return leaf_ != nullptr && ((leaf_->active[x] >> bit) & 1) != 0;
    }
    template <typename T>
    T take() {
        T value{};
        std::memcpy(&value, next_, sizeof(T));
        next_ += value_bytes_;
        return value;
    }

private:
    const Leaf* leaf_ = nullptr;
    const std::byte* next_ = nullptr;
    std::size_t value_bytes_ = 0;
};

/// The grids of one lobe; the last three are empty where the file has none.
struct LobeGrids {
    GridLeaves lobe, albedo, surface, aniso;
};

class Assembler {
public:
    Assembler(const std::string& path, const VdbContents& file) : path_(path), file_(file) {}

    std::unique_ptr<VoxelGrid> run() {
        check_format();
        auto grid = std::make_unique<VoxelGrid>();
        const auto text = [&](const char* name) { return file_.metadata.at(name); };
        grid->about = info_from_json({text(kInfoKey), text(kMaterialsKey), text(kYarnsKey)}, path_);
        info_ = &grid->about;
        read_grids(grid->about);
        make_blocks(*grid);
        count(grid->about, grid->blocks);
        return grid;
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::BadFile, what, "write it again with heddle", {.path = path_});
    }

    [[nodiscard]] const GridEntry* find(const std::string& name) const {
        const auto at = std::find_if(file_.grids.begin(), file_.grids.end(),
                                     [&](const GridEntry& e) { return e.name == name; });
        return at == file_.grids.end() ? nullptr : &*at;
    }
    [[nodiscard]] bool has(const std::string& name) const { return find(name) != nullptr; }

    void check_format() const {
        const auto& meta = file_.metadata;
        if (!meta.contains(kFormatKey)) {
            std::string list;
            for (const GridEntry& e : file_.grids) {
                list += str(list.empty() ? "" : ", ", "'", e.name, "' (", e.type, ")");
            }
            throw Error(
                ErrorCode::BadFile,
                str("a VDB that heddle did not write: it holds ", list.empty() ? "no grids" : list),
                "give a file made by 'heddle voxelize'", {.path = path_});
        }
        if (meta.at(kFormatKey) != std::to_string(kFormatVersion)) {
            throw Error(
                ErrorCode::Unsupported,
                str("format version ", meta.at(kFormatKey), " (allowed: ", kFormatVersion, ")"),
                "use the heddle that wrote it", {.path = path_});
        }
        for (const char* name : {kInfoKey, kMaterialsKey, kYarnsKey}) {
            if (!meta.contains(name)) fail(str("metadata '", name, "' is missing"));
        }
    }

    GridLeaves read(GridKind kind, std::size_t k, std::size_t value_bytes) const {
        const std::string name = grid_name(kind, static_cast<int>(k));
        const GridEntry* entry = find(name);
        if (entry == nullptr) fail(str("grid '", name, "' is missing"));
        GridLeaves grid = read_grid(path_, *entry);
        if (grid.value_bytes != value_bytes) {
            fail(str("grid '", name, "' has values of ", grid.value_bytes,
                     " bytes (needed: ", value_bytes, ")"));
        }
        return grid;
    }

    void read_grids(VoxelGridInfo& info) {
        info.fields.albedo = has(grid_name(GridKind::Albedo));
        info.fields.surface = has(grid_name(GridKind::Surface));
        info.fields.tangents = has(grid_name(GridKind::Aniso));
        coverage_ = read(GridKind::Coverage, 0, 8);
        for (std::size_t k = 0; k < 8 && has(grid_name(GridKind::Lobe, static_cast<int>(k))); ++k) {
            LobeGrids& of = lobes_.emplace_back();
            of.lobe = read(GridKind::Lobe, k, 8);
            if (info.fields.albedo) of.albedo = read(GridKind::Albedo, k, 4);
            if (info.fields.surface) of.surface = read(GridKind::Surface, k, 4);
            if (info.fields.tangents) of.aniso = read(GridKind::Aniso, k, 8);
            for (const GridLeaves* g : {&of.albedo, &of.surface, &of.aniso}) {
                if (g->value_bytes != 0 && g->size() != of.lobe.size()) {
                    fail(str("lobe ", k, " has grids of ", g->size(), " and ", of.lobe.size(),
                             " voxels (needed: the same)"));
                }
            }
            lobes_in_grids_ += of.lobe.size();
        }
        if (lobes_.empty() && coverage_.size() > 0) fail("grid 'lobe_0' is missing");
    }

    void make_blocks(VoxelGrid& grid) const {
        const auto cell = [](const Leaf& leaf) {
            return std::tuple(leaf.origin.x >> 6, leaf.origin.y >> 6, leaf.origin.z >> 6);
        };
        std::vector<std::size_t> order(coverage_.leaves.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return cell(coverage_.leaves[a]) < cell(coverage_.leaves[b]);
        });
        std::vector<std::size_t> first;
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (i == 0 ||
                cell(coverage_.leaves[order[i]]) != cell(coverage_.leaves[order[i - 1]])) {
                first.push_back(i);
            }
        }
        first.push_back(order.size());
        grid.blocks.resize(first.size() - 1);
        parallel_chunks(grid.blocks.size(), 1, [&](std::size_t b, std::size_t) {
            for (std::size_t i = first[b]; i < first[b + 1]; ++i) {
                add_leaf(grid.blocks[b], coverage_.leaves[order[i]]);
            }
        });
    }

    void add_leaf(VoxelBlock& block, const Leaf& leaf) const {
        block.leaves.push_back({leaf.origin, leaf.active,
                                static_cast<std::uint32_t>(block.coverage.size()),
                                static_cast<std::uint32_t>(block.lobes.size())});
        LeafCursor coverage(coverage_, leaf.origin);
        std::vector<std::array<LeafCursor, 4>> cursors;
        for (const LobeGrids& of : lobes_) {
            cursors.push_back({LeafCursor(of.lobe, leaf.origin), LeafCursor(of.albedo, leaf.origin),
                               LeafCursor(of.surface, leaf.origin),
                               LeafCursor(of.aniso, leaf.origin)});
        }
        for (std::size_t x = 0; x < 8; ++x) {
            for (std::uint64_t w = leaf.active[x]; w != 0; w &= w - 1) {
                const int bit = std::countr_zero(w);
                std::size_t n = 0;
                while (n < cursors.size() && cursors[n][0].active(x, bit)) {
                    add_lobe(block, cursors[n++], x, bit, leaf.origin);
                }
                if (n == 0) fail_at("has coverage and no lobe", x, bit, leaf.origin);
                block.coverage.push_back(coverage.take<Coverage>());
                block.lobe_count.push_back(static_cast<std::uint8_t>(n));
            }
        }
    }

    void add_lobe(VoxelBlock& block,
                  std::array<LeafCursor, 4>& cursor,
                  std::size_t x,
                  int bit,
                  Vec3i origin) const {
        const Lobe lobe = cursor[0].take<Lobe>();
        if (lobe.weight == 0) fail_at("has a lobe of weight 0 (allowed: 1 to 255)", x, bit, origin);
        if (lobe.material >= info_->materials.size()) {
            fail_at(str("names material ", int{lobe.material}, " of ", info_->materials.size()), x,
                    bit, origin);
        }
        if (!is_positive_definite(lobe.sggx)) {
            fail_at("has a lobe that is not positive definite", x, bit, origin);
        }
        block.lobes.push_back(lobe);
        const VoxelGridFields& fields = info_->fields;
        LobeMaps maps;
        const std::array<bool, 4> has{true, fields.albedo, fields.surface, fields.tangents};
        for (std::size_t i = 1; i < 4; ++i) {
            if (has[i] && !cursor[i].active(x, bit)) {
                fail_at("has a lobe without its albedo, surface or aniso value", x, bit, origin);
            }
        }
        if (fields.albedo) maps.albedo = cursor[1].take<std::array<std::uint8_t, 3>>();
        if (fields.surface) {
            const auto bytes = cursor[2].take<std::array<std::uint8_t, 3>>();
            maps.roughness = bytes[0];
            maps.metalness = bytes[1];
            maps.anisotropy = bytes[2];
        }
        if (fields.albedo || fields.surface) block.maps.push_back(maps);
        if (fields.tangents) block.tangents.push_back(cursor[3].take<PackedSggx>());
    }

    [[noreturn]] void fail_at(const std::string& what, std::size_t x, int bit, Vec3i origin) const {
        fail(str("voxel (", origin.x + static_cast<int>(x), ", ", origin.y + (bit >> 3), ", ",
                 origin.z + (bit & 7), ") ", what));
    }

    void count(const VoxelGridInfo& info, const std::vector<VoxelBlock>& blocks) const {
        std::int64_t voxels = 0, lobes = 0;
        for (const VoxelBlock& b : blocks) {
            voxels += static_cast<std::int64_t>(b.coverage.size());
            lobes += static_cast<std::int64_t>(b.lobes.size());
        }
        if (static_cast<std::size_t>(lobes) != lobes_in_grids_) {
            fail(str(lobes_in_grids_, " lobes, of which ", lobes, " belong to voxels"));
        }
        if (voxels != info.voxel_count || lobes != info.lobe_count) {
            fail(str("holds ", voxels, " voxels and ", lobes, " lobes, its metadata says ",
                     info.voxel_count, " and ", info.lobe_count));
        }
    }

    const std::string& path_;
    const VdbContents& file_;
    const VoxelGridInfo* info_ = nullptr;
    GridLeaves coverage_;
    std::vector<LobeGrids> lobes_;
    std::size_t lobes_in_grids_ = 0;
};

} // namespace

std::unique_ptr<VoxelGrid> read_vdb(const std::string& path) {
    const VdbContents file = read_contents(path);
    return Assembler(path, file).run();
}

} // namespace heddle
