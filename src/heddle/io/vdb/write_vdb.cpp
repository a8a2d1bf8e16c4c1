#include <heddle/io/vdb/write_vdb.h>

#include <heddle/io/output_file.h>
#include <heddle/io/vdb/grid_name.h>
#include <heddle/io/vdb/grid_writer.h>
#include <heddle/io/vdb/info_json.h>
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

/// DirectionValues as half floats: half the bytes, and still finer than the lobe's eight bits.
struct HalfDirectionValues : DirectionValues {
    using DirectionValues::DirectionValues;
    using Value = std::array<openvdb::math::half, 3>;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t l) const {
        const Vec3f d = DirectionValues::value(b, v, l);
        return {openvdb::math::half(d.x), openvdb::math::half(d.y), openvdb::math::half(d.z)};
    }
};

/// Writes grids into one file one after the other; openvdb::io::File takes them all at once.
class Archive : public openvdb::io::Archive {
public:
    Archive(std::ostream& out,
            const VoxelSource& source,
            const LeafTable& table,
            Progress& progress)
        : out_(out), source_(source), table_(table), progress_(progress) {
        setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
    }

    void write_head(const openvdb::MetaMap& metadata, std::int32_t grids) {
        openvdb::io::setDataCompression(out_, compression());
        writeHeader(out_, /*seekable=*/true);
        metadata.writeMeta(out_);
        write_raw(out_, grids);
    }

    /// @param GridT  the standard grid whose bytes are written; it never holds a voxel
    template <typename GridT, typename Values>
    void write(const std::string& name, const Values& values, bool every_voxel) {
        if (every_voxel) {
            write_leaves<GridT>(name, values, table_.leaves);
        } else {
            write_leaves<GridT>(name, values, select_leaves(source_, table_.leaves, values));
        }
    }

private:
    template <typename GridT, typename Values>
    void
    write_leaves(const std::string& name, const Values& values, std::span<const LeafRef> leaves) {
        using Value = typename GridT::ValueType;
        constexpr bool kHalf = std::is_same_v<Values, HalfDirectionValues>;
        static_assert(sizeof(Value) == sizeof(typename Values::Value) * (kHalf ? 2 : 1));
        const typename GridT::Ptr grid = GridT::create();
        describe(*grid, name, leaves, sizeof(Value));
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
        write_buffers(out_, source_, leaves, values, progress_);
        place.setEndPos(out_.tellp());
        out_.seekp(offsets);
        place.writeStreamPos(out_);
        place.seekToEnd(out_);
    }

    /// What openvdb::io::File would add, without the second compression that it does to find out.
    void describe(openvdb::GridBase& grid,
                  const std::string& name,
                  std::span<const LeafRef> leaves,
                  std::size_t value_bytes) const {
        grid.setName(name);
        grid.setTransform(make_transform(source_.info().lattice));
        if (name == grid_name(GridKind::Density)) grid.setGridClass(openvdb::GRID_FOG_VOLUME);
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
        grid.insertMeta(GridBase::META_FILE_BBOX_MIN, openvdb::Vec3IMetadata(to_vdb(table_.lo)));
        grid.insertMeta(GridBase::META_FILE_BBOX_MAX, openvdb::Vec3IMetadata(to_vdb(table_.hi)));
    }

    std::ostream& out_;
    const VoxelSource& source_;
    const LeafTable& table_;
    Progress& progress_;
};

openvdb::MetaMap make_metadata(const VoxelGridInfo& info, const LeafTable& table) {
    VoxelGridInfo counted = info;
    counted.voxel_count = table.voxel_count;
    counted.lobe_count = table.lobe_count;
    const InfoJson json = to_json(counted, table.lo, table.hi);
    openvdb::MetaMap metadata;
    metadata.insertMeta(kFormatKey, openvdb::Int32Metadata(kFormatVersion));
    metadata.insertMeta(kLevelsKey, openvdb::Int32Metadata(1));
    metadata.insertMeta(kInfoKey, openvdb::StringMetadata(json.info));
    metadata.insertMeta(kMaterialsKey, openvdb::StringMetadata(json.materials));
    metadata.insertMeta(kYarnsKey, openvdb::StringMetadata(json.yarns));
    return metadata;
}

void write_grids(std::ostream& out,
                 const VoxelSource& source,
                 const LeafTable& table,
                 Progress& progress) {
    const VoxelGridInfo& info = source.info();
    const VoxelGridFields& has = info.fields;
    const bool tangents = table.fiber_voxels > 0;
    const bool normals = table.surface_voxels > 0;
    const int per_lobe = 1 + has.albedo + has.surface + has.tangents;
    const int grids = 2 + tangents + normals + table.most_lobes * per_lobe;
    progress.begin("write", "leaves", static_cast<std::int64_t>(table.leaves.size()) * grids);

    Archive archive(out, source, table, progress);
    archive.write_head(make_metadata(info, table), grids);
    archive.write<openvdb::FloatGrid>(grid_name(GridKind::Density), DensityValues(info.lattice),
                                      true);
    if (tangents) {
        const HalfDirectionValues values(info.materials, MaterialKind::Fiber);
        archive.write<openvdb::Vec3SGrid>(grid_name(GridKind::Tangent), values, !normals);
    }
    if (normals) {
        const HalfDirectionValues values(info.materials, MaterialKind::Surface);
        archive.write<openvdb::Vec3SGrid>(grid_name(GridKind::Normal), values, !tangents);
    }
    archive.write<openvdb::Int64Grid>(grid_name(GridKind::Coverage), CoverageValues{}, true);
    for (int k = 0; k < table.most_lobes; ++k) {
        const OfLobe of{static_cast<std::size_t>(k)};
        const bool all = k == 0;
        archive.write<openvdb::Int64Grid>(grid_name(GridKind::Lobe, k), LobeValues{of}, all);
        if (has.albedo) {
            archive.write<openvdb::Int32Grid>(grid_name(GridKind::Albedo, k), AlbedoValues{of},
                                              all);
        }
        if (has.surface) {
            archive.write<openvdb::Int32Grid>(grid_name(GridKind::Surface, k), SurfaceValues{of},
                                              all);
        }
        if (has.tangents) {
            archive.write<openvdb::Int64Grid>(grid_name(GridKind::Aniso, k), AnisoValues{of}, all);
        }
    }
}

} // namespace

void write_vdb(const VoxelSource& source, const std::string& path, Progress& progress) {
    OutputFile file(path); // first: an output that cannot be written is said before the work
    openvdb::initialize();
    const LeafTable table = make_leaf_table(source, progress);
    try {
        std::vector<char> buffer(kBufferBytes); // outlives the stream
        std::ofstream out;
        out.exceptions(std::ios::failbit | std::ios::badbit);
        out.rdbuf()->pubsetbuf(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        errno = 0;
        out.open(file.temp_path(), std::ios::binary);
        write_grids(out, source, table, progress);
        out.close();
    } catch (const std::ios_base::failure&) {
        file.fail("write", errno != 0 ? errno : EIO);
    } catch (const openvdb::Exception& e) {
        throw Error(ErrorCode::Internal, str("openvdb: ", e.what()), {}, {.path = path});
    }
    file.commit();
}

} // namespace heddle
