#pragma once

#include <chrono>

#include "modeler/build_report.hh"

namespace maille::modeler {

/// Processor time of this program and of the processes that it ran and waited for.
double processor_seconds();

/// Adds the time of its life to a phase.
class PhaseTimer {
  public:
    explicit PhaseTimer(PhaseTime& phase) : phase_(phase) {}
    PhaseTimer(const PhaseTimer&) = delete;
    PhaseTimer& operator=(const PhaseTimer&) = delete;
    ~PhaseTimer() {
        phase_.cpu_seconds += processor_seconds() - cpu_;
        phase_.wall_seconds +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
    }

  private:
    PhaseTime& phase_;
    double cpu_ = processor_seconds();
    std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

}  // namespace maille::modeler
