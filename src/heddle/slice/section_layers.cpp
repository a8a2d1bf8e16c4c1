#include <heddle/slice/section_layers.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/yarn/fiber_table.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

namespace heddle::slice {
namespace {

/// The least texels of a fiber's radius; interpolated distances then err by at most 1/300.
constexpr float kTexelsOfRadius = 6.0f;
constexpr float kMinSize = 64.0f;
constexpr float kMaxSize = 1024.0f;

/// The positions of the fibers of a section, model units.
struct Discs {
    std::vector<float> x, y;
    std::vector<float> across_x, across_y; ///< unit direction in which twist tilts the fiber
    std::vector<float> cosine; ///< of the tilt: the section of a fiber is longer by 1 / cosine
    std::vector<std::uint32_t> color;
    float radius = 0.0f;
    float extent = 0.0f;
    const Texture* image = nullptr; ///< image of a slice
    float half = 0.0f;              ///< the image fills [-half, half]^2
};

Discs discs_of(const YarnType* yarn, std::uint64_t seed, std::uint64_t curve) {
    Discs out;
    if (yarn == nullptr || yarn->model == YarnModel::Solid) {
        const float radius = yarn == nullptr ? 1.0f : yarn->model_radius;
        return {{0.0f},      {0.0f}, {1.0f}, {0.0f},  {1.0f},
                {0xffffffu}, radius, radius, nullptr, radius};
    }
    const FiberTable table = place_fibers(*yarn, seed, curve);
    out.radius = table.fiber_radius;
    out.image = &yarn->slice;
    out.half = yarn->model_radius;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const float r = table.radius[i] * yarn->model_radius;
        out.x.push_back(r * table.cos_angle[i]);
        out.y.push_back(r * table.sin_angle[i]);
        out.across_x.push_back(-table.sin_angle[i]);
        out.across_y.push_back(table.cos_angle[i]);
        const float lean = yarn->twist * r;
        out.cosine.push_back(1.0f / std::sqrt(1.0f + lean * lean));
        out.color.push_back(table.color[i]);
        const float half = out.radius / out.cosine.back();
        out.extent = std::max({out.extent, r + out.radius, std::sqrt(r * r + half * half)});
    }
    return out;
}

/// Volume fraction at (x, y), 0 to 255.
std::uint8_t alpha_at(const Discs& discs, float x, float y, float distance) {
    if (discs.image == nullptr) return distance < 0.0f ? 255 : 0;
    const Texture& image = *discs.image;
    const float col = (x / discs.half + 1.0f) * 0.5f * static_cast<float>(image.width);
    const float row = (1.0f - y / discs.half) * 0.5f * static_cast<float>(image.height);
    if (!(col >= 0.0f && row >= 0.0f)) return 0;
    const auto c = static_cast<std::size_t>(col);
    const auto r = static_cast<std::size_t>(row);
    const auto width = static_cast<std::size_t>(image.width);
    if (c >= width || r >= static_cast<std::size_t>(image.height)) return 0;
    return image.texels[4 * (r * width + c) + 3];
}

SectionLayer draw(const Discs& discs, std::int32_t size) {
    SectionLayer layer;
    layer.extent = discs.extent;
    layer.fiber_radius = discs.radius;
    const auto side = static_cast<std::size_t>(size);
    layer.distance.resize(side * side);
    layer.color.resize(4 * side * side);
    const float step = 2.0f * discs.extent / static_cast<float>(size);
    parallel_chunks(side, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin * side; i < end * side; ++i) {
            const float x = (static_cast<float>(i % side) + 0.5f) * step - discs.extent;
            const float y = (static_cast<float>(i / side) + 0.5f) * step - discs.extent;
            float least = 1e30f;
            std::size_t nearest = 0;
            for (std::size_t d = 0; d < discs.x.size(); ++d) {
                const float dx = x - discs.x[d];
                const float dy = y - discs.y[d];
                const float along = dx * discs.across_x[d] + dy * discs.across_y[d];
                const float squeeze = 1.0f - discs.cosine[d] * discs.cosine[d];
                const float square = dx * dx + dy * dy - along * along * squeeze;
                if (square < least) {
                    least = square;
                    nearest = d;
                }
            }
            layer.distance[i] = std::sqrt(least) - discs.radius;
            const std::uint32_t color = discs.color.empty() ? 0u : discs.color[nearest];
            for (std::size_t c = 0; c < 3; ++c) {
                layer.color[4 * i + c] = static_cast<std::uint8_t>(color >> (8 * c) & 0xffu);
            }
            layer.color[4 * i + 3] = alpha_at(discs, x, y, layer.distance[i]);
        }
    });
    return layer;
}

