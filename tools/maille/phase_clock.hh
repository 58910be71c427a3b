#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string_view>

#include <nlohmann/json.hpp>

namespace maille::tools {

enum class Phase : std::uint8_t { read, primitives, merge, refine, improve, write };
inline constexpr std::array<std::string_view, 6> phase_names{"read",   "primitives", "merge",
                                                             "refine", "improve",    "write"};

struct Seconds {
    double cpu = 0;  ///< of all threads and of the processes that were waited for
    double wall = 0;
};

/// Seconds of this process so far.
Seconds seconds_now();

/// Adds up the time that each phase takes.
class PhaseClock {
  public:
    PhaseClock() : since_(seconds_now()) {}

    /// The time since the last call, or since the beginning, was this phase's.
    void end(Phase phase);
    /// Time that was measured elsewhere; `skip` then drops the time since the last call.
    void add(Phase phase, const Seconds& seconds);
    void skip() { since_ = seconds_now(); }

    const Seconds& operator[](Phase phase) const { return spent_[static_cast<std::size_t>(phase)]; }
    Seconds total() const;
    /// `cpu_seconds` and `wall_seconds`, each by phase.
    void write_to(nlohmann::ordered_json& json) const;

  private:
    std::array<Seconds, phase_names.size()> spent_{};
    Seconds since_;
};

}  // namespace maille::tools
