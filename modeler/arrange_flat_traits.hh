#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "modeler/arrange_kernel.hh"

namespace maille::modeler::detail {

/// Which points of a plane lie on common lines, by their numbers.
class KnownLines {
  public:
    void add_point() { lines_of_.emplace_back(); }
    /// Lines have to come in rising order.
    void put(std::uint32_t point, std::uint32_t line) { lines_of_[point].push_back(line); }

    bool are_on_one(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const auto& of_a = lines_of_[a];
        return std::ranges::any_of(of_a, [&](std::uint32_t line) {
            return std::ranges::binary_search(lines_of_[b], line) &&
                   std::ranges::binary_search(lines_of_[c], line);
        });
    }

  private:
    std::vector<std::vector<std::uint32_t>> lines_of_;
};

/// A point in a plane that is known by its number.
struct FlatPoint : Exact::Point_2 {
    FlatPoint() = default;
    FlatPoint(const Exact::Point_2& p, std::uint32_t n) : Exact::Point_2(p), number(n) {}
    std::uint32_t number = none;
};

/// The exact kernel for triangulating a plane: that points are on one line, which takes long to prove, is
/// looked up where it is known.
class FlatTraits : public Exact {
  public:
    using Point_2 = FlatPoint;

    class Orientation_2 {
      public:
        explicit Orientation_2(const KnownLines& known) : known_(&known) {}
        CGAL::Sign operator()(const Point_2& a, const Point_2& b, const Point_2& c) const {
            if (known_->are_on_one(a.number, b.number, c.number)) return CGAL::ZERO;
            return Exact().orientation_2_object()(a, b, c);
        }

      private:
        const KnownLines* known_;
    };

    struct Construct_point_2 {
        const Point_2& operator()(const Point_2& p) const { return p; }
    };

    explicit FlatTraits(const KnownLines& known) : known_(&known) {}
    Orientation_2 orientation_2_object() const { return Orientation_2(*known_); }
    Construct_point_2 construct_point_2_object() const { return {}; }

  private:
    const KnownLines* known_;
};

}  // namespace maille::modeler::detail
