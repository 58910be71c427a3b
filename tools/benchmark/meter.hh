#pragma once

#include <cstddef>

namespace maille::benchmark {

/// Seconds of this process so far: of its threads in user and in system mode together, those in system mode
/// alone, which are for memory that is touched first, and of the wall clock.
struct Seconds {
    double cpu = 0, system = 0, wall = 0;
    friend Seconds operator-(const Seconds& a, const Seconds& b) {
        return {a.cpu - b.cpu, a.system - b.system, a.wall - b.wall};
    }
};
Seconds now();

/// Bytes of memory that the process holds.
std::size_t resident_bytes();
/// The most that it has held since `forget_peak` was last called.
std::size_t peak_bytes();
/// Gives memory that is free back to the system, and measures the peak from here on.
void forget_peak();

}  // namespace maille::benchmark
