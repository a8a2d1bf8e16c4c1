#include <heddle/io/vdb/grid_reader.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>

namespace heddle {
namespace {

/// Runs `work`; what OpenVDB throws on a damaged file becomes an Error that names it.
template <typename Work>
auto guarded(const std::string& path, const std::string& what, const Work& work) {
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::BadFile, str(what, " asks for more memory than there is"),
                    "write the file again", {.path = path});
    } catch (const std::exception& e) { // openvdb::Exception among them
        std::string text = e.what();
        std::replace(text.begin(), text.end(), '\n', ' ');
        throw Error(ErrorCode::BadFile, str(what, " cannot be read: ", text),
                    "write the file again", {.path = path});
    }
}

template <typename GridT>
GridLeaves extract(const GridT& grid) {
    using Value = typename GridT::ValueType;
    std::vector<const typename GridT::TreeType::LeafNodeType*> nodes;
    grid.tree().getNodes(nodes);
    std::erase_if(nodes, [](const auto* n) { return n->isEmpty(); });
    std::sort(nodes.begin(), nodes.end(),
              [](const auto* a, const auto* b) { return a->origin() < b->origin(); });
    GridLeaves out;
    out.value_bytes = sizeof(Value);
    out.leaves.resize(nodes.size());
    std::size_t total = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const openvdb::Coord& o = nodes[i]->origin();
        out.leaves[i].origin = {o.x(), o.y(), o.z()};
        out.leaves[i].first = total;
        for (openvdb::Index w = 0; w < 8; ++w) {
            out.leaves[i].active[w] = nodes[i]->getValueMask().template getWord<std::uint64_t>(w);
        }
        total += nodes[i]->onVoxelCount();
    }
    out.values.resize(total * sizeof(Value));
    parallel_chunks(nodes.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Value* data = nodes[i]->buffer().data();
            std::byte* to = out.values.data() + out.leaves[i].first * sizeof(Value);
            for (std::size_t x = 0; x < 8; ++x) {
                for (std::uint64_t w = out.leaves[i].active[x]; w != 0; w &= w - 1) {
                    const auto bit = static_cast<std::size_t>(std::countr_zero(w));
                    std::memcpy(to, &data[x * 64 + bit], sizeof(Value));
                    to += sizeof(Value);
                }
            }
        }
    });
    return out;
}

template <typename GridT>
bool extract_as(const openvdb::GridBase& grid, GridLeaves& out) {
    const auto* typed = dynamic_cast<const GridT*>(&grid);
    if (typed == nullptr) return false;
    if (typed->tree().activeTileCount() != 0) {
        throw std::runtime_error(str(typed->tree().activeTileCount(),
                                     " active tiles (allowed: 0, Heddle's voxels are in leaves)"));
    }
    out = extract(*typed);
    return true;
}

} // namespace

struct VdbReader::File {
    openvdb::io::File vdb;
    explicit File(const std::string& path) : vdb(path) {}
};

VdbReader::VdbReader(const std::string& path) : path_(path), entries_(read_grid_entries(path)) {
    openvdb::initialize();
    guarded(path, "the file", [&] {
        file_ = std::make_unique<File>(path);
        file_->vdb.setCopyMaxBytes(0);
        file_->vdb.open(/*delayLoad=*/false);
        const openvdb::MetaMap::Ptr map = file_->vdb.getMetadata();
        for (auto i = map->beginMeta(); i != map->endMeta(); ++i) {
            if (i->second) metadata_[i->first] = i->second->str();
        }
    });
}

VdbReader::~VdbReader() = default;

GridLeaves VdbReader::read(const std::string& name) const {
    return guarded(path_, str("grid '", name, "'"), [&] {
        const openvdb::GridBase::Ptr grid = file_->vdb.readGrid(name);
        GridLeaves out;
        if (extract_as<openvdb::FloatGrid>(*grid, out) ||
            extract_as<openvdb::Vec3SGrid>(*grid, out) ||
            extract_as<openvdb::Int32Grid>(*grid, out) ||
            extract_as<openvdb::Int64Grid>(*grid, out)) {
            return out;
        }
        throw Error(ErrorCode::Unsupported,
                    str("grid '", name, "' is of type '", grid->type(),
                        "' (allowed: float, vec3s, int32, int64)"),
                    "leave it out", {.path = path_});
    });
}

} // namespace heddle
