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

/// Scale and half a voxel's move: an index is the voxel's centre. Read from its own bytes, as a file's
/// is: the constructors take voxels below 1e-5 scene units for flat, and patterns in metres have such.
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

/// The standard grid that stores values of a type; it never holds a voxel.
template <typename Value>
struct GridOf;
template <>
struct GridOf<float> : std::type_identity<openvdb::FloatGrid> {};
template <>
struct GridOf<HalfDirection> : std::type_identity<openvdb::Vec3SGrid> {};
template <>
struct GridOf<std::int32_t> : std::type_identity<openvdb::Int32Grid> {};
template <>
struct GridOf<std::int64_t> : std::type_identity<openvdb::Int64Grid> {};

/// DirectionValues as half floats: half the bytes, and still finer than the lobe's eight bits.
struct HalfDirectionValues : DirectionValues {
    using DirectionValues::DirectionValues;
    using Value = HalfDirection;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t l) const {
        const Vec3f d = DirectionValues::value(b, v, l);
        return {openvdb::math::half(d.x), openvdb::math::half(d.y), openvdb::math::half(d.z)};
    }
};

/// A level to be written and what its walk found.
struct Level {
    const VoxelSource& source;
    VdbLeaves found;

    [[nodiscard]] const VoxelGridInfo& info() const { return source.info(); }
    [[nodiscard]] LevelGrids grids() const {
        return {info().level, info().fields, found.most_lobes, found.merge_voxels > 0};
    }
};

/// Writes grids into one file one after the other; openvdb::io::File takes them all at once.
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

    /// @param leaves  those with a voxel that is active in the grid, with the masks of such
    template <typename Values>
    void write(const Level& level,
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
    template <typename Stored>
    void write_leaves(const Level& level,
                      const std::string& name,
                      std::span<const LeafRef> leaves,
                      LeafGather<Stored> gather) {
        using GridT = typename GridOf<Stored>::type;
        using Value = typename GridT::ValueType;
        constexpr bool kHalf = std::is_same_v<Stored, HalfDirection>;
        static_assert(sizeof(Value) == sizeof(Stored) * (kHalf ? 2 : 1));
        const typename GridT::Ptr grid = GridT::create();
        describe(*grid, level, leaves, sizeof(Value));
        grid->setName(name);
        if (std::is_same_v<Stored, float>) grid->setGridClass(openvdb::GRID_FOG_VOLUME);
        grid->setSaveFloatAsHalf(kHalf);
        openvdb::io::GridDescriptor place(name, grid->type(), kHalf);
        place.writeHeader(out_);
        const auto offsets = out_.tellp();
        place.writeStreamPos(out_);
        place.setGridPos(out_.tellp());
        setGridCompression(out_, *grid);
        grid->writeMeta(out_);
        grid->writeTransform(out_);
        write_topology<Value>(out_, leaves, kHalf);
        place.setBlockPos(out_.tellp());
        write_buffers<Stored>(out_, level.source, leaves, gather, progress_);
        place.setEndPos(out_.tellp());
        out_.seekp(offsets);
        place.writeStreamPos(out_);
        place.seekToEnd(out_);
    }

    /// What openvdb::io::File would add, without the second compression that it does to find out.
    static void describe(openvdb::GridBase& grid,
                         const Level& level,
                         std::span<const LeafRef> leaves,
                         std::size_t value_bytes) {
        grid.setTransform(make_transform(level.info().lattice));
        std::int64_t voxels = 0;
        for (const LeafRef& leaf : leaves) {
            for (std::uint64_t w : leaf.active) voxels += std::popcount(w);
        }
        using openvdb::GridBase;
        const auto bytes = static_cast<std::int64_t>(leaves.size() * (96 + 512 * value_bytes));
        grid.insertMeta(GridBase::META_FILE_VOXEL_COUNT, openvdb::Int64Metadata(voxels));
        grid.insertMeta(GridBase::META_FILE_MEM_BYTES, openvdb::Int64Metadata(bytes));
        grid.insertMeta(GridBase::META_FILE_COMPRESSION,
                        openvdb::StringMetadata("blosc + active values"));
        if (voxels == 0) return;
        grid.insertMeta(GridBase::META_FILE_BBOX_MIN,
                        openvdb::Vec3IMetadata(to_vdb(level.found.box.lo)));
        grid.insertMeta(GridBase::META_FILE_BBOX_MAX,
                        openvdb::Vec3IMetadata(to_vdb(level.found.box.hi)));
    }

    std::ostream& out_;
    Progress& progress_;
};

