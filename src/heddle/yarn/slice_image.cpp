#include <heddle/yarn/slice_image.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/base/trig.h>
#include <heddle/yarn/fiber_table.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace heddle {
namespace {

constexpr int kSubtexels = 8; ///< sample points along a texel's side for alpha
constexpr int kDirections = 64;

struct Disc {
    float x, y;
};

/// The positions of a procedural yarn's fibers in its section at length 0, in model units.
std::vector<Disc> section_of(const YarnType& yarn, const FiberTable& table) {
    std::vector<Disc> discs;
    const float mean = yarn.migration ? 0.5f * (yarn.migration_max + yarn.migration_min) : 1.0f;
    const float amplitude =
        yarn.migration ? 0.5f * (yarn.migration_max - yarn.migration_min) : 0.0f;
    for (std::size_t p = 0; p + 1 < table.first_of_ply.size(); ++p) {
        for (std::size_t i = table.first_of_ply[p]; i < table.first_of_ply[p + 1]; ++i) {
            const float r = table.radius[i] * (mean + amplitude * table.cos_migration[i]);
            const float x = yarn.ply_offset + yarn.ellipse_short * r * table.cos_angle[i];
            const float y = yarn.ellipse_long * r * table.sin_angle[i];
            discs.push_back({x * table.ply_cos[p] - y * table.ply_sin[p],
                             x * table.ply_sin[p] + y * table.ply_cos[p]});
        }
    }
    return discs;
}

/// The subtexels of the square [-1, 1]^2, each 1 if a disc contains its centre.
class Raster {
public:
    explicit Raster(std::int32_t size)
        : side_(size * kSubtexels),
          bits_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)) {}

    /// @return  number of subtexels inside the disc, in or outside the square
    std::int64_t fill(float x, float y, float radius) {
        const float scale = 0.5f * static_cast<float>(side_);
        const float cx = (x + 1.0f) * scale - 0.5f;
        const float cy = (1.0f - y) * scale - 0.5f;
        const float r = radius * scale;
        std::int64_t inside = 0;
        for (float row = std::ceil(cy - r); row <= cy + r; row += 1.0f) {
            const float half = std::sqrt(std::max(0.0f, r * r - (row - cy) * (row - cy)));
            for (float col = std::ceil(cx - half); col <= cx + half; col += 1.0f) {
                ++inside;
                const auto edge = static_cast<float>(side_);
                if (row < 0.0f || col < 0.0f || row >= edge || col >= edge) continue;
                set(static_cast<std::size_t>(row), static_cast<std::size_t>(col));
            }
        }
        return inside;
    }
    [[nodiscard]] std::int64_t count(std::size_t row, std::size_t col) const {
        std::int64_t sum = 0;
        for (std::size_t r = 0; r < kSubtexels; ++r) {
            const auto first =
                bits_.begin() +
                static_cast<std::ptrdiff_t>(
                    (row * kSubtexels + r) * static_cast<std::size_t>(side_) + col * kSubtexels);
            sum += std::count(first, first + kSubtexels, std::uint8_t{1});
        }
        return sum;
    }
    [[nodiscard]] std::int64_t set_count() const { return set_; }

private:
    void set(std::size_t row, std::size_t col) {
        ++set_;
        bits_[row * static_cast<std::size_t>(side_) + col] = 1;
    }
    std::int32_t side_;
    std::int64_t set_ = 0; ///< sum over discs of the subtexels inside
    std::vector<std::uint8_t> bits_;
};

Texture blank(std::int32_t width, std::int32_t height, std::int32_t channels) {
    Texture out;
    out.width = width;
    out.height = height;
    out.channels = channels;
    out.wrap_u = Wrap::Clamp;
    out.wrap_v = Wrap::Clamp;
    out.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                      static_cast<std::size_t>(channels));
    return out;
}

void require_slice(const YarnType& yarn) {
    if (yarn.model == YarnModel::Slice && yarn.slice.channels == 4) return;
    throw Error(ErrorCode::InvalidArgument, str("slice: '", yarn.name, "' has no RGBA image"),
                "give a yarn of the model slice");
}

