#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "modeler/arrange_crossings.hh"
#include "modeler/arrange_kernel.hh"
#include "modeler/arrange_planes.hh"
#include "modeler/arrange_projection.hh"
#include "modeler/arrange_registry.hh"

namespace maille::modeler::detail {

/// Straight segments in one plane, to be cut where they meet each other. Which points lie on a segment is
/// mostly known from how they came about; being told that spares expensive proofs.
class FlatLines {
  public:
    /// `plane` holds all points that will be added; `number` is what the crossings know it by.
    FlatLines(const ExactPositions& positions, const Projection& projection, ExactPlane plane,
              std::uint32_t number, PlaneCrossings& crossings, PointRegistry& registry)
        : positions_(positions),
          projection_(projection),
          plane_(std::move(plane)),
          number_(number),
          crossings_(crossings),
          registry_(registry) {}

    /// The number of the segment between two different points of the registry, whichever way it runs.
    /// `across`: another plane that holds it, if one is known.
    std::uint32_t add(std::uint32_t from, std::uint32_t to, std::uint32_t across = none);
    /// The number of the segment with these ends (see edge_key), or none.
    std::uint32_t find(std::uint64_t ends) const;
    /// Tells that a point lies on the segment.
    void put(std::uint32_t line, std::uint32_t point) { lines_[line].points.push_back(point); }

    /// Finds all points in which segments meet, registers those that are new, and sorts the points of every
    /// segment from its lower end, by the registry's numbers, to the other.
    void cut();

    std::uint32_t size() const { return static_cast<std::uint32_t>(lines_.size()); }
    /// The points on the segment. After cut().
    std::span<const std::uint32_t> points(std::uint32_t line) const { return lines_[line].points; }
    /// The image of a point in the plane.
    const Exact::Point_2& flat(std::uint32_t point);

  private:
    struct Line {
        std::uint32_t from, to;
        std::vector<std::uint32_t> points;
        std::uint32_t across;
        double dx = 0, dy = 0;  ///< about where it runs to; zero where doubles cannot tell
        bool has(std::uint32_t point) const;
        void insert(std::uint32_t point);
    };

    void prepare(Line& line);
    void meet(Line& a, Line& b);
    void order(Line& line);
    std::uint32_t crossing(const Line& a, const Line& b);
    std::uint32_t new_crossing(const Line& a, const Line& b);
    CGAL::Sign turn(const Line& line, std::uint32_t point);

    const ExactPositions& positions_;
    const Projection& projection_;
    ExactPlane plane_;
    std::uint32_t number_;
    PlaneCrossings& crossings_;
    PointRegistry& registry_;
    std::vector<Line> lines_;
    std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  ///< of the lines, by their ends
    std::unordered_map<std::uint32_t, Exact::Point_2> flat_;
};

}  // namespace maille::modeler::detail
