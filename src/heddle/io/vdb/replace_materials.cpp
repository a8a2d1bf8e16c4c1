#include <heddle/io/vdb/replace_materials.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/file/output_file.h>
#include <heddle/io/vdb/info_json.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/vdb_file.h>
#include <heddle/io/vdb/vdb_format.h>

#include <algorithm>

namespace heddle {
namespace {

constexpr std::int64_t kCopyBytes = std::int64_t{4} << 20;
constexpr std::int64_t kPlaceBytes = 3 * 8; ///< the offsets of a grid, which precede it

/// Copies a file's bytes front to back into another, except for skipped ones.
class Copy {
public:
    Copy(const std::string& path, OutputFile& out, Progress& progress)
        : in_(path), out_(out), progress_(progress), buffer_(kCopyBytes) {}

    void up_to(std::int64_t end) {
        while (at_ < end) {
            progress_.check();
            const std::int64_t n = std::min(end - at_, kCopyBytes);
            in_.read_at(static_cast<std::uint64_t>(at_), buffer_.data(),
                        static_cast<std::uint64_t>(n));
            out_.write(buffer_.data(), static_cast<std::size_t>(n));
            progress_.advance(n);
            at_ += n;
        }
    }
    void skip(std::int64_t bytes) { at_ += bytes; }

private:
    InputFile in_;
    OutputFile& out_;
    Progress& progress_;
    std::vector<char> buffer_;
    std::int64_t at_ = 0;
};

} // namespace

void replace_materials(const std::string& path,
                       const std::vector<Material>& materials,
                       const std::string& output,
                       Progress& progress) {
    const std::size_t had = read_infos(path)[0].materials.size();
    if (materials.size() != had) {
        throw Error(ErrorCode::InvalidArgument,
                    str(materials.size(), " materials for a file that has ", had), {},
                    {.path = path});
    }
    const VdbContents file = read_contents(path);
    const std::string text = materials_to_json(materials);
    const auto old_bytes = static_cast<std::int64_t>(file.metadata.at(kMaterialsKey).size());
    const std::int64_t moved = static_cast<std::int64_t>(text.size()) - old_bytes;
    OutputFile out(output);
    progress.begin("copy", "bytes", file.bytes);
    Copy copy(path, out, progress);
    copy.up_to(file.value_at.at(kMaterialsKey));
    copy.skip(4 + old_bytes);
    out.write_value(static_cast<std::uint32_t>(text.size()));
    out.write(text.data(), text.size());
    for (const GridEntry& grid : file.grids) {
        copy.up_to(grid.begin - kPlaceBytes);
        copy.skip(kPlaceBytes);
        for (const std::int64_t place : {grid.begin, grid.buffers, grid.end}) {
            out.write_value(place + moved);
        }
    }
    copy.up_to(file.bytes);
    out.commit();
}

} // namespace heddle
