#pragma once

#include <array>

#include "quality/objective.hh"
#include "quality/report.hh"

namespace maille::quality {

/// How long cells may be.
class SizeLimit {
  public:
    /// Without a size cells may be of any length.
    SizeLimit(const WantedSize* size, double ratio) : size_(size), ratio_(ratio) {}

    bool exists() const { return size_ != nullptr; }
    /// How far the longest edge is beyond `ratio` times the size at the centroid, at least 1.
    double excess(const std::array<Point, 4>& cell) const;
    /// Whether cells with these bases come to be no farther beyond it by a vertex's move.
    bool keeps(const Bases& bases, const Point& from, const Point& to) const;

  private:
    const WantedSize* size_;
    double ratio_;
};

}  // namespace maille::quality
