#include "modeler/language_extrude.hh"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "modeler/arguments.hh"
#include "modeler/extrude.hh"
#include "modeler/language_facets.hh"
#include "modeler/language_outline.hh"
#include "modeler/language_transforms.hh"
#include "modeler/makes_nothing.hh"
#include "modeler/name_table.hh"
#include "modeler/shape_frame.hh"
#include "modeler/shape_turned.hh"
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

/// The holes of a region that have a corner in common with its outline or with a hole before them. A solid
/// with such holes would touch itself along an edge; it can be cut from one without them.
std::vector<std::size_t> touching_holes(const PlaneRegion& region) {
    const auto coordinates = [](const Point2& p) { return std::pair(p.x(), p.y()); };
    std::set<std::pair<double, double>> corners;
    std::vector<std::size_t> touching;
    for (std::size_t i = 0; i < region.size(); ++i) {
        if (std::ranges::any_of(region[i], [&](const Point2& p) { return corners.contains(coordinates(p)); }))
            touching.push_back(i);
        for (const Point2& p : region[i]) corners.insert(coordinates(p));
    }
    return touching;
}

/// A solid for each region.
template <class Extrude>
ShapeTree solids_of(const Arguments& arguments, const Outline& outline, const Extrude& extrude) {
    ShapeTree solids{.operation = Operation::join, .shape = nullptr};
    std::size_t first_side = 0;
    const auto solid = [&](const PlaneRegion& region) {
        ShapeTree leaf{.operation = Operation::leaf,
                       .shape = at_node(arguments, [&] { return extrude(region, first_side); })};
        for (const PlaneLoop& loop : region) first_side += loop.size();
        return leaf;
    };
    for (PlaneRegion region : outline) {
        std::vector<PlaneRegion> cut;
        for (const std::size_t hole : touching_holes(region)) {
            PlaneLoop& loop = region[hole];
            cut.push_back({PlaneLoop(loop.rbegin(), loop.rend())});
            loop.clear();
        }
        std::erase(region, PlaneLoop());
        ShapeTree difference{.operation = Operation::difference, .shape = nullptr};
        difference.children.push_back(solid(region));
        for (const PlaneRegion& hole : cut) difference.children.push_back(solid(hole));
        solids.children.push_back(std::move(difference));
    }
    return solids;
}

/// Extrudes each flat shape by itself, and combines the solids as the shapes are combined.
class PartwiseExtruder {
  public:
    /// Makes the solid of a circle of that radius under a map; null where there is no round one.
    using CircleExtruder =
        std::function<std::shared_ptr<const Shape>(double radius, const Eigen::Affine2d& map)>;
    using RegionExtruder =
        std::function<std::shared_ptr<const Shape>(const PlaneRegion& region, std::size_t first_side)>;

    PartwiseExtruder(const Arguments& arguments, const std::string& file, Facets facets,
                     CircleExtruder circle, RegionExtruder region)
        : arguments_(arguments),
          file_(file),
          facets_(facets),
          circle_(std::move(circle)),
          region_(std::move(region)) {}

    ShapeTree extrude(const std::vector<Node>& nodes,
                      const Eigen::Affine2d& map = Eigen::Affine2d::Identity(),
                      Operation operation = Operation::join) const {
        return {.operation = operation, .shape = nullptr, .children = made_of(nodes, [&](const Node& node) {
                                                              return extrude(node, map);
                                                          })};
    }

  private:
    ShapeTree extrude(const Node& node, const Eigen::Affine2d& map) const {
        if (is_round_circle(node, file_, facets_)) {
            const double r = radius_of_round(Arguments(node, file_, {"r", "d"}));
            if (auto shape = at_node(arguments_, [&] { return circle_(r, map); }))
                return {.operation = Operation::leaf, .shape = std::move(shape)};
        }
        if (const auto operation = find_flat_operation(node.name))
            return extrude(node.children, map, *operation);
        if (find_transform(node.name)) return extrude(node.children, map * flat_map(node, file_));
        return solids_of(arguments_, transformed(outline_of(node, file_), map), region_);
    }

    const Arguments& arguments_;  ///< of the extrusion
    const std::string& file_;
    Facets facets_;
    CircleExtruder circle_;
    RegionExtruder region_;
};

/// What the flat map is to a solid that narrows towards the z axis: it narrows towards the same, so that what
/// the map moves away leans.
Eigen::Affine3d leaning(const LinearExtrusion& extrusion, const Eigen::Affine2d& map) {
    const double bottom = extrusion.center ? -extrusion.height / 2 : 0;
    const Point2 lean = map.translation() * (extrusion.scale.x() - 1) / extrusion.height;
    Eigen::Affine3d result = Eigen::Affine3d::Identity();
    result.linear().topLeftCorner<2, 2>() = map.linear();
    result.linear().topRightCorner<2, 1>() = lean;
    result.translation().head<2>() = map.translation() - bottom * lean;
    return result;
}

