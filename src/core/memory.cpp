#include "core/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace lightsieve {

namespace {

constexpr std::size_t kUnknown = std::numeric_limits<std::size_t>::max();

/// The first number after `key` in a file of words; kUnknown if there is none ("max" stands for no limit).
std::size_t number_in(const std::string& path, const std::string& key = "") {
    std::ifstream in(path);
    std::string word;
    while (!key.empty() && in >> word && word != key) {
    }
    std::size_t number = kUnknown;
    return in >> number ? number : kUnknown;
}

/// A line of the process's status [bytes].
std::size_t status_of(const std::string& root, const char* key) {
    const std::size_t kilobytes = number_in(root + "/proc/self/status", key);
    return kilobytes == kUnknown ? 0 : kilobytes * 1024;
}

}  // namespace

std::size_t resident_memory(const std::string& root) { return status_of(root, "VmRSS:"); }
std::size_t peak_memory(const std::string& root) { return status_of(root, "VmHWM:"); }

void release_freed_memory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

std::size_t available_memory(const std::string& root) {
    const std::size_t kilobytes = number_in(root + "/proc/meminfo", "MemAvailable:");
    std::size_t bytes = kilobytes == kUnknown ? kUnknown : kilobytes * 1024;
    // A container sees its own control group as the root.
    const std::string group = root + "/sys/fs/cgroup/memory.";
    const std::size_t limit = number_in(group + "max"), used = number_in(group + "current");
    if (limit != kUnknown && used != kUnknown)
        bytes = std::min(bytes, limit - std::min(limit, used));
    return bytes;
}

}  // namespace lightsieve
