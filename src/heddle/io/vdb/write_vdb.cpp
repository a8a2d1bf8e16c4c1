#include <heddle/io/vdb/write_vdb.h>

#include <heddle/io/file/output_file.h>
#include <heddle/io/vdb/grid_writer.h>
#include <heddle/io/vdb/info_json.h>
#include <heddle/io/vdb/level_grids.h>
#include <heddle/io/vdb/vdb_format.h>

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>

#include <cerrno>
#include <fstream>
#include <sstream>

namespace heddle {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{4} << 20;

/// Scale by the voxel size, then move by half a voxel: an index is the voxel's centre. OpenVDB's
/// map constructors reject voxel sizes below 1e-5, which patterns in metres have: so deserialize.
openvdb::math::Transform::Ptr make_transform(const Lattice& lattice) {
    using namespace openvdb::math;
    const openvdb::Vec3d h(lattice.voxel_size.x, lattice.voxel_size.y, lattice.voxel_size.z);
    const openvdb::Vec3d inverse = 1.0 / h;
    const bool cubic = h.x() == h.y() && h.x() == h.z();
    std::stringstream bytes;
    openvdb::io::setCurrentVersion(bytes);
    openvdb::writeString(bytes, cubic ? UniformScaleTranslateMap::mapType()
                                      : ScaleTranslateMap::mapType());
    for (const openvdb::Vec3d& v : {0.5 * h, h, h, inverse, inverse * inverse, 0.5 * inverse}) {
        v.write(bytes);
    }
    auto transform = std::make_shared<Transform>();
    transform->read(bytes);
    return transform;
}

openvdb::Vec3i to_vdb(Vec3i v) {
    return {v.x, v.y, v.z};
}

using HalfDirection = std::array<openvdb::math::half, 3>;

/// The standard tree that stores values of a type: its name in a file and the size of its values.
/// OpenVDB's own grids are never created: their templates alone took a minute to compile.
struct TreeType {
    const char* name;
    std::size_t value_bytes;
};
template <typename Stored>
constexpr TreeType kTreeOf{};
template <>
constexpr TreeType kTreeOf<float>{"Tree_float_5_4_3", 4};
template <>
constexpr TreeType kTreeOf<HalfDirection>{"Tree_vec3s_5_4_3", 12};
template <>
constexpr TreeType kTreeOf<std::int32_t>{"Tree_int32_5_4_3", 4};
template <>
constexpr TreeType kTreeOf<std::int64_t>{"Tree_int64_5_4_3", 8};

/// DirectionValues as half floats: half the bytes, and still finer than the eight bits of a lobe.
struct HalfDirectionValues : DirectionValues {
    using DirectionValues::DirectionValues;
    using Value = HalfDirection;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t l) const {
        const Vec3f d = DirectionValues::value(b, v, l);
        return {openvdb::math::half(d.x), openvdb::math::half(d.y), openvdb::math::half(d.z)};
    }
};

/// A level to write, and its leaves.
struct LevelToWrite {
    const VoxelLevel& source;
    VdbLeaves found;

    [[nodiscard]] const VoxelLevelInfo& info() const { return source.info(); }
    [[nodiscard]] LevelGrids grids() const {
        return {info().level, info().fields, found.most_lobes, found.merge_voxels > 0};
    }
};

/// Writes grids into one file, one at a time; openvdb::io::File needs them all at once.
class Archive : public openvdb::io::Archive {
public:
    Archive(std::ostream& out, Progress& progress) : out_(out), progress_(progress) {
        setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
    }

    void write_head(const openvdb::MetaMap& metadata, std::int32_t grids) {
        openvdb::io::setDataCompression(out_, compression());
        writeHeader(out_, /*seekable=*/true);
        metadata.writeMeta(out_);
        write_raw(out_, grids);
    }

    /// @param leaves  those with a voxel that is active in the grid, with the masks of these voxels
    template <typename Values>
    void write(const LevelToWrite& level,
               const std::string& name,
               const Values& values,
               std::span<const LeafRef> leaves) {
        using Value = typename Values::Value;
        write_leaves<Value>(level, name, leaves,
                            [&](const VoxelBlock& block, const VoxelLeaf& leaf, Value* buffer) {
                                std::size_t n = 0;
                                for_each_in_grid(
                                    block, leaf, values,
                                    [&](std::size_t, int, std::size_t v, std::size_t l) {
                                        buffer[n++] = values.value(block, v, l);
                                    });
                                return n;
                            });
    }

private:
    using GridBase = openvdb::GridBase;