/// One level's grids.
class LevelWriter {
public:
    LevelWriter(Archive& archive, const Level& level) : archive_(archive), level_(level) {}

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

    /// Grids that write() writes.
    [[nodiscard]] static int count(const Level& level) {
        int grids = 1 + (level.found.fiber_voxels > 0) + (level.found.surface_voxels > 0);
        for_each_grid(level.grids(), [&](const std::string&, const auto&) { ++grids; });
        return grids;
    }

private:
    /// For programs that know nothing of the others.
    void write_derived() {
        const VoxelGridInfo& info = level_.info();
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

    /// Holds until the next call.
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
    const Level& level_;
    std::vector<LeafRef> selected_;
};

openvdb::MetaMap make_metadata(std::span<const Level> levels) {
    std::vector<LevelCounts> counts;
    for (const Level& level : levels) {
        const VdbLeaves& found = level.found;
        counts.push_back({found.voxel_count, found.lobe_count, found.box.lo, found.box.hi});
    }
    const InfoJson json = to_json(levels[0].info(), counts);
    openvdb::MetaMap metadata;
    metadata.insertMeta(kFormatKey, openvdb::Int32Metadata(kFormatVersion));
    metadata.insertMeta(kLevelsKey, openvdb::Int32Metadata(static_cast<int>(levels.size())));
    metadata.insertMeta(kInfoKey, openvdb::StringMetadata(json.info));
    metadata.insertMeta(kMaterialsKey, openvdb::StringMetadata(json.materials));
    metadata.insertMeta(kYarnsKey, openvdb::StringMetadata(json.yarns));
    return metadata;
}

/// Throws unless the levels are those of one lattice, finest first.
void check_levels(std::span<const VoxelSource* const> levels) {
    const auto fail = [](const std::string& what) {
        throw Error(ErrorCode::Internal, "write vdb: " + what);
    };
    if (levels.empty() || levels.size() > kMaxLevels) {
        fail(str(levels.size(), " levels (allowed: 1 to ", kMaxLevels, ")"));
    }
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const VoxelGridInfo& info = levels[i]->info();
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

void write_grids(std::ostream& out, std::span<const Level> levels, Progress& progress) {
    int grids = 0;
    std::int64_t work = 0;
    for (const Level& level : levels) {
        const int n = LevelWriter::count(level);
        grids += n;
        work += static_cast<std::int64_t>(level.found.leaves.size()) * n;
    }
    progress.begin("write", "leaves", work);
    Archive archive(out, progress);
    archive.write_head(make_metadata(levels), grids);
    for (const Level& level : levels) LevelWriter(archive, level).write();
}

void write_sources(std::span<const VoxelSource* const> sources,
                   const std::string& path,
                   Progress& progress) {
    OutputFile file(path); // first: an output that cannot be written is said before the work
    check_levels(sources);
    openvdb::initialize();
    std::vector<Level> levels;
    for (const VoxelSource* source : sources) {
        levels.push_back({*source, list_vdb_leaves(*source, progress)});
    }
    try {
        std::vector<char> buffer(kBufferBytes); // outlives the stream
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
    std::vector<const VoxelSource*> sources;
    for (const std::unique_ptr<VoxelSource>& level : levels) sources.push_back(level.get());
    write_sources(sources, path, progress);
}

void write_vdb(const VoxelSource& source, const std::string& path, Progress& progress) {
    const VoxelSource* const one = &source;
    write_sources({&one, 1}, path, progress);
}

} // namespace heddle