float alpha_at(const Texture& image, float col, float row) {
    if (!(col >= 0.0f && row >= 0.0f)) return 0.0f;
    const auto c = static_cast<std::size_t>(col);
    const auto r = static_cast<std::size_t>(row);
    const auto width = static_cast<std::size_t>(image.width);
    if (c >= width || r >= static_cast<std::size_t>(image.height)) return 0.0f;
    return static_cast<float>(image.texels[4 * (r * width + c) + 3]) / 255.0f;
}

/// Notes the features that the image does not have.
void note_losses(SliceImage& out, const YarnType& yarn) {
    std::string lost;
    const auto lose = [&](bool had, const char* what) {
        if (had) lost += str(lost.empty() ? "" : ", ", what);
    };
    lose(yarn.plies > 1, "turns of fibers about their ply");
    lose(yarn.migration, "migration");
    lose(yarn.flyaways, "flyaways");
    if (!lost.empty()) {
        out.notes.push_back(
            str("'", yarn.name, "' becomes one section swept along the yarn, without ", lost));
    }
    if (out.outside > 0.0) {
        out.notes.push_back(
            str(100.0 * out.outside, " % of the fibers' section lies outside the slice's square"));
    }
}

} // namespace

SliceImage make_slice(const YarnType& yarn, const SliceOptions& options) {
    if (options.size < 1 || options.size > 4096) {
        throw Error(ErrorCode::InvalidArgument, str("slice: size is ", options.size),
                    "use 1 to 4096 texels");
    }
    if (yarn.model != YarnModel::Procedural) {
        throw Error(ErrorCode::InvalidArgument,
                    str("slice: '", yarn.name, "' is not a procedural yarn"),
                    "a slice is made of plies of fibers");
    }
    const FiberTable table = place_fibers(yarn, options.seed, 0);
    const float scale = 1.0f / yarn.model_radius;
    Raster raster(options.size);
    std::int64_t inside = 0;
    for (const Disc& d : section_of(yarn, table)) {
        inside += raster.fill(d.x * scale, d.y * scale, table.fiber_radius * scale);
    }
    SliceImage out;
    out.yarn = yarn;
    out.yarn.model = YarnModel::Slice;
    out.yarn.flyaways = false; // as the notes say
    out.yarn.migration = false;
    out.yarn.slice = blank(options.size, options.size, 4);
    out.yarn.slice.name = yarn.name + ".png";
    const auto size = static_cast<std::size_t>(options.size);
    for (std::size_t i = 0; i < size * size; ++i) {
        constexpr std::int64_t kAll = kSubtexels * kSubtexels;
        const std::int64_t alpha = (raster.count(i / size, i % size) * 255 + kAll / 2) / kAll;
        std::fill_n(out.yarn.slice.texels.begin() + static_cast<std::ptrdiff_t>(4 * i), 3,
                    std::uint8_t{255});
        out.yarn.slice.texels[4 * i + 3] = static_cast<std::uint8_t>(alpha);
    }
    const bool plied = yarn.plies > 1;
    const float turns = plied ? (yarn.ply_clockwise ? -1.0f : 1.0f) / yarn.ply_pitch
                              : (yarn.fiber_clockwise ? -1.0f : 1.0f) / yarn.fiber_pitch;
    out.yarn.twist = 6.2831853f * turns;
    out.yarn.slice_fibers = static_cast<std::int32_t>(yarn.fiber_count());
    if (inside > 0) {
        out.outside = 1.0 - static_cast<double>(raster.set_count()) / static_cast<double>(inside);
    }
    note_losses(out, yarn);
    return out;
}

std::vector<std::string> make_slices_of_yarns(Geometry& geometry, std::uint64_t seed) {
    std::vector<std::string> notes;
    for (YarnType& yarn : geometry.yarns) {
        if (yarn.model != YarnModel::Procedural) continue;
        SliceImage made = make_slice(yarn, {.size = 256, .seed = seed});
        notes.insert(notes.end(), made.notes.begin(), made.notes.end());
        yarn = std::move(made.yarn);
    }
    return notes;
}

