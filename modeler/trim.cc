#include "modeler/trim.hh"

#include <algorithm>
#include <limits>

#include "modeler/shape_cone.hh"
#include "modeler/shape_polyhedron.hh"

namespace maille::modeler {
namespace {

using Box = Eigen::AlignedBox3d;

/// By primitive: a box around all places where it matters whether they are inside it, and as far again as the
/// smallest primitive is large: solids that only touch matter to each other in no more than a point.
class Reaches {
  public:
    explicit Reaches(const Model& model) : model_(model), reaches_(model.primitives.size()) {
        visit(model.tree, bounding_box(model));
        double margin = std::numeric_limits<double>::infinity();
        for (const Primitive& primitive : model.primitives)
            margin = std::min(margin, primitive.shape->bounding_box().diagonal().norm());
        for (Box& reach : reaches_)
            if (!reach.isEmpty()) reach = {reach.min().array() - margin, reach.max().array() + margin};
    }

    const Box& of(std::size_t primitive) const { return reaches_[primitive]; }

  private:
    void visit(const CsgTree& tree, const Box& reach) {
        if (tree.operation == Operation::leaf) reaches_[tree.primitive].extend(reach);
        for (std::size_t i = 0; i < tree.children.size(); ++i)
            visit(tree.children[i], within(tree, i, reach));
    }

    /// Where the child matters, if its parent does within `reach`.
    Box within(const CsgTree& tree, std::size_t child, Box reach) const {
        for (std::size_t i = 0; i < tree.children.size(); ++i) {
            const bool bounds = tree.operation == Operation::intersection ||
                                (tree.operation == Operation::difference && i == 0);
            if (bounds && i != child)
                reach = reach.intersection(bounding_box(tree.children[i], model_.primitives));
        }
        return reach.isEmpty() ? Box() : reach;
    }

    const Model& model_;
    std::vector<Box> reaches_;
};

/// How far along a direction of length 1 something that matters within a box has to go; nothing where it ends
/// little beyond that already, at `end`.
std::optional<double> nearer_end(const Box& reach, const Point& direction, double end) {
    const double size = reach.diagonal().norm();
    const double needed = direction.dot(reach.center()) + 0.5 * direction.cwiseAbs().dot(reach.sizes());
    return end > needed + size ? std::optional(needed + size / 2) : std::nullopt;
}

/// The polyhedron's points, with some moved along edges.
class PolyhedronTrim {
  public:
    explicit PolyhedronTrim(const Polyhedron& shape)
        : shape_(shape), points_(shape.points().begin(), shape.points().end()), neighbours_(points_.size()) {
        for (std::uint32_t f = 0; f < shape.faces().size(); ++f) {
            loops_.push_back(shape.polygon(f).loops);
            for (const auto& loop : loops_.back())
                for (std::size_t k = 0; k < loop.size(); ++k)
                    neighbours_[loop[k]].push_back(loop[(k + 1) % loop.size()]);
        }
    }

    /// Moves what is beyond the plane normal * p = end into that plane, if each point there has one edge that
    /// comes from before it.
    void move_in(const Point& normal, double end) {
        const auto is_beyond = [&](std::uint32_t v) { return normal.dot(points_[v]) > end; };
        std::vector<std::pair<std::uint32_t, Point>> moved;
        for (std::uint32_t v = 0; v < points_.size(); ++v) {
            if (!is_beyond(v)) continue;
            std::optional<std::uint32_t> before;
            for (const std::uint32_t n : neighbours_[v]) {
                if (is_beyond(n)) continue;
                if (before) return;
                before = n;
            }
            if (!before) return;
            const Point from = points_[*before], way = points_[v] - from;
            moved.emplace_back(v, from + (end - normal.dot(from)) / normal.dot(way) * way);
        }
        std::vector<Point> points = points_;
        for (const auto& [v, p] : moved) points[v] = p;
        for (const auto& loops : loops_)
            if (std::ranges::all_of(loops.front(), is_beyond) && normal.dot(area_vector(points, loops)) <= 0)
                return;  // an arch that would be pressed flat
        points_ = std::move(points);
        is_changed_ = is_changed_ || !moved.empty();
    }

    std::shared_ptr<const Shape> shape() const {
        if (!is_changed_) return nullptr;
        std::vector<Polyhedron::Polygon> polygons;
        for (std::uint32_t f = 0; f < shape_.faces().size(); ++f) polygons.push_back(shape_.polygon(f));
        return std::make_shared<Polyhedron>(points_, std::move(polygons));
    }

  private:
    const Polyhedron& shape_;
    std::vector<Point> points_;
    std::vector<std::vector<std::vector<std::uint32_t>>> loops_;  // by face
    std::vector<std::vector<std::uint32_t>> neighbours_;
    bool is_changed_ = false;
};

std::shared_ptr<const Shape> trimmed(const Polyhedron& shape, const Box& reach) {
    PolyhedronTrim trim(shape);
    for (std::uint32_t f = 0; f < shape.faces().size(); ++f) {
        const Point normal = shape.plane(f).normal();
        if (const auto end = nearer_end(reach, normal, normal.dot(shape.plane(f).origin())))
            trim.move_in(normal, *end);
    }
    return trim.shape();
}

std::shared_ptr<const Shape> trimmed(const Cone& shape, const Box& reach) {
    const Point up = shape.map().linear().inverse().transpose().col(2);
    const Point axis = shape.map().linear().col(2);
    std::array<double, 2> ends{0, 1};
    for (const bool top : {false, true}) {
        if (!shape.cap(top)) continue;
        const Point normal = (top ? up : Point(-up)).normalized();
        const double end = normal.dot(shape.map() * Point(0, 0, top));
        if (const auto nearer = nearer_end(reach, normal, end))
            ends[top] -= (end - *nearer) / normal.dot(axis);
    }
    if (ends == std::array<double, 2>{0, 1} || !(ends[0] < ends[1])) return nullptr;
    const double r1 = shape.radius(ends[0]), r2 = shape.radius(ends[1]), largest = std::max(r1, r2);
    Eigen::Affine3d map = shape.map();
    map.translation() += ends[0] * axis;
    map.linear().col(2) = (ends[1] - ends[0]) * axis;
    map.linear().leftCols<2>() *= largest;
    return std::make_shared<Cone>(r1 / largest, r2 / largest, map);
}

std::shared_ptr<const Shape> trimmed(const Shape& shape, const Box& reach) {
    if (const auto* polyhedron = dynamic_cast<const Polyhedron*>(&shape)) return trimmed(*polyhedron, reach);
    if (const auto* cone = dynamic_cast<const Cone*>(&shape)) return trimmed(*cone, reach);
    return nullptr;
}

}  // namespace

Model trimmed(const Model& model) {
    Model result = model;
    const Reaches reaches(model);
    for (std::size_t i = 0; i < model.primitives.size(); ++i)
        if (!reaches.of(i).isEmpty())
            if (auto shape = trimmed(*model.primitives[i].shape, reaches.of(i)))
                result.primitives[i].shape = std::move(shape);
    return result;
}

}  // namespace maille::modeler
