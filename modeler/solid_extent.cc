#include "modeler/solid_extent.hh"

#include <algorithm>
#include <cmath>

#include "modeler/arrange.hh"
#include "modeler/closed_surface.hh"
#include "modeler/tessellate.hh"

namespace maille::modeler {
namespace {

/// Whether the solid is all of its primitives together, so that nothing has to be cut.
bool is_union(const CsgTree& tree) {
    switch (tree.operation) {
        case Operation::intersection:
        case Operation::difference:
            return false;
        default:
            return std::ranges::all_of(tree.children, is_union);
    }
}

ClosedSurface surface_of(const Primitive& primitive, double chord_tolerance) {
    if (const auto* polyhedron = dynamic_cast<const Polyhedron*>(primitive.shape.get()))
        return closed_surface(*polyhedron);
    constexpr double edges_across = 40;
    const double size = primitive.shape->bounding_box().diagonal().norm() / edges_across;
    return closed_surface(tessellate(primitive, {.size = size, .chord_tolerance = chord_tolerance}), 0);
}

std::vector<Point> points(const Model& model, double chord_tolerance) {
    std::vector<ClosedSurface> surfaces;
    for (const Primitive& primitive : model.primitives)
        surfaces.push_back(surface_of(primitive, chord_tolerance));
    std::vector<Point> result;
    if (is_union(model.tree)) {
        for (const ClosedSurface& surface : surfaces)
            result.insert(result.end(), surface.points.begin(), surface.points.end());
        return result;
    }
    const FacetComplex complex = arrange(surfaces, model.tree).complex;
    std::vector<bool> on_boundary(complex.points.size(), false);
    for (const Facet& facet : complex.facets)
        if (facet.front == outside || facet.back == outside)
            for (const std::uint32_t v : facet.vertices) on_boundary[v] = true;
    for (std::size_t v = 0; v < on_boundary.size(); ++v)
        if (on_boundary[v]) result.push_back(complex.points[v]);
    return result;
}

/// `value`, or the true end of a primitive that it comes near to: facets end somewhat short of round
/// surfaces.
double true_end(double value, const Model& model, double tolerance, int axis) {
    double best = value, nearest = tolerance;
    for (const Primitive& primitive : model.primitives) {
        const Eigen::AlignedBox3d box = primitive.shape->bounding_box();
        for (const double end : {box.min()[axis], box.max()[axis]})
            if (std::abs(end - value) < nearest) nearest = std::abs((best = end) - value);
    }
    return best;
}

}  // namespace

std::vector<Point> boundary_points(const Model& model) {
    return points(model, 0);
}

Eigen::AlignedBox3d solid_box(const Model& model) {
    Eigen::AlignedBox3d box;
    for (const Primitive& primitive : model.primitives) box.extend(primitive.shape->bounding_box());
    if (box.isEmpty() || is_union(model.tree)) return box;
    const double tolerance = 1e-4 * box.diagonal().norm();
    box.setEmpty();
    for (const Point& p : points(model, tolerance)) box.extend(p);
    if (box.isEmpty()) return box;
    for (int axis = 0; axis < 3; ++axis) {
        box.min()[axis] = true_end(box.min()[axis], model, 2 * tolerance, axis);
        box.max()[axis] = true_end(box.max()[axis], model, 2 * tolerance, axis);
    }
    return box;
}

}  // namespace maille::modeler
