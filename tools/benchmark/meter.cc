#include "tools/benchmark/meter.hh"

#include <chrono>
#include <fstream>
#include <string>

#include <malloc.h>
#include <sys/resource.h>

namespace maille::benchmark {
namespace {

/// A line of the form `VmRSS:  1234 kB` of what Linux tells of the process.
std::size_t status_bytes(const std::string& name) {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word)
        if (word == name) {
            std::size_t kilobytes = 0;
            status >> kilobytes;
            return 1024 * kilobytes;
        }
    return 0;
}

double seconds(const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

}  // namespace

Seconds now() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    const double system = seconds(usage.ru_stime);
    return {seconds(usage.ru_utime) + system, system, std::chrono::duration<double>(wall).count()};
}

std::size_t resident_bytes() {
    return status_bytes("VmRSS:");
}

std::size_t peak_bytes() {
    return status_bytes("VmHWM:");
}

void forget_peak() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;
}

}  // namespace maille::benchmark
