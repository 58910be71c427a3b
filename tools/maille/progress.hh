#pragma once

#include <string>

#include "tools/maille/common_options.hh"

namespace maille::tools {

/// Says on stderr how far the work is: a bar that is drawn over and over where stderr is a terminal, a line a
/// step with --verbose; and warnings.
class Progress {
  public:
    Progress(const CommonOptions& options, int n_steps);
    ~Progress() { done(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Wipes the bar away, before results are printed.
    void done();

    void step(const std::string& name);
    /// What the step has come to: "pass 3, 12000 cells".
    void note(const std::string& text);
    /// A line that stays: with --verbose; always but with --quiet.
    void log(const std::string& line);
    void warn(const std::string& line);

  private:
    void print(const std::string& line);
    void draw(const std::string& note) const;
    void wipe() const;

    bool has_bar_;
    bool is_quiet_;
    bool is_verbose_;
    int n_steps_;
    int step_ = 0;
    std::string name_;
};

}  // namespace maille::tools
