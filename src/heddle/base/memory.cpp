#include <heddle/base/memory.h>

#include <fstream>
#include <string>

namespace heddle {
namespace {

/// Value of the line "KEY:   N kB" of a /proc file, in bytes; 0 if there is none.
std::int64_t proc_bytes(const char* path, const std::string& key) {
    std::ifstream in(path);
    for (std::string word; in >> word;) {
        std::int64_t kib = 0;
        if (word == key && in >> kib) return kib * 1024;
    }
    return 0;
}

} // namespace

std::int64_t peak_resident_bytes() {
    return proc_bytes("/proc/self/status", "VmHWM:");
}
std::int64_t available_bytes() {
    return proc_bytes("/proc/meminfo", "MemAvailable:");
}

} // namespace heddle
