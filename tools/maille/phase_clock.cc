#include "tools/maille/phase_clock.hh"

#include <sys/resource.h>

namespace maille::tools {
namespace {

double cpu_seconds(int whose) {
    rusage usage{};
    getrusage(whose, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

Seconds seconds_now() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return {.cpu = cpu_seconds(RUSAGE_SELF) + cpu_seconds(RUSAGE_CHILDREN),
            .wall = std::chrono::duration<double>(now).count()};
}

void PhaseClock::end(Phase phase) {
    const Seconds now = seconds_now();
    add(phase, {.cpu = now.cpu - since_.cpu, .wall = now.wall - since_.wall});
    since_ = now;
}

void PhaseClock::add(Phase phase, const Seconds& seconds) {
    Seconds& spent = spent_[static_cast<std::size_t>(phase)];
    spent.cpu += seconds.cpu;
    spent.wall += seconds.wall;
}

Seconds PhaseClock::total() const {
    Seconds sum;
    for (const Seconds& spent : spent_) {
        sum.cpu += spent.cpu;
        sum.wall += spent.wall;
    }
    return sum;
}

void PhaseClock::write_to(nlohmann::ordered_json& json) const {
    for (std::size_t i = 0; i < phase_names.size(); ++i) {
        json["cpu_seconds"][phase_names[i]] = spent_[i].cpu;
        json["wall_seconds"][phase_names[i]] = spent_[i].wall;
    }
}

}  // namespace maille::tools
