#include "device_peaks.h"

#include <heddle/base/platform.h>
#include <heddle/executor/cuda_executor.cuh>
#include <heddle/executor/device.h>

#include <chrono>

namespace heddle::check {
namespace {

struct CopyOp {
    const ulonglong2* from;
    ulonglong2* to;
    HEDDLE_HD void operator()(std::size_t i) const { to[i] = from[i]; }
};

} // namespace

double copy_bandwidth() {
    if (executor::find_device().name.empty()) return 0.0;
    constexpr std::size_t kItems = std::size_t{1} << 26;
    executor::Budget budget(std::int64_t{4} << 30);
    executor::CudaExecutor exec(budget);
    const auto from = exec.make_zero<ulonglong2>(kItems);
    const auto to = exec.make_zero<ulonglong2>(kItems);
    exec.for_each(kItems, CopyOp{from.data(), to.data()});
    exec.wait();
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 10; ++i) exec.for_each(kItems, CopyOp{from.data(), to.data()});
    exec.wait();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    return 10.0 * 2.0 * 16.0 * static_cast<double>(kItems) / spent.count() * 1e-9;
}

double peak_gigaflops() {
    if (executor::find_device().name.empty()) return 0.0;
    int multiprocessors = 0;
    int kilohertz = 0;
    if (cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, 0) !=
            cudaSuccess ||
        cudaDeviceGetAttribute(&kilohertz, cudaDevAttrClockRate, 0) != cudaSuccess) {
        return 0.0;
    }
    constexpr double kLanes = 128.0; // per multiprocessor from 8.0 on; 7.5 has half
    return kLanes * multiprocessors * kilohertz * 1e-6;
}

} // namespace heddle::check
