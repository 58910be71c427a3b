#include "tools/maille/progress.hh"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace maille::tools {

Progress::Progress(const CommonOptions& options, int n_steps)
    : has_bar_(!options.quiet && isatty(STDERR_FILENO) != 0),
      is_quiet_(options.quiet),
      is_verbose_(options.verbose),
      n_steps_(n_steps) {}

void Progress::done() {
    wipe();
}

void Progress::step(const std::string& name) {
    ++step_;
    name_ = name;
    log(name);
    draw({});
}

void Progress::note(const std::string& text) {
    log(fmt::format("{}: {}", name_, text));
    draw(text);
}

void Progress::warn(const std::string& line) {
    if (!is_quiet_) print(fmt::format("warning: {}", line));
}

void Progress::log(const std::string& line) {
    if (is_verbose_) print(line);
}

void Progress::print(const std::string& line) {
    wipe();
    fmt::print(stderr, "maille: {}\n", line);
}

void Progress::draw(const std::string& note) const {
    if (!has_bar_) return;
    constexpr int width = 24;
    const int done = width * (step_ - 1) / n_steps_;
    wipe();
    fmt::print(stderr, "[{:=<{}}>{:{}}] {}{}{}", "", done, "", width - done, name_, note.empty() ? "" : ": ",
               note);
    std::fflush(stderr);
}

void Progress::wipe() const {
    if (has_bar_) fmt::print(stderr, "\r\x1b[K");
}

}  // namespace maille::tools
