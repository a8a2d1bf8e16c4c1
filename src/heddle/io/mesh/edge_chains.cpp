#include <heddle/io/mesh/edge_chains.h>

#include <utility>
#include <vector>

namespace heddle {
namespace {

/// The edges that meet at each point: those of point p are edge[first[p]] to edge[first[p + 1]].
struct Incidence {
    std::vector<std::size_t> first;
    std::vector<std::size_t> edge;
    [[nodiscard]] bool runs_through(std::uint32_t p) const { return first[p + 1] - first[p] == 2; }
};

Incidence incidence_of(std::size_t points, std::span<const std::array<std::uint32_t, 2>> edges) {
    Incidence out{std::vector<std::size_t>(points + 1), {}};
    for (const auto& [a, b] : edges) {
        if (a == b) continue;
        ++out.first[a + 1];
        ++out.first[b + 1];
    }
    for (std::size_t p = 0; p < points; ++p) out.first[p + 1] += out.first[p];
    out.edge.resize(out.first[points]);
    std::vector<std::size_t> next(out.first.begin(), out.first.end() - 1);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (edges[e][0] == edges[e][1]) continue;
        for (const std::uint32_t p : edges[e]) out.edge[next[p]++] = e;
    }
    return out;
}

class Chainer {
public:
    Chainer(std::span<const Vec3f> points,
            std::span<const float> radius,
            std::span<const std::array<std::uint32_t, 2>> edges)
        : points_(points),
          radius_(radius),
          edges_(edges),
          at_(incidence_of(points.size(), edges)),
          used_(edges.size(), 0) {
        out_.basis = Basis::Linear;
        out_.first.push_back(0);
    }

    /// Follows every chain that has an end, then the rest, which are rings.
    CurveSet run() {
        for (const bool rings : {false, true}) {
            for (std::size_t e = 0; e < edges_.size(); ++e) {
                for (const std::uint32_t p : edges_[e]) {
                    if (used_[e] != 0 || edges_[e][0] == edges_[e][1]) continue;
                    if (rings || !at_.runs_through(p)) follow(e, p);
                }
            }
        }
        return std::move(out_);
    }

private:
    void add(std::uint32_t p) {
        out_.points.push_back(points_[p]);
        if (!radius_.empty()) out_.radius.push_back(radius_[p]);
    }
    void follow(std::size_t edge, std::uint32_t start) {
        add(start);
        std::uint32_t here = start;
        bool ring = false;
        while (true) {
            used_[edge] = 1;
            here = edges_[edge][0] == here ? edges_[edge][1] : edges_[edge][0];
            ring = here == start && at_.runs_through(here);
            if (ring) break;
            add(here);
            if (!at_.runs_through(here)) break;
            const std::size_t i = at_.first[here];
            edge = at_.edge[i] == edge ? at_.edge[i + 1] : at_.edge[i];
        }
        out_.closed.push_back(ring ? 1 : 0);
        out_.first.push_back(out_.points.size());
    }

    std::span<const Vec3f> points_;
    std::span<const float> radius_;
    std::span<const std::array<std::uint32_t, 2>> edges_;
    Incidence at_;
    std::vector<std::uint8_t> used_;
    CurveSet out_;
};

} // namespace

CurveSet chain_edges(std::span<const Vec3f> points,
                     std::span<const float> radius,
                     std::span<const std::array<std::uint32_t, 2>> edges) {
    return Chainer(points, radius, edges).run();
}

} // namespace heddle