LinearExtrusion linear_extrusion(const Arguments& arguments) {
    LinearExtrusion extrusion;
    extrusion.height = arguments.extent("height");
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
    const auto extrude = [&](const PlaneRegion& region, std::size_t first_side) {
        return linear_extrude(region, extrusion, first_side, placement.frame);
    };
    const bool keeps_circles = extrusion.twist == 0 && extrusion.scale.x() == extrusion.scale.y();
    if (keeps_circles && has_round_circle(node.children, file, placement.facets)) {
        const auto circle = [&](double r, const Eigen::Affine2d& map) {
            return make_cylinder(extrusion.height, r, r * extrusion.scale.x(), extrusion.center,
                                 placement.frame * leaning(extrusion, map));
        };
        return PartwiseExtruder(arguments, file, placement.facets, circle, extrude).extrude(node.children);
    }
    const Outline outline = outline_of(node.children, file);
    if (!arguments.has("slices")) extrusion.slices = usual_slices(arguments, extrusion, outline);
    return solids_of(arguments, outline, extrude);
}

using Interval = Eigen::AlignedBox<double, 1>;

Interval interval(double low, double high) {
    return {Eigen::Vector<double, 1>(low), Eigen::Vector<double, 1>(high)};
}

Interval reach_of(std::span<const Node> nodes, const std::string& file, const Eigen::Affine2d& map);

Interval reach_of(const Node& node, const std::string& file, const Eigen::Affine2d& map) {
    if (find_flat_operation(node.name)) return reach_of(node.children, file, map);
    if (find_transform(node.name)) return reach_of(node.children, file, map * flat_map(node, file));
    if (node.name == "circle") {
        const double across = radius_of_round(Arguments(node, file, {"r", "d"})) * map.linear().row(0).norm();
        return interval(map.translation().x() - across, map.translation().x() + across);
    }
    Interval reach;
    for (const PlaneRegion& region : transformed(outline_of(node, file), map))
        for (const Point2& p : region.front()) reach.extend(interval(p.x(), p.x()));
    return reach;
}

/// From where to where all the shapes lie, before they are combined: distances from the axis with their sign.
Interval reach_of(std::span<const Node> nodes, const std::string& file, const Eigen::Affine2d& map) {
    Interval reach;
    for (const Interval& one : made_of(nodes, [&](const Node& node) { return reach_of(node, file, map); }))
        reach.extend(one);
    return reach;
}

/// The whole circle as a profile.
Profile circle_profile(const Point2& centre, double radius) {
    const Point2 start = centre + radius * Point2::UnitX();
    return {{{.from = start, .to = start, .name = "surface", .centre = centre}}};
}

ShapeTree rotate_round(const Arguments& arguments, const std::string& file, const Placement& placement,
                       double angle) {
    const std::vector<Node>& nodes = arguments.node().children;
    const auto extrude = [&](const PlaneRegion& region, std::size_t first_side) {
        return rotate_extrude_round(region, angle, first_side, placement.frame);
    };
    const Interval reach = reach_of(nodes, file, Eigen::Affine2d::Identity());
    const bool on_one_side = reach.isEmpty() || reach.min()[0] >= 0 || reach.max()[0] <= 0;
    if (!on_one_side || !has_round_circle(nodes, file, placement.facets))
        return solids_of(arguments, outline_of(nodes, file), extrude);
    const auto circle = [&](double r, const Eigen::Affine2d& map) -> std::shared_ptr<const Shape> {
        Eigen::Affine3d in_space = Eigen::Affine3d::Identity();
        in_space.linear().topLeftCorner<2, 2>() = map.linear();
        const double scale = std::sqrt(std::abs(map.linear().determinant()));
        in_space.linear()(2, 2) = scale;
        const double radius = r * scale, major = std::abs(map.translation().x());
        if (!is_similarity(in_space.linear()) || !(radius < major)) return nullptr;
        if (angle == 360)
            return make_torus(major, radius,
                              placement.frame * Eigen::Translation3d(0, 0, map.translation().y()));
        if (!is_similarity(placement.frame.linear())) return nullptr;
        return make_turned(circle_profile(map.translation(), radius), angle, placement.frame);
    };
    return PartwiseExtruder(arguments, file, placement.facets, circle, extrude).extrude(nodes);
}

ShapeTree rotate(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"angle"});
    const double given = std::clamp(arguments.number("angle", 360), -360.0, 360.0);
    if (given == 0) throw MakesNothing(arguments.error("angle", "the angle must not be 0"));
    const double angle = std::abs(given) == 360 ? 360 : given;
    const FacetSettings settings = facet_settings(arguments);
    if (!keeps_facets(placement.facets, settings)) return rotate_round(arguments, file, placement, angle);
    const Outline outline = outline_of(node.children, file);
    double reach = 0;
    for (const PlaneRegion& region : outline)
        for (const Point2& p : region.front()) reach = std::max(reach, std::abs(p.x()));
    const double fragments = openscad_fragments(reach, settings) * std::abs(angle) / 360;
    const RotateExtrusion extrusion{.angle = angle, .fragments = std::max(1, static_cast<int>(fragments))};
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
