#include "modeler/outline.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <polyclipping/clipper.hpp>

#include "modeler/outline_snap.hh"
#include "modeler/outline_split.hh"

namespace maille::modeler {
namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

/// Clipper counts in whole numbers: a grid of 2^52 steps to the greatest coordinate, and the way back from a
/// grid point to the very corner that it stands for.
class Grid {
  public:
    explicit Grid(std::span<const Outline> shapes) {
        double greatest = 0;
        for (const Outline& shape : shapes)
            for (const PlaneRegion& region : shape)
                for (const PlaneLoop& loop : region)
                    for (const Point2& p : loop) greatest = std::max(greatest, p.cwiseAbs().maxCoeff());
        constexpr int bits = 52;
        exponent_ = greatest > 0 ? bits - std::ilogb(greatest) - 1 : 0;
    }

    ClipperLib::cInt steps(double length) const { return std::llround(std::ldexp(length, exponent_)); }
    double in_steps(double length) const { return std::ldexp(length, exponent_); }

    Paths paths(const Outline& shape) {
        Paths result;
        for (const PlaneRegion& region : shape)
            for (const PlaneLoop& loop : region) result.push_back(path(loop));
        return result;
    }

    Outline outline(const ClipperLib::PolyTree& tree) const {
        Outline result;
        add_regions(tree, result);
        return result;
    }

  private:
    Path path(const PlaneLoop& loop) {
        Path result;
        for (const Point2& p : loop) {
            const IntPoint at(steps(p.x()), steps(p.y()));
            corners_.try_emplace({at.X, at.Y}, p);
            result.push_back(at);
        }
        return result;
    }

    PlaneLoop loop(const Path& path) const {
        PlaneLoop result;
        for (const IntPoint& at : path) {
            const auto corner = corners_.find({at.X, at.Y});
            result.push_back(corner != corners_.end()
                                 ? corner->second
                                 : Point2(std::ldexp(static_cast<double>(at.X), -exponent_),
                                          std::ldexp(static_cast<double>(at.Y), -exponent_)));
        }
        return result;
    }

    /// Outlines stand at every other level of the tree, their holes below them.
    void add_regions(const ClipperLib::PolyNode& node, Outline& result) const {
        for (const ClipperLib::PolyNode* outer : node.Childs) {
            PlaneRegion region{loop(outer->Contour)};
            for (const ClipperLib::PolyNode* hole : outer->Childs) region.push_back(loop(hole->Contour));
            result.push_back(std::move(region));
            for (const ClipperLib::PolyNode* hole : outer->Childs) add_regions(*hole, result);
        }
    }

    int exponent_ = 0;
    std::map<std::pair<ClipperLib::cInt, ClipperLib::cInt>, Point2> corners_;
};

Outline clip(Grid& grid, ClipperLib::ClipType type, const Outline& subject, std::span<const Outline> others,
             ClipperLib::PolyFillType fill = ClipperLib::pftNonZero) {
    ClipperLib::Clipper clipper;
    clipper.StrictlySimple(true);
    clipper.AddPaths(grid.paths(subject), ClipperLib::ptSubject, true);
    for (const Outline& other : others) clipper.AddPaths(grid.paths(other), ClipperLib::ptClip, true);
    ClipperLib::PolyTree tree;
    clipper.Execute(type, tree, fill, fill);
    return grid.outline(tree);
}

std::vector<Outline> made_flush(std::span<const Outline> shapes) {
    Eigen::AlignedBox2d box;
    for (const Outline& shape : shapes)
        for (const PlaneRegion& region : shape)
            for (const PlaneLoop& loop : region)
                for (const Point2& p : loop) box.extend(p);
    if (box.isEmpty()) return {shapes.begin(), shapes.end()};
    return snapped(shapes, written_precision * box.diagonal().norm());
}

/// Without crossings so near to each other that rounding would make one of them.
Outline tidied(const Outline& shape) {
    const std::vector<Outline> flush = made_flush(std::span(&shape, 1));
    Grid grid(flush);
    const Outline united = clip(grid, ClipperLib::ctUnion, flush.front(), {});
    return split_where_touching(made_flush(std::span(&united, 1)).front());
}

double cross(const Point2& origin, const Point2& a, const Point2& b) {
    const Point2 u = a - origin, v = b - origin;
    return u.x() * v.y() - u.y() * v.x();
}

}  // namespace

Outline make_outline(const std::vector<PlaneLoop>& loops) {
    const Outline crossing{loops};
    const std::vector<Outline> flush = made_flush(std::span(&crossing, 1));
    Grid grid(flush);
    return tidied(clip(grid, ClipperLib::ctUnion, flush.front(), {}, ClipperLib::pftEvenOdd));
}

Outline combine(Operation operation, std::span<const Outline> shapes) {
    if (shapes.empty()) return {};
    const std::vector<Outline> flush = made_flush(shapes);
    Grid grid(flush);
    const std::span<const Outline> others = std::span(flush).subspan(1);
    switch (operation) {
        case Operation::intersection: {
            Outline result = flush.front();
            for (const Outline& other : others)
                result = clip(grid, ClipperLib::ctIntersection, result, std::span(&other, 1));
            return tidied(result);
        }
        case Operation::difference:
            return tidied(clip(grid, ClipperLib::ctDifference, flush.front(), others));
        default:
            return tidied(clip(grid, ClipperLib::ctUnion, flush.front(), others));
    }
}

Outline transformed(Outline shape, const Eigen::Affine2d& map) {
    const bool is_mirrored = map.linear().determinant() < 0;
    for (PlaneRegion& region : shape)
        for (PlaneLoop& loop : region) {
            for (Point2& p : loop) p = map * p;
            if (is_mirrored) std::ranges::reverse(loop);
        }
    return shape;
}

Outline offset(const Outline& shape, double distance, OffsetCorners corners, double arc_tolerance) {
    constexpr double no_limit = 1e6;  // of a mitred corner's length, in units of the distance
    Grid grid(std::span(&shape, 1));
    const ClipperLib::JoinType join = corners == OffsetCorners::round    ? ClipperLib::jtRound
                                      : corners == OffsetCorners::mitred ? ClipperLib::jtMiter
                                                                         : ClipperLib::jtSquare;
    ClipperLib::ClipperOffset offsetter(no_limit, grid.in_steps(arc_tolerance));
    offsetter.AddPaths(grid.paths(shape), join, ClipperLib::etClosedPolygon);
    ClipperLib::PolyTree tree;
    offsetter.Execute(tree, grid.in_steps(distance));
    return tidied(grid.outline(tree));
}

/// By Andrew's monotone chain.
Outline convex_hull(std::span<const Outline> shapes) {
    PlaneLoop points;
    for (const Outline& shape : shapes)
        for (const PlaneRegion& region : shape)
            points.insert(points.end(), region.front().begin(), region.front().end());
    std::ranges::sort(points, {}, [](const Point2& p) { return std::pair(p.x(), p.y()); });
    const auto half = [](auto begin, auto end) {
        PlaneLoop chain;
        for (auto p = begin; p != end; ++p) {
            while (chain.size() >= 2 && cross(chain[chain.size() - 2], chain.back(), *p) <= 0)
                chain.pop_back();
            chain.push_back(*p);
        }
        if (!chain.empty()) chain.pop_back();
        return chain;
    };
    PlaneLoop hull = half(points.begin(), points.end());
    const PlaneLoop upper = half(points.rbegin(), points.rend());
    hull.insert(hull.end(), upper.begin(), upper.end());
    if (hull.size() < 3) return {};
    return {{std::move(hull)}};
}

}  // namespace maille::modeler
