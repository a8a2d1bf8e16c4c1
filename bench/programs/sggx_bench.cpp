// Nanoseconds per lobe of fit, pack and related functions:
//   build/release/bench/heddle_sggx_bench

#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/sggx/sample.h>
#include <heddle/sggx/test_lobe.h>

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using namespace heddle;

constexpr std::size_t kLobes = 4096; // 96 KiB of input: fits the second-level cache

/// Moments of all widths, a quarter of them needles, as in a knit.
std::vector<SymmetricMatrix> random_moments() {
    CounterRandom random{1, 1};
    std::vector<SymmetricMatrix> moments;
    for (std::size_t i = 0; i < kLobes; ++i) {
        const double u = i % 4 == 0 ? 0.1 : test::uniform(random);
        const double v = test::uniform(random);
        moments.push_back(test::rotate({1.0, u * u * u * u, u * u * u * u * v * v}, random));
    }
    return moments;
}

template <typename In, typename Body>
void run(benchmark::State& state, const std::vector<In>& in, const Body& body) {
    for (auto _ : state) {
        for (const In& item : in) benchmark::DoNotOptimize(body(item));
    }
    state.counters["lobe"] = benchmark::Counter(static_cast<double>(in.size()),
                                                benchmark::Counter::kIsIterationInvariantRate |
                                                    benchmark::Counter::kInvert);
}

std::vector<SggxMatrix> random_lobes() {
    std::vector<SggxMatrix> lobes;
    for (const SymmetricMatrix& M : random_moments()) lobes.push_back(fit_sggx(M));
    return lobes;
}

void fit(benchmark::State& state) {
    run(state, random_moments(), [](const SymmetricMatrix& M) { return fit_sggx(M); });
}
void pack_lobe(benchmark::State& state) {
    run(state, random_lobes(), [](const SggxMatrix& S) { return pack(S); });
}
void fit_and_pack(benchmark::State& state) {
    run(state, random_moments(), [](const SymmetricMatrix& M) { return pack(fit_sggx(M)); });
}
void eigenvectors(benchmark::State& state) {
    run(state, random_moments(), [](const SymmetricMatrix& M) { return decompose(M); });
}
void moment(benchmark::State& state) {
    run(state, random_lobes(), [](const SggxMatrix& S) { return second_moment_of(S); });
}
void sample(benchmark::State& state) {
    CounterRandom random{1, 2};
    std::vector<SggxFactor> factors;
    for (const SggxMatrix& S : random_lobes()) factors.push_back(factor(S));
    run(state, factors, [&](const SggxFactor& A) { return sample_ndf(A, random); });
}

BENCHMARK(fit);
BENCHMARK(pack_lobe);
BENCHMARK(fit_and_pack);
BENCHMARK(eigenvectors);
BENCHMARK(moment);
BENCHMARK(sample);

} // namespace