/// The input of all layers.
struct Sections {
    std::vector<Discs> discs;
    std::vector<std::uint32_t> first; ///< as in SectionLayers
    std::int32_t size = 0;
};

Sections sections_of(const Geometry& geometry, std::uint64_t seed) {
    Sections out;
    out.first.push_back(0);
    float size = kMinSize;
    for (std::size_t s = 0; s < geometry.curves.size(); ++s) {
        const CurveSet& set = geometry.curves[s];
        const YarnType* yarn = geometry.yarn_of(set);
        if (yarn != nullptr && yarn->model == YarnModel::Procedural) {
            throw Error(ErrorCode::Unsupported,
                        str("raster: '", yarn->name, "' is procedural, not a slice"),
                        "make a slice of it (heddle slice)");
        }
        const bool drawn = yarn != nullptr && yarn->model == YarnModel::Slice;
        const auto curves =
            static_cast<std::uint32_t>(std::clamp<std::size_t>(set.curve_count(), 1, kMaxVariants));
        const std::uint32_t variants = drawn ? curves : 1;
        for (std::uint32_t v = 0; v < variants; ++v) {
            out.discs.push_back(discs_of(yarn, seed + s, v));
            const Discs& last = out.discs.back();
            size = std::max(size, 2.0f * last.extent / last.radius * kTexelsOfRadius);
        }
        out.first.push_back(static_cast<std::uint32_t>(out.discs.size()));
    }
    out.size = static_cast<std::int32_t>(std::ceil(std::min(size, kMaxSize) / 16.0f)) * 16;
    return out;
}

template <typename T>
void add_to_key(std::uint64_t& key, const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= sizeof(std::uint64_t));
    key = hash64(key, values.size());
    for (const T& value : values) {
        std::uint64_t word = 0;
        std::memcpy(&word, &value, sizeof(T));
        key = hash64(key, word);
    }
}

std::uint64_t key_of(const Sections& sections) {
    std::uint64_t key = hash64(1, static_cast<std::uint64_t>(sections.size));
    add_to_key(key, sections.first);
    for (const Discs& d : sections.discs) {
        for (const std::vector<float>* values : {&d.x, &d.y, &d.across_x, &d.across_y, &d.cosine}) {
            add_to_key(key, *values);
        }
        add_to_key(key, d.color);
        add_to_key(key, std::vector<float>{d.radius, d.extent, d.half});
        if (d.image == nullptr) continue;
        add_to_key(key, std::vector<std::int64_t>{d.image->width, d.image->height});
        add_to_key(key, d.image->texels);
    }
    return key;
}

} // namespace

bool update_sections(SectionLayers& layers, const Geometry& geometry, std::uint64_t seed) {
    Sections sections = sections_of(geometry, seed);
    const std::uint64_t key = key_of(sections);
    if (key == layers.key) return false;
    layers = {.size = sections.size, .layers = {}, .first = std::move(sections.first), .key = key};
    for (const Discs& discs : sections.discs) layers.layers.push_back(draw(discs, layers.size));
    return true;
}

SectionLayers build_sections(const Geometry& geometry, std::uint64_t seed) {
    SectionLayers out;
    (void)update_sections(out, geometry, seed);
    return out;
}

} // namespace heddle::slice
