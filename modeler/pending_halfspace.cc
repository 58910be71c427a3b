#include "modeler/pending_halfspace.hh"

#include "modeler/shapes.hh"
#include "modeler/tree_building.hh"

namespace maille::modeler {
namespace {

/// Larger than the box, so that no face of the piece but its plane comes near a solid, and cut by the plane.
Eigen::AlignedBox3d clip_box(Eigen::AlignedBox3d box, const PendingHalfspace& halfspace) {
    const Point center = box.center();
    const double distance = halfspace.normal.dot(center - halfspace.point);
    box.extend(Point(center - distance * halfspace.normal));
    const Point margin = Point::Constant(box.diagonal().norm() / 10);
    return {box.min() - margin, box.max() + margin};
}

}  // namespace

std::optional<std::uint32_t> shape_halfspaces(Model& model, std::span<const PendingHalfspace> halfspaces) {
    const auto is_halfspace = [&](std::uint32_t i) { return model.primitives[i].shape == nullptr; };
    if (const auto culprit = unbounded_leaf(model.tree, is_halfspace)) return culprit;
    Eigen::AlignedBox3d box;
    for (const Primitive& primitive : model.primitives)
        if (primitive.shape) box.extend(primitive.shape->bounding_box());
    for (const PendingHalfspace& halfspace : halfspaces)
        model.primitives[halfspace.primitive].shape =
            make_halfspace(halfspace.point, halfspace.normal, clip_box(box, halfspace));
    return std::nullopt;
}

}  // namespace maille::modeler