    template <typename Stored>
    void write_leaves(const LevelToWrite& level,
                      const std::string& name,
                      std::span<const LeafRef> leaves,
                      LeafGather<Stored> gather) {
        constexpr bool kHalf = std::is_same_v<Stored, HalfDirection>;
        constexpr TreeType kTree = kTreeOf<Stored>;
        static_assert(kTree.value_bytes == sizeof(Stored) * (kHalf ? 2 : 1));
        openvdb::MetaMap about = describe(level, leaves, kTree.value_bytes);
        about.insertMeta(GridBase::META_GRID_NAME, openvdb::StringMetadata(name));
        if (std::is_same_v<Stored, float>) {
            about.insertMeta(GridBase::META_GRID_CLASS, openvdb::StringMetadata(fog_volume()));
        }
        about.insertMeta(GridBase::META_SAVE_HALF_FLOAT, openvdb::BoolMetadata(kHalf));
        openvdb::io::GridDescriptor place(name, kTree.name, kHalf);
        place.writeHeader(out_);
        const auto offsets = out_.tellp();
        place.writeStreamPos(out_);
        place.setGridPos(out_.tellp());
        write_raw(out_, compression());
        about.writeMeta(out_);
        make_transform(level.info().lattice)->write(out_);
        write_topology<std::array<char, kTree.value_bytes>>(out_, leaves, kHalf);
        place.setBlockPos(out_.tellp());
        write_buffers<Stored>(out_, level.source, leaves, gather, progress_);
        place.setEndPos(out_.tellp());
        out_.seekp(offsets);
        place.writeStreamPos(out_);
        place.seekToEnd(out_);
    }

    static std::string fog_volume() {
        return GridBase::gridClassToString(openvdb::GRID_FOG_VOLUME);
    }

    /// The metadata of openvdb::io::File, without its extra compression to measure sizes.
    static openvdb::MetaMap
    describe(const LevelToWrite& level, std::span<const LeafRef> leaves, std::size_t value_bytes) {
        std::int64_t voxels = 0;
        for (const LeafRef& leaf : leaves) {
            for (std::uint64_t w : leaf.active) voxels += std::popcount(w);
        }
        openvdb::MetaMap about;
        const auto bytes = static_cast<std::int64_t>(leaves.size() * (96 + 512 * value_bytes));
        about.insertMeta(GridBase::META_FILE_VOXEL_COUNT, openvdb::Int64Metadata(voxels));
        about.insertMeta(GridBase::META_FILE_MEM_BYTES, openvdb::Int64Metadata(bytes));
        about.insertMeta(GridBase::META_FILE_COMPRESSION,
                         openvdb::StringMetadata("blosc + active values"));
        if (voxels == 0) return about;
        about.insertMeta(GridBase::META_FILE_BBOX_MIN,
                         openvdb::Vec3IMetadata(to_vdb(level.found.box.lo)));
        about.insertMeta(GridBase::META_FILE_BBOX_MAX,
                         openvdb::Vec3IMetadata(to_vdb(level.found.box.hi)));
        return about;
    }

    std::ostream& out_;
    Progress& progress_;
};

/// Writes the grids of one level.
class LevelWriter {
public:
    LevelWriter(Archive& archive, const LevelToWrite& level) : archive_(archive), level_(level) {}

    void write() {
        write_derived();
        for_each_voxel_grid(level_.grids(), [&](const std::string& name, const auto& values) {
            archive_.write(level_, name, values, leaves_of(values));
        });
        for (int k = 0; k < level_.found.most_lobes; ++k) {
            const auto leaves = leaves_of(OfLobe{static_cast<std::size_t>(k)});
            for_each_lobe_grid(level_.grids(), k, [&](const std::string& name, const auto& values) {
                archive_.write(level_, name, values, leaves);
            });
        }
    }

    /// The number of grids that write() writes.
    [[nodiscard]] static int count(const LevelToWrite& level) {
        int grids = 1 + (level.found.fiber_voxels > 0) + (level.found.surface_voxels > 0);
        for_each_grid(level.grids(), [&](const std::string&, const auto&) { ++grids; });
        return grids;
    }

private:
    /// Writes the density and directions, for programs that do not know the other grids.
    void write_derived() {
        const VoxelLevelInfo& info = level_.info();
        const auto name = [&](GridKind kind) { return grid_name(kind, 0, info.level); };
        const std::span<const LeafRef> all = level_.found.leaves;
        archive_.write(level_, name(GridKind::Density), DensityValues(info.lattice), all);
        for (const MaterialKind kind : {MaterialKind::Fiber, MaterialKind::Surface}) {
            const bool fiber = kind == MaterialKind::Fiber;
            const std::int64_t voxels =
                fiber ? level_.found.fiber_voxels : level_.found.surface_voxels;
            if (voxels == 0) continue;
            const HalfDirectionValues values(info.materials, kind);
            archive_.write(level_, name(fiber ? GridKind::Tangent : GridKind::Normal), values,
                           voxels == level_.found.voxel_count ? all : select(values));
        }
    }

    template <typename Values>
    std::span<const LeafRef> leaves_of(const Values& values) {
        if (values.every_voxel()) return level_.found.leaves;
        return select(values);
    }