Texture bake_occlusion(const YarnType& yarn) {
    require_slice(yarn);
    const Texture& image = yarn.slice;
    Texture out = blank(image.width, image.height, 1);
    const auto width = static_cast<std::size_t>(image.width);
    // texels to model units, and to projected area of fibers
    const float texel = 2.0f * yarn.model_radius / static_cast<float>(image.width);
    const float rise = static_cast<float>(image.height) / static_cast<float>(image.width);
    const float extinction = texel * 0.63661977f / yarn.fiber_radius;
    const float dark = 8.0f / extinction; // e^-8 is less than 1 / 255
    parallel_chunks(out.texels.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float col = static_cast<float>(i % width) + 0.5f;
            const float row = static_cast<float>(i / width) + 0.5f;
            float light = 0.0f;
            for (int d = 0; d < kDirections; ++d) {
                const SinCos at = sincos_turns((d + 0.5) / kDirections);
                float depth = 0.0f;
                const float far = 1.5f * static_cast<float>(width);
                for (float t = 0.5f; t < far && depth < dark; t += 1.0f) {
                    depth += alpha_at(image, col + t * at.cos, row + t * at.sin * rise);
                }
                light += std::exp(-extinction * depth);
            }
            out.texels[i] = static_cast<std::uint8_t>(light / kDirections * 255.0f + 0.5f);
        }
    });
    return out;
}

namespace {

/// Texel (2 col, 2 row) and the three after it; texels past the edge repeat the last.
struct Quad {
    std::array<float, 4> alpha; ///< in [0, 1]; by row, then column
    std::array<std::array<float, 3>, 4> color;

    Quad(const Texture& from, std::int32_t col, std::int32_t row) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t c =
                std::min(2 * col + static_cast<std::int32_t>(k % 2), from.width - 1);
            const std::int32_t r =
                std::min(2 * row + static_cast<std::int32_t>(k / 2), from.height - 1);
            const auto at = 4 * static_cast<std::size_t>(r * from.width + c);
            for (std::size_t i = 0; i < 3; ++i) color[k][i] = from.texels[at + i];
            alpha[k] = static_cast<float>(from.texels[at + 3]) / 255.0f;
        }
    }
    [[nodiscard]] float opacity() const {
        const auto [a, b, c, d] = alpha;
        const float along_rows = ((1 - a) * (1 - b) + (1 - c) * (1 - d)) / 2;
        const float along_columns = ((1 - a) * (1 - c) + (1 - b) * (1 - d)) / 2;
        return 1.0f - (along_rows + along_columns) / 2;
    }
    [[nodiscard]] float mean(std::size_t channel) const {
        float sum = 0.0f;
        float weight = 0.0f;
        for (std::size_t k = 0; k < 4; ++k) {
            const float w = alpha[k] + 1e-4f; // so that transparent texels have a colour
            sum += w * color[k][channel];
            weight += w;
        }
        return sum / weight;
    }
};

} // namespace

std::vector<Texture> shrink_slice(const Texture& image) {
    std::vector<Texture> levels{image};
    while (levels.back().width > 1 || levels.back().height > 1) {
        const Texture& from = levels.back();
        Texture to = blank((from.width + 1) / 2, (from.height + 1) / 2, 4);
        std::size_t at = 0;
        for (std::int32_t row = 0; row < to.height; ++row) {
            for (std::int32_t col = 0; col < to.width; ++col) {
                const Quad quad(from, col, row);
                for (std::size_t i = 0; i < 3; ++i) {
                    to.texels[at++] = static_cast<std::uint8_t>(quad.mean(i) + 0.5f);
                }
                to.texels[at++] = static_cast<std::uint8_t>(quad.opacity() * 255.0f + 0.5f);
            }
        }
        levels.push_back(std::move(to));
    }
    return levels;
}

} // namespace heddle
