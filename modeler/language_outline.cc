#include "modeler/language_outline.hh"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "modeler/arguments.hh"
#include "modeler/language_facets.hh"
#include "modeler/language_resize.hh"
#include "modeler/language_transforms.hh"
#include "modeler/makes_nothing.hh"
#include "modeler/name_table.hh"

namespace maille::modeler {
namespace {

PlaneLoop circle_points(double radius, int fragments) {
    PlaneLoop loop;
    for (int i = 0; i < fragments; ++i) {
        const double angle = 360.0 * i / fragments;
        loop.emplace_back(radius * cos_degrees(angle), radius * sin_degrees(angle));
    }
    return loop;
}

Outline circle(const Node& node, const std::string& file) {
    const Arguments arguments(node, file, {"r", "d"});
    const double r = radius_of_round(arguments);
    return {{circle_points(r, openscad_fragments(r, facet_settings(arguments)))}};
}

Outline square(const Node& node, const std::string& file) {
    const Arguments arguments(node, file, {"size", "center"});
    Point2 size = Point2::Ones();
    if (arguments.is_vector("size"))
        size = arguments.vector("size", 0).head<2>();
    else if (arguments.has("size"))
        size.setConstant(arguments.number("size"));
    if (!(size.minCoeff() > 0))
        throw MakesNothing(arguments.error("size", "every side must be longer than 0"));
    const Point2 low = arguments.boolean("center", false) ? Point2(-size / 2) : Point2::Zero();
    const Point2 high = low + size;
    return {{{low, {high.x(), low.y()}, high, {low.x(), high.y()}}}};
}

PlaneLoop path_of(const Arguments& arguments, const Value& path, const PlaneLoop& points) {
    PlaneLoop loop;
    for (const Value& value : arguments.list(path, "paths")) {
        const double index = arguments.number(value, "paths");
        if (index != std::floor(index) || index < 0 || index >= static_cast<double>(points.size()))
            throw arguments.error(value.at, fmt::format("there is no point {}: the {} points count from 0",
                                                        index, points.size()));
        loop.push_back(points[static_cast<std::size_t>(index)]);
    }
    return loop;
}

Outline polygon(const Node& node, const std::string& file) {
    const Arguments arguments(node, file, {"points", "paths"});
    PlaneLoop points;
    for (const Value& value : arguments.list("points"))
        points.push_back(arguments.vector(value, "points", 0).head<2>());
    std::vector<PlaneLoop> loops;
    if (arguments.is_vector("paths"))
        for (const Value& path : arguments.list("paths")) loops.push_back(path_of(arguments, path, points));
    if (loops.empty()) loops.push_back(std::move(points));
    Outline shape = make_outline(loops);
    if (shape.empty()) throw MakesNothing(arguments.error("points", "the polygon has no area"));
    return shape;
}

Outline offset_of(const Node& node, const std::string& file) {
    const Arguments arguments(node, file, {"r", "delta", "chamfer"});
    const bool is_round = arguments.has("r");
    if (is_round == arguments.has("delta")) throw arguments.error(node.at, "give either 'r' or 'delta'");
    const double distance = arguments.number(is_round ? "r" : "delta");
    const int fragments = openscad_fragments(std::abs(distance), facet_settings(arguments));
    const OffsetCorners corners = is_round                              ? OffsetCorners::round
                                  : arguments.boolean("chamfer", false) ? OffsetCorners::chamfered
                                                                        : OffsetCorners::mitred;
    return offset(outline_of(node.children, file), distance, corners,
                  std::abs(distance) * (1 - cos_degrees(180.0 / fragments)));
}

std::vector<Outline> outlines_of(const std::vector<Node>& nodes, const std::string& file) {
    return made_of(nodes, [&](const Node& node) { return outline_of(node, file); });
}

Outline hull(const Node& node, const std::string& file) {
    const Arguments checked(node, file, {});
    return convex_hull(outlines_of(node.children, file));
}

Outline resize(const Node& node, const std::string& file) {
    const Outline shape = outline_of(node.children, file);
    Eigen::AlignedBox3d box;
    for (const PlaneRegion& region : shape)
        for (const Point2& p : region.front()) box.extend(Point(p.x(), p.y(), 0));
    const Point factors = resize_factors(node, file, box);
    return transformed(shape, Eigen::Affine2d(Eigen::Scaling(factors.x(), factors.y())));
}

using OutlineMaker = Outline (*)(const Node&, const std::string&);

constexpr NameRow<OutlineMaker> makers[] = {{"circle", circle},    {"square", square}, {"polygon", polygon},
                                            {"offset", offset_of}, {"hull", hull},     {"resize", resize}};

constexpr NameRow<std::optional<Operation>> operations[] = {{"union", Operation::join},
                                                            {"group", Operation::join},
                                                            {"color", Operation::join},
                                                            {"render", Operation::join},
                                                            {"difference", Operation::difference},
                                                            {"intersection", Operation::intersection}};

}  // namespace

bool is_flat_node(std::string_view name) {
    return name != "hull" && name != "resize" && look_up(makers, name) != nullptr;
}

std::optional<Operation> find_flat_operation(std::string_view name) {
    return look_up(operations, name);
}

Outline outline_of(const Node& node, const std::string& file) {
    if (const OutlineMaker make = look_up(makers, node.name)) return make(node, file);
    if (const auto operation = find_flat_operation(node.name))
        return combine(*operation, outlines_of(node.children, file));
    if (find_transform(node.name)) return transformed(outline_of(node.children, file), flat_map(node, file));
    throw located_error(
        file, node.at,
        fmt::format(
            "'{}' has no place in an extrusion: only flat shapes do (circle, square, polygon, offset, "
            "hull), their unions, differences and intersections, and transforms",
            node.name));
}

Outline outline_of(const std::vector<Node>& nodes, const std::string& file) {
    return combine(Operation::join, outlines_of(nodes, file));
}

Eigen::Affine2d flat_map(const Node& node, const std::string& file) {
    const Eigen::Affine3d map = find_transform(node.name)(node, file);
    Eigen::Affine2d flat = Eigen::Affine2d::Identity();
    flat.linear() = map.linear().topLeftCorner<2, 2>();
    flat.translation() = map.translation().head<2>();
    Eigen::Affine3d regular = Eigen::Affine3d::Identity();
    regular.linear().topLeftCorner<2, 2>() = flat.linear();
    if (!is_regular(regular))
        throw MakesNothing(located_error(
            file, node.at, fmt::format("'{}' flattens its children or has no inverse", node.name)));
    return flat;
}

}  // namespace maille::modeler
