#include "modeler/solid.hh"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "modeler/extrude.hh"
#include "modeler/language_transforms.hh"
#include "modeler/pending_halfspace.hh"
#include "modeler/tree_building.hh"
#include "volmesh/error.hh"

namespace maille::modeler {

/// A primitive, or an operation on children, under a change of name, material, size or place.
struct Solid::Node {
    std::string kind{};  ///< primitives only
    Maker make{};        ///< null: the half-space behind the plane through `point`
    Point point = Point::Zero(), normal = Point::Zero();
    Operation operation = Operation::leaf;
    std::vector<std::shared_ptr<const Node>> children{};
    std::string name{}, material{};
    double size = 0;
    Eigen::Affine3d map = Eigen::Affine3d::Identity();
};

/// Turns a solid into a model.
class SolidModeler {
  public:
    Model make(const Solid::Node& node) {
        model_.tree = tree_of(node, {});
        if (is_empty(model_.tree)) throw InputError("the model is empty: it has no solid");
        if (const auto culprit = shape_halfspaces(model_, halfspaces_))
            throw InputError(
                fmt::format("the half-space '{}' makes the model endless: intersect it with a "
                            "solid, or subtract it from one",
                            model_.primitives[*culprit].name));
        drop_unused_primitives(model_);
        return std::move(model_);
    }

  private:
    /// What a solid inherits from those around it.
    struct Context {
        std::string name{}, material{};
        double size = 0;
        Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    };

    CsgTree tree_of(const Solid::Node& node, Context context) {
        if (!node.name.empty()) context.name = node.name;
        if (!node.material.empty()) context.material = node.material;
        if (node.size > 0) context.size = node.size;
        context.frame = context.frame * node.map;
        if (node.operation == Operation::leaf) return add_primitive(node, context);
        std::vector<CsgTree> children;
        for (const auto& child : node.children) children.push_back(tree_of(*child, context));
        return combine(node.operation, std::move(children));
    }

    CsgTree add_primitive(const Solid::Node& node, const Context& context) {
        const auto index = static_cast<std::uint32_t>(model_.primitives.size());
        if (!node.make)
            halfspaces_.push_back(
                {.primitive = index,
                 .point = context.frame * node.point,
                 .normal = (context.frame.linear().inverse().transpose() * node.normal).stableNormalized()});
        model_.primitives.push_back(
            {.shape = node.make ? node.make(context.frame) : nullptr,
             .name = context.name.empty() ? fmt::format("{}{}", node.kind, index + 1) : context.name,
             .material = context.material,
             .size = context.size});
        return {.operation = Operation::leaf, .primitive = index};
    }

