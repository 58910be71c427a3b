#include "modeler/language_extrude.hh"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "modeler/arguments.hh"
#include "modeler/extrude.hh"
#include "modeler/language_facets.hh"
#include "modeler/language_outline.hh"
#include "modeler/language_transforms.hh"
#include "modeler/name_table.hh"
#include "modeler/shapes.hh"

namespace maille::modeler {
namespace {

bool is_round_circle(const Node& node, const std::string& file, Facets facets) {
    return node.name == "circle" && !keeps_facets(facets, facet_settings(Arguments(node, file, {"r", "d"})));
}

/// Whether a circle in the nodes can become a true cylinder.
bool has_round_circle(const std::vector<Node>& nodes, const std::string& file, Facets facets) {
    return std::ranges::any_of(nodes, [&](const Node& node) {
        if (node.ignored || node.name == "offset" || node.name == "hull") return false;
        return is_round_circle(node, file, facets) || has_round_circle(node.children, file, facets);
    });
}

/// One solid for each region.
template <class Extrude>
ShapeTree solids_of(const Arguments& arguments, const Outline& outline, const Extrude& extrude) {
    ShapeTree solids{.operation = Operation::join, .shape = nullptr};
    std::size_t first_side = 0;
    for (const PlaneRegion& region : outline) {
        solids.children.push_back({.operation = Operation::leaf,
                                   .shape = at_node(arguments, [&] { return extrude(region, first_side); })});
        for (const PlaneLoop& loop : region) first_side += loop.size();
    }
    return solids;
}

/// Extrudes each flat shape by itself, and combines the solids as the shapes are combined.
class RoundExtruder {
  public:
    RoundExtruder(const Arguments& arguments, const std::string& file, const Placement& placement,
                  const LinearExtrusion& extrusion)
        : arguments_(arguments), file_(file), placement_(placement), extrusion_(extrusion) {}

    ShapeTree extrude(const std::vector<Node>& nodes, const Eigen::Affine2d& map, Operation operation) const {
        ShapeTree tree{.operation = operation, .shape = nullptr};
        for (const Node& node : nodes)
            if (!node.ignored) tree.children.push_back(extrude(node, map));
        return tree;
    }

  private:
    ShapeTree extrude(const Node& node, const Eigen::Affine2d& map) const {
        if (is_round_circle(node, file_, placement_.facets)) {
            const double r = radius_of_round(Arguments(node, file_, {"r", "d"}));
            return {.operation = Operation::leaf,
                    .shape = at_node(arguments_, [&] {
                        return make_cylinder(extrusion_.height, r, r * extrusion_.scale.x(),
                                             extrusion_.center, placement_.frame * in_space(map));
                    })};
        }
        if (const auto operation = find_flat_operation(node.name))
            return extrude(node.children, map, *operation);
        if (find_transform(node.name))
            return extrude(node.children, map * flat_map(node, file_), Operation::join);
        return solids_of(arguments_, transformed(outline_of(node, file_), map),
                         [&](const PlaneRegion& region, std::size_t first_side) {
                             return linear_extrude(region, extrusion_, first_side, placement_.frame);
                         });
    }

    /// What the flat map is to a solid that narrows towards the z axis: it narrows towards the same, so that
    /// what the map moves away leans.
    Eigen::Affine3d in_space(const Eigen::Affine2d& map) const {
        const double bottom = extrusion_.center ? -extrusion_.height / 2 : 0;
        const Point2 lean = map.translation() * (extrusion_.scale.x() - 1) / extrusion_.height;
        Eigen::Affine3d result = Eigen::Affine3d::Identity();
        result.linear().topLeftCorner<2, 2>() = map.linear();
        result.linear().topRightCorner<2, 1>() = lean;
        result.translation().head<2>() = map.translation() - bottom * lean;
        return result;
    }

    const Arguments& arguments_;  ///< of the extrusion
    const std::string& file_;
    const Placement& placement_;
    const LinearExtrusion& extrusion_;
};

LinearExtrusion linear_extrusion(const Arguments& arguments) {
    LinearExtrusion extrusion;
    extrusion.height = arguments.positive("height");
    extrusion.center = arguments.boolean("center", false);
    extrusion.twist = arguments.number("twist", 0);
    if (arguments.is_vector("scale"))
        extrusion.scale = arguments.vector("scale", 0).head<2>();
    else
        extrusion.scale.setConstant(arguments.number("scale", 1));
    if (!(extrusion.scale.minCoeff() >= 0)) throw arguments.error("scale", "a scale must not be negative");
    if (arguments.has("slices")) extrusion.slices = arguments.count("slices", 1, max_fragments);
    return extrusion;
}

int usual_slices(const Arguments& arguments, const LinearExtrusion& extrusion, const Outline& outline) {
    double reach = 0, shift = 0;
    for (const PlaneRegion& region : outline)
        for (const PlaneLoop& loop : region)
            for (const Point2& p : loop) {
                reach = std::max(reach, p.norm());
                shift = std::max(shift, (p - p.cwiseProduct(extrusion.scale)).norm());
            }
    return at_node(arguments, [&] {
        return openscad_slices(extrusion.height, extrusion.twist, extrusion.scale, reach, shift,
                               facet_settings(arguments));
    });
}

ShapeTree linear(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"height", "center", "twist", "slices", "scale"});
    LinearExtrusion extrusion = linear_extrusion(arguments);
    const bool keeps_circles = extrusion.twist == 0 && extrusion.scale.x() == extrusion.scale.y();
    if (keeps_circles && has_round_circle(node.children, file, placement.facets))
        return RoundExtruder(arguments, file, placement, extrusion)
            .extrude(node.children, Eigen::Affine2d::Identity(), Operation::join);
    const Outline outline = outline_of(node.children, file);
    if (!arguments.has("slices")) extrusion.slices = usual_slices(arguments, extrusion, outline);
    return solids_of(arguments, outline, [&](const PlaneRegion& region, std::size_t first_side) {
        return linear_extrude(region, extrusion, first_side, placement.frame);
    });
}

ShapeTree rotate(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"angle"});
    const double angle = std::clamp(arguments.number("angle", 360), -360.0, 360.0);
    if (angle == 0) throw arguments.error("angle", "the angle must not be 0");
    const Outline outline = outline_of(node.children, file);
    double reach = 0;
    for (const PlaneRegion& region : outline)
        for (const Point2& p : region.front()) reach = std::max(reach, std::abs(p.x()));
    const double fragments = openscad_fragments(reach, facet_settings(arguments)) * std::abs(angle) / 360;
    const RotateExtrusion extrusion{.angle = std::abs(angle) == 360 ? 360 : angle,
                                    .fragments = std::max(1, static_cast<int>(fragments))};
    return solids_of(arguments, outline, [&](const PlaneRegion& region, std::size_t first_side) {
        return rotate_extrude(region, extrusion, first_side, placement.frame);
    });
}

constexpr NameRow<Extruder> extruders[] = {{"linear_extrude", linear}, {"rotate_extrude", rotate}};

}  // namespace

Extruder find_extruder(std::string_view name) {
    return look_up(extruders, name);
}

std::vector<std::string_view> extruder_names() {
    return names_of(extruders);
}

}  // namespace maille::modeler