    /// The result is valid until the next call.
    template <typename Values>
    std::span<const LeafRef> select(const Values& values) {
        selected_ = select_leaves(level_.source, level_.found.leaves,
                                  [&](const VoxelBlock& block, const VoxelLeaf& leaf) {
                                      LeafMask active{};
                                      for_each_in_grid(
                                          block, leaf, values,
                                          [&](std::size_t x, int bit, std::size_t, std::size_t) {
                                              active[x] |= std::uint64_t{1} << bit;
                                          });
                                      return active;
                                  });
        return selected_;
    }

    Archive& archive_;
    const LevelToWrite& level_;
    std::vector<LeafRef> selected_;
};

openvdb::MetaMap make_metadata(std::span<const LevelToWrite> levels) {
    std::vector<LevelCounts> counts;
    for (const LevelToWrite& level : levels) {
        const VdbLeaves& found = level.found;
        counts.push_back({found.voxel_count, found.lobe_count, found.box.lo, found.box.hi});
    }
    const InfoJson json = to_json(levels[0].info(), counts);
    const VoxelFields& has = levels[0].info().fields;
    const bool placed = has.occupancy || has.slabs;
    openvdb::MetaMap metadata;
    metadata.insertMeta(kFormatKey, openvdb::Int32Metadata(placed ? kPlacedFormat : kPlainFormat));
    metadata.insertMeta(kLevelsKey, openvdb::Int32Metadata(static_cast<int>(levels.size())));
    metadata.insertMeta(kInfoKey, openvdb::StringMetadata(json.info));
    metadata.insertMeta(kMaterialsKey, openvdb::StringMetadata(json.materials));
    metadata.insertMeta(kYarnsKey, openvdb::StringMetadata(json.yarns));
    return metadata;
}

/// Throws unless the levels share one lattice and are in order, finest first.
void check_levels(std::span<const VoxelLevel* const> levels) {
    const auto fail = [](const std::string& what) {
        throw Error(ErrorCode::Internal, "write vdb: " + what);
    };
    if (levels.empty() || levels.size() > kMaxLevels) {
        fail(str(levels.size(), " levels (allowed: 1 to ", kMaxLevels, ")"));
    }
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const VoxelLevelInfo& info = levels[i]->info();
        const Lattice want = lattice_of_level(levels[0]->info().lattice, static_cast<int>(i));
        if (info.level != static_cast<std::int32_t>(i) ||
            info.lattice.voxel_size != want.voxel_size ||
            info.lattice.subvoxels != want.subvoxels) {
            fail(str("level ", info.level, " stands at place ", i, " or is off its lattice"));
        }
        const std::int32_t cells = info.fields.footprints;
        if (cells != 0 && cells != 4 && cells != 8) {
            fail(str("footprints of ", cells, " cells (allowed: 0, 4, 8)"));
        }
    }
}

void write_grids(std::ostream& out, std::span<const LevelToWrite> levels, Progress& progress) {
    int grids = 0;
    std::int64_t work = 0;
    for (const LevelToWrite& level : levels) {
        const int n = LevelWriter::count(level);
        grids += n;
        work += static_cast<std::int64_t>(level.found.leaves.size()) * n;
    }
    progress.begin("write", "leaves", work);
    Archive archive(out, progress);
    archive.write_head(make_metadata(levels), grids);
    for (const LevelToWrite& level : levels) LevelWriter(archive, level).write();
}

void write_sources(std::span<const VoxelLevel* const> sources,
                   const std::string& path,
                   Progress& progress) {
    OutputFile file(path); // first: an output that cannot be written is reported early
    check_levels(sources);
    openvdb::initialize();
    std::vector<LevelToWrite> levels;
    for (const VoxelLevel* source : sources) {
        levels.push_back({*source, list_vdb_leaves(*source, progress)});
    }
    try {
        std::vector<char> buffer(kBufferBytes); // must outlive the stream
        std::ofstream out;
        out.exceptions(std::ios::failbit | std::ios::badbit);
        out.rdbuf()->pubsetbuf(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        errno = 0;
        out.open(file.temp_path(), std::ios::binary);
        write_grids(out, levels, progress);
        out.close();
    } catch (const std::ios_base::failure&) {
        file.fail("write", errno != 0 ? errno : EIO);
    } catch (const openvdb::Exception& e) {
        throw Error(ErrorCode::Internal, str("openvdb: ", e.what()), {}, {.path = path});
    }
    file.commit();
}

} // namespace

void write_vdb(const VoxelLevels& levels, const std::string& path, Progress& progress) {
    std::vector<const VoxelLevel*> sources;
    for (const std::unique_ptr<VoxelLevel>& level : levels) sources.push_back(level.get());
    write_sources(sources, path, progress);
}

void write_vdb(const VoxelLevel& source, const std::string& path, Progress& progress) {
    const VoxelLevel* const one = &source;
    write_sources({&one, 1}, path, progress);
}

} // namespace heddle