    Model model_;
    std::vector<PendingHalfspace> halfspaces_;
};

namespace {

void check_name(const std::string& name) {
    const auto bad = [](char c) { return c == '/' || c == '"' || static_cast<unsigned char>(c) < ' '; };
    if (name.empty() || std::ranges::any_of(name, bad))
        throw InputError(fmt::format(
            "'{}' cannot be a name: it must not be empty, nor have a slash, quotes or line breaks", name));
}

}  // namespace

/// The solid in a node that changes it.
Solid Solid::changed(Node node) const {
    node.operation = Operation::join;
    node.children = {node_};
    return Solid(std::make_shared<const Node>(std::move(node)));
}

Solid Solid::named(std::string name) const {
    check_name(name);
    return changed({.name = std::move(name)});
}

Solid Solid::of(std::string material) const {
    check_name(material);
    return changed({.material = std::move(material)});
}

Solid Solid::size(double edge_length) const {
    if (!(edge_length > 0)) throw InputError(fmt::format("the size has to be positive, not {}", edge_length));
    return changed({.size = edge_length});
}

Solid Solid::mapped(const Eigen::Affine3d& map) const {
    if (!is_regular(map)) throw InputError("the map flattens the solid or has no inverse");
    return changed({.map = map});
}

Solid Solid::at(const Point& by) const {
    return mapped(Eigen::Affine3d(Eigen::Translation3d(by)));
}

Solid Solid::rotated(double degrees, const Point& axis) const {
    if (axis.isZero(0)) throw InputError("the axis of rotation must not be 0");
    return mapped(Eigen::Affine3d(rotation(axis, degrees)));
}

Solid Solid::scaled(const Point& factors) const {
    return mapped(Eigen::Affine3d(Eigen::Scaling(factors)));
}

Solid Solid::mirrored(const Point& normal) const {
    if (normal.isZero(0)) throw InputError("the normal of the mirror must not be 0");
    return mapped(Eigen::Affine3d(mirror_image(normal)));
}

Model Solid::model() const {
    return SolidModeler().make(*node_);
}

/// (a - b) - c is a - b - c in one node, and so on, so that long sums are not deep.
Solid Solid::combined(Operation operation, const Solid& a, const Solid& b) {
    const Node& left = *a.node_;
    const bool continues = left.operation == operation && left.name.empty() && left.material.empty() &&
                           left.size == 0 && left.map.matrix().isIdentity(0);
    Node node{.operation = operation};
    if (continues)
        node.children = left.children;
    else
        node.children.push_back(a.node_);
    node.children.push_back(b.node_);
    return Solid(std::make_shared<const Node>(std::move(node)));
}

Solid operator+(const Solid& a, const Solid& b) {
    return Solid::combined(Operation::join, a, b);
}
Solid operator-(const Solid& a, const Solid& b) {
    return Solid::combined(Operation::difference, a, b);
}
Solid operator&(const Solid& a, const Solid& b) {
    return Solid::combined(Operation::intersection, a, b);
}
Solid operator|(const Solid& a, const Solid& b) {
    return Solid::combined(Operation::fragment, a, b);
}

Solid Solid::primitive(std::string kind, Maker make) {
    make(Eigen::Affine3d::Identity());  // throws what is wrong with it now
    return Solid(std::make_shared<const Node>(Node{.kind = std::move(kind), .make = std::move(make)}));
}

Solid halfspace(const Point& point, const Point& normal) {
    if (normal.isZero(0)) throw InputError("the normal must not be 0");
    return Solid(std::make_shared<const Solid::Node>(
        Solid::Node{.kind = "halfspace", .point = point, .normal = normal}));
}

Solid box(const Point& size, bool center) {
    return Solid::primitive("box", [=](const auto& frame) { return make_cube(size, center, frame); });
}

Solid sphere(double radius) {
    return Solid::primitive("sphere", [=](const auto& frame) { return make_sphere(radius, frame); });
}

Solid ellipsoid(const Point& semi_axes) {
    return Solid::primitive("ellipsoid", [=](const auto& frame) { return make_ellipsoid(semi_axes, frame); });
}

Solid cylinder(double height, double radius, bool center) {
    return Solid::primitive(
        "cylinder", [=](const auto& frame) { return make_cylinder(height, radius, radius, center, frame); });
}

Solid cone(double height, double bottom_radius, double top_radius, bool center) {
    return Solid::primitive("cone", [=](const auto& frame) {
        return make_cylinder(height, bottom_radius, top_radius, center, frame);
    });
}

Solid torus(double major, double minor) {
    return Solid::primitive("torus", [=](const auto& frame) { return make_torus(major, minor, frame); });
}

Solid wedge(const Point& size, double dx) {
    return Solid::primitive("wedge", [=](const auto& frame) { return make_wedge(size, dx, frame); });
}

Solid prism(int n, double radius, double height) {
    return Solid::primitive("prism", [=](const auto& frame) { return make_prism(n, radius, height, frame); });
}

Solid pyramid(int n, double radius, double height) {
    return Solid::primitive("pyramid",
                            [=](const auto& frame) { return make_pyramid(n, radius, height, frame); });
}

Solid tetrahedron(const std::array<Point, 4>& points) {
    return Solid::primitive("tetrahedron",
                            [=](const auto& frame) { return make_tetrahedron(points, frame); });
}

Solid polyhedron(std::vector<Point> points, std::vector<std::vector<std::uint32_t>> faces) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < faces.size(); ++i) names.push_back(fmt::format("face{}", i));
    return Solid::primitive("polyhedron",
                            [points = std::move(points), faces = std::move(faces), names](const auto& frame) {
                                return make_polyhedron(points, faces, names, frame);
                            });
}

Solid extruded(const PlaneRegion& region, double height) {
    return Solid::primitive(
        "extruded", [=](const auto& frame) { return linear_extrude(region, {.height = height}, 0, frame); });
}

Solid turned(const PlaneRegion& region, double angle) {
    return Solid::primitive("turned",
                            [=](const auto& frame) { return rotate_extrude_round(region, angle, 0, frame); });
}

}  // namespace maille::modeler
