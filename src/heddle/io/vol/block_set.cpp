#include <heddle/io/vol/block_set.h>

#include <heddle/base/error.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>
#include <vector>

namespace heddle {
namespace {

namespace fs = std::filesystem;

std::string show(Vec3i v) {
    return str(v.x, " ", v.y, " ", v.z);
}

bool contains(const std::string& text, const char* word) {
    return text.find(word) != std::string::npos;
}

std::string join(const std::string& folder, const std::string& name) {
    return (fs::path(folder) / name).string();
}

/// The names in a folder in alphabetical order; none if it cannot be listed.
std::vector<std::string> list_files(const std::string& folder) {
    std::vector<std::string> names;
    std::error_code failed;
    for (fs::directory_iterator i(folder.empty() ? "." : folder, failed), end; !failed && i != end;
         i.increment(failed)) {
        names.push_back(i->path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// The sets beside a dictionary that have a listed block, by name.
std::vector<BlockSet> find_sets(const std::string& path, const VolDictionary& dictionary) {
    std::set<std::tuple<int, int, int>> listed;
    for (const Vec3i b : dictionary.blocks) listed.insert({b.x, b.y, b.z});
    const std::string folder = fs::path(path).parent_path().string();
    std::map<std::pair<std::string, std::string>, BlockSet> sets;
    for (const std::string& file : list_files(folder)) {
        if (suffix_of(file) != ".vol") continue;
        const std::optional<BlockName> name = parse_block_name(file);
        if (!name || !listed.contains({name->block.x, name->block.y, name->block.z})) continue;
        if (sets.contains({name->prefix, name->postfix})) continue;
        sets[{name->prefix, name->postfix}] = {folder, *name, VolFile(join(folder, file)).header()};
    }
    std::vector<BlockSet> out;
    for (const auto& [key, set] : sets) out.push_back(set);
    return out;
}

[[noreturn]] void fail_sets(const std::string& path,
                            const std::vector<BlockSet>& sets,
                            const char* what,
                            const char* fix) {
    std::string names;
    for (const BlockSet& s : sets) {
        names += str(names.empty() ? "" : ", ", "'", s.name.prefix, "*", s.name.postfix, "'");
    }
    throw Error(ErrorCode::BadFile, str(what, names), fix, {.path = path});
}

BlockSet choose_density(const std::string& path,
                        const VolDictionary& dictionary,
                        std::vector<BlockSet> sets) {
    std::erase_if(sets, [](const BlockSet& s) { return !s.header.holds_density(); });
    if (sets.empty()) {
        const std::string name = BlockName{"*", "*.vol", {}}.of(dictionary.blocks.front());
        throw Error(ErrorCode::BadFile,
                    str("lists block ", show(dictionary.blocks.front()), ", and no density file '",
                        name, "' stands beside it"),
                    "put the blocks' files into the dictionary's folder", {.path = path});
    }
    if (sets.size() > 1) {
        std::vector<BlockSet> named = sets;
        std::erase_if(named, [](const BlockSet& s) {
            return !contains(s.name.prefix + s.name.postfix, "density");
        });
        if (named.size() != 1) {
            fail_sets(path, sets, "several sets of files could be its density: ",
                      "leave one of them in the folder, or put 'density' into its names");
        }
        sets = named;
    }
    return sets.front();
}

std::optional<BlockSet>
choose_orientation(const std::string& path, std::vector<BlockSet> sets, const std::string& asked) {
    if (asked == "none") return std::nullopt;
    if (!asked.empty()) {
        const VolFile file(asked);
        expect_directions(file);
        const std::optional<BlockName> name = parse_block_name(fs::path(asked).filename().string());
        if (!name) {
            throw Error(ErrorCode::InvalidArgument, "its name does not contain a block",
                        "name one of the blocks' files, 'prefixXXX_YYY_ZZZpostfix.vol'",
                        {.path = asked});
        }
        return BlockSet{fs::path(asked).parent_path().string(), *name, file.header()};
    }
    std::erase_if(sets, [](const BlockSet& s) {
        const std::string name = s.name.prefix + s.name.postfix;
        return !(s.header.encoding == VolEncoding::Direction ||
                 (s.header.may_hold_directions() &&
                  (contains(name, "orientation") || contains(name, "direction"))));
    });
    if (sets.size() > 1) {
        fail_sets(path, sets, "several sets of files could be its orientation: ",
                  "name a file of the right one as --orientation");
    }
    return sets.empty() ? std::nullopt : std::optional(sets.front());
}

/// Throws if one of the listed blocks has no file, naming the first and the number.
void expect_all_there(const std::string& path,
                      const VolDictionary& dictionary,
                      const BlockSet& set) {
    std::size_t missing = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < dictionary.blocks.size(); ++i) {
        std::error_code ignored;
        if (fs::exists(set.path_of(dictionary.blocks[i]), ignored)) continue;
        if (missing++ == 0) first = i;
    }
    if (missing == 0) return;
    throw Error(ErrorCode::BadFile,
                str("lists block ", show(dictionary.blocks[first]), ", and its file '",
                    set.path_of(dictionary.blocks[first]), "' is missing (", missing, " of ",
                    dictionary.blocks.size(), " are)"),
                "copy it there, or export the volume again",
                {.path = path, .offset = static_cast<std::int64_t>(36 + 12 * first)});
}

} // namespace

void expect_density(const VolFile& file) {
    if (file.header().holds_density()) return;
    file.fail(20, "3 channels: directions or colours, not density",
              "name the file of density, and this one as --orientation");
}

void expect_directions(const VolFile& file) {
    if (file.header().may_hold_directions()) return;
    file.fail(20,
              str(file.header().channels, " channels of ", to_string(file.header().encoding),
                  ": no directions"),
              "name a file of directions (encoding 4, or three f32)");
}

std::string BlockSet::path_of(Vec3i block) const {
    return join(folder, name.of(block));
}

VolSets find_vol_sets(const std::string& path,
                      const VolDictionary& dictionary,
                      const std::string& orientation) {
    const std::vector<BlockSet> sets = find_sets(path, dictionary);
    VolSets out{choose_density(path, dictionary, sets),
                choose_orientation(path, sets, orientation)};
    expect_all_there(path, dictionary, out.density);
    if (out.orientation) expect_all_there(path, dictionary, *out.orientation);
    return out;
}

} // namespace heddle
