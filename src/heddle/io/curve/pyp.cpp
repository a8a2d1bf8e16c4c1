#include <heddle/base/error.h>
#include <heddle/io/curve/curve_checks.h>
#include <heddle/io/curve/curve_files.h>
#include <heddle/io/curve/pyp_pattern.h>

#include <algorithm>
#include <utility>

namespace heddle {
namespace {

constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 31; // 24 GiB of points
constexpr std::int64_t kNone = -1;

/// A vertex in one of infinitely many tiles.
struct Node {
    std::int64_t vertex = kNone;
    std::int64_t x = 0;
    std::int64_t y = 0;
};

/// Follows the yarns of a pattern through a patch of tiles.
class PatchWeaver {
public:
    PatchWeaver(const PypPattern& pattern, const CurveReadOptions& options, std::string path)
        : pattern_(pattern),
          path_(std::move(path)),
          nx_(options.repeat_x),
          ny_(options.repeat_y),
          seen_(pattern.vertices.size() * static_cast<std::size_t>(nx_ * ny_), 0) {}

    CurveSet weave() {
        set_.basis = Basis::CatmullRom;
        set_.first.push_back(0);
        const auto vertices = static_cast<std::int64_t>(pattern_.vertices.size());
        for (const bool open : {true, false}) { // yarns that remain after the open ones are rings
            for (std::int64_t i = 0; i < nx_ * ny_ * vertices; ++i) {
                const std::int64_t tile = i / vertices;
                const Node node{i % vertices, tile % nx_, tile / nx_};
                if (open && !inside(step(node, pattern_.previous))) add_open(node);
                if (!open && !seen(node)) add_ring(node);
            }
        }
        if (std::none_of(set_.closed.begin(), set_.closed.end(), [](auto c) { return c != 0; })) {
            set_.closed.clear();
        }
        return std::move(set_);
    }

private:
    [[nodiscard]] static Node step(const Node& n, const std::vector<PypStep>& steps) {
        const PypStep& s = steps[static_cast<std::size_t>(n.vertex)];
        return {s.vertex, n.x + s.dx, n.y + s.dy};
    }
    [[nodiscard]] bool inside(const Node& n) const {
        return n.vertex != kNone && n.x >= 0 && n.x < nx_ && n.y >= 0 && n.y < ny_;
    }
    [[nodiscard]] char& seen(const Node& n) {
        return seen_[static_cast<std::size_t>(n.y * nx_ + n.x) * pattern_.vertices.size() +
                     static_cast<std::size_t>(n.vertex)];
    }
    [[nodiscard]] Vec3f position(const Node& n) const {
        Vec3d p = to_double(pattern_.vertices[static_cast<std::size_t>(n.vertex)]);
        p.x += static_cast<double>(n.x) * pattern_.px;
        p.y += static_cast<double>(n.y) * pattern_.py;
        return to_float(p);
    }
    void add(const Node& n) { set_.points.push_back(position(n)); }
    void finish(bool closed) {
        set_.first.push_back(set_.points.size());
        set_.closed.push_back(closed ? 1 : 0);
    }
    /// The node's position; if the yarn ends at `last`, the point before it mirrored at `last`.
    [[nodiscard]] Vec3f phantom(const Node& n, Vec3f last, Vec3f before) const {
        return n.vertex != kNone ? position(n) : last * 2.0f - before;
    }

    /// Adds the yarn that starts at `start`, or enters the patch there.
    void add_open(const Node& start) {
        const std::size_t begin = set_.points.size();
        set_.points.emplace_back(); // the first point only gives a tangent
        Node n = start;
        for (; inside(n); n = step(n, pattern_.next)) {
            seen(n) = 1;
            add(n);
        }
        if (n.vertex != kNone) { // it leaves; the edge across the border is part of this patch
            add(n);
            n = step(n, pattern_.next);
        }
        const std::size_t end = set_.points.size();
        if (end - begin < 3) { // a vertex without edges
            set_.points.resize(begin);
            return;
        }
        const auto& p = set_.points;
        set_.points[begin] = phantom(step(start, pattern_.previous), p[begin + 1], p[begin + 2]);
        set_.points.push_back(phantom(n, p[end - 1], p[end - 2]));
        finish(false);
    }

    /// Adds the yarn through `start` that never leaves the patch.
    void add_ring(const Node& start) {
        const std::size_t begin = set_.points.size();
        for (Node n = start; !seen(n); n = step(n, pattern_.next)) {
            seen(n) = 1;
            add(n);
        }
        const std::size_t count = set_.points.size() - begin;
        if (count < min_point_count(Basis::CatmullRom, true)) {
            throw Error(ErrorCode::BadFile,
                        str("vertex ", start.vertex, " is on a ring of ", count,
                            " points, a closed curve needs at least 3"),
                        "check the edges", {.path = path_});
        }
        finish(true);
    }

    const PypPattern& pattern_;
    std::string path_;
    std::int64_t nx_;
    std::int64_t ny_;
    std::vector<char> seen_; ///< per node of the patch
    CurveSet set_;
};

void check_size(const PypPattern& p, const CurveReadOptions& options, const std::string& path) {
    const std::uint64_t tiles =
        static_cast<std::uint64_t>(options.repeat_x) * static_cast<std::uint64_t>(options.repeat_y);
    if (tiles <= kMaxPoints / p.vertices.size()) return;
    throw Error(ErrorCode::InvalidArgument,
                str(options.repeat_x, " x ", options.repeat_y, " tiles of ", p.vertices.size(),
                    " points pass the limit of ", kMaxPoints, " points"),
                "repeat it less often", {.path = path});
}

std::uint64_t count_alone(const PypPattern& p) {
    std::uint64_t alone = 0;
    for (std::size_t v = 0; v < p.vertices.size(); ++v) {
        if (p.next[v].vertex == kNone && p.previous[v].vertex == kNone) ++alone;
    }
    return alone;
}

} // namespace

Geometry read_pyp(const std::string& path, const CurveReadOptions& options) {
    check_options(options);
    const PypPattern pattern = parse_pyp_pattern(path);
    check_size(pattern, options, path);

    Geometry geometry =
        make_curve_geometry(PatchWeaver(pattern, options, path).weave(), path, "yarn");
    geometry.notes.push_back(str(options.repeat_x, " x ", options.repeat_y, " tiles of ",
                                 pattern.px, " x ", pattern.py));
    if (const std::uint64_t alone = count_alone(pattern); alone > 0) {
        geometry.notes.push_back(str(alone, " vertices are on no edge and are left out"));
    }
    for (const std::string& name : pattern.unknown_sections) {
        geometry.notes.push_back(str("section '", name, "' is not known and not read"));
    }
    if (options.radius <= 0.0f && pattern.radius > 0.0f) {
        geometry.curves.front().default_radius = pattern.radius;
    } else {
        settle_yarn_radius(options, geometry);
    }
    return geometry;
}

} // namespace heddle
