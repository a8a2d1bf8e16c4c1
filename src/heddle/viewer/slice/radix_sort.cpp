#include <heddle/viewer/slice/radix_sort.h>

#include <string>
#include <string_view>

namespace heddle::viewer {
namespace {

using opengl::Program;

constexpr std::uint32_t kTile = 1024; ///< keys per group: 16 for each of 64 invocations
constexpr std::uint32_t kRun = 1024;  ///< counts that one invocation adds

constexpr std::string_view kShared = R"(
layout(std430, binding = 0) readonly buffer KeysIn { uint keys_in[]; };
layout(std430, binding = 1) buffer Counts { uint counts[]; }; // by digit, then by tile
layout(std430, binding = 2) buffer Sums { uint sums[]; };
uniform uint count;
uniform uint tiles;
uniform uint entries;
uniform uint shift;

uint tile() { return item() / 64u; }
uint digit(uint key) { return key >> shift & 15u; }
)";

/// One tile per group: how many of each digit every invocation has.
constexpr std::string_view kTileCounts = R"(
shared uint held[16 * 64]; // by digit

void count_digits(uint first) {
    uint mine[16];
    for (uint d = 0u; d < 16u; ++d) mine[d] = 0u;
    for (uint i = first; i < min(first + 16u, count); ++i) ++mine[digit(keys_in[i])];
    for (uint d = 0u; d < 16u; ++d) held[d * 64u + gl_LocalInvocationID.x] = mine[d];
}
)";

constexpr std::string_view kCount = R"(
void main() {
    count_digits(item() * 16u);
    barrier();
    if (gl_LocalInvocationID.x >= 16u || tile() >= tiles) return;
    uint sum = 0u;
    for (uint i = 0u; i < 64u; ++i) sum += held[gl_LocalInvocationID.x * 64u + i];
    counts[gl_LocalInvocationID.x * tiles + tile()] = sum;
}
)";

constexpr std::string_view kSum = R"(
void main() {
    uint first = item() * 1024u;
    if (first >= entries) return;
    uint sum = 0u;
    for (uint i = first; i < min(first + 1024u, entries); ++i) sum += counts[i];
    sums[item()] = sum;
}
)";

constexpr std::string_view kTop = R"(
void main() {
    if (item() != 0u) return;
    uint sum = 0u;
    for (uint i = 0u; i * 1024u < entries; ++i) {
        uint here = sums[i];
        sums[i] = sum;
        sum += here;
    }
}
)";

/// Turns the counts into the index of the first key of each digit.
constexpr std::string_view kAdd = R"(
void main() {
    uint first = item() * 1024u;
    if (first >= entries) return;
    uint sum = sums[item()];
    for (uint i = first; i < min(first + 1024u, entries); ++i) {
        uint here = counts[i];
        counts[i] = sum;
        sum += here;
    }
}
)";

constexpr std::string_view kScatter = R"(
layout(std430, binding = 3) readonly buffer ValuesIn { uint values_in[]; };
layout(std430, binding = 4) writeonly buffer KeysOut { uint keys_out[]; };
layout(std430, binding = 5) writeonly buffer ValuesOut { uint values_out[]; };

void main() {
    uint first = item() * 16u;
    count_digits(first);
    barrier();
    if (gl_LocalInvocationID.x < 16u && tile() < tiles) { // one digit: indices by invocation
        uint at = counts[gl_LocalInvocationID.x * tiles + tile()];
        for (uint i = 0u; i < 64u; ++i) {
            uint here = held[gl_LocalInvocationID.x * 64u + i];
            held[gl_LocalInvocationID.x * 64u + i] = at;
            at += here;
        }
    }
    barrier();
    for (uint i = first; i < min(first + 16u, count); ++i) {
        uint slot = digit(keys_in[i]) * 64u + gl_LocalInvocationID.x;
        uint to = held[slot]++;
        keys_out[to] = keys_in[i];
        values_out[to] = values_in[i];
    }
}
)";

std::string with_tiles() {
    return std::string(kShared) + std::string(kTileCounts);
}

} // namespace

RadixSort::RadixSort(std::uint32_t count)
    : count_(count),
      tiles_((count + kTile - 1) / kTile),
      entries_(16 * tiles_),
      keys_{{"sorting keys", count * sizeof(std::uint32_t)},
            {"sorted keys", count * sizeof(std::uint32_t)}},
      values_{{"sorting numbers", count * sizeof(std::uint32_t)},
              {"sorted numbers", count * sizeof(std::uint32_t)}},
      counts_("counts of digits", entries_ * sizeof(std::uint32_t)),
      sums_("sums of counts", (entries_ / kRun + 1) * sizeof(std::uint32_t)),
      count_program_(Program::compute("count digits", with_tiles(), kCount)),
      sum_program_(Program::compute("sum counts", kShared, kSum)),
      top_program_(Program::compute("scan sums", kShared, kTop)),
      add_program_(Program::compute("scan counts", kShared, kAdd)),
      scatter_program_(Program::compute("scatter keys", with_tiles(), kScatter)) {
    for (const Program* p :
         {&count_program_, &sum_program_, &top_program_, &add_program_, &scatter_program_}) {
        p->set("count", count_);
        p->set("tiles", tiles_);
        p->set("entries", entries_);
    }
}

void RadixSort::scan() const {
    const std::uint32_t runs = (entries_ + kRun - 1) / kRun;
    sum_program_.dispatch(runs);
    opengl::finish_writes();
    top_program_.dispatch(1);
    opengl::finish_writes();
    add_program_.dispatch(runs);
    opengl::finish_writes();
}

void RadixSort::sort() const {
    opengl::finish_writes();
    for (std::uint32_t pass = 0; pass < 8; ++pass) { // even: the last pass ends in [0]
        const std::size_t from = pass % 2;
        keys_[from].bind_storage(0);
        counts_.bind_storage(1);
        sums_.bind_storage(2);
        values_[from].bind_storage(3);
        keys_[1 - from].bind_storage(4);
        values_[1 - from].bind_storage(5);
        count_program_.set("shift", 4 * pass);
        scatter_program_.set("shift", 4 * pass);
        const std::uint64_t invocations = std::uint64_t{tiles_} * 64;
        count_program_.dispatch(invocations);
        opengl::finish_writes();
        scan();
        scatter_program_.dispatch(invocations);
        opengl::finish_writes();
    }
}

} // namespace heddle::viewer
