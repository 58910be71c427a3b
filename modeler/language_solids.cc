#include "modeler/language_solids.hh"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "modeler/arguments.hh"
#include "modeler/language_facets.hh"
#include "modeler/language_import.hh"
#include "modeler/makes_nothing.hh"
#include "modeler/name_table.hh"
#include "modeler/shapes.hh"

namespace maille::modeler {
namespace {

using ShapePointer = std::shared_ptr<const Shape>;

ShapePointer shape_of(FacetedSolid solid, const Eigen::Affine3d& frame) {
    return make_polyhedron(std::move(solid.points), std::move(solid.faces), std::move(solid.names), frame);
}

ShapePointer cube(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"size", "center"});
    Point size = Point::Ones();
    if (arguments.is_vector("size"))
        size = arguments.vector("size");
    else if (arguments.has("size"))
        size.setConstant(arguments.number("size"));
    if (!(size.minCoeff() > 0))
        throw MakesNothing(arguments.error("size", "every side must be longer than 0"));
    const bool center = arguments.boolean("center", false);
    return at_node(arguments, [&] { return make_cube(size, center, placement.frame); });
}

ShapePointer sphere(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"r", "d"});
    const double r = radius_of_round(arguments);
    const FacetSettings settings = facet_settings(arguments);
    return at_node(arguments, [&] {
        if (!keeps_facets(placement.facets, settings)) return make_sphere(r, placement.frame);
        return shape_of(openscad_sphere(r, openscad_fragments(r, settings)), placement.frame);
    });
}

/// The radii at the bottom and at the top, as OpenSCAD's `r`, `d`, `r1` and `r2`, `d1` and `d2` give them.
std::pair<double, double> cylinder_radii(const Arguments& arguments) {
    const bool one = arguments.has("r") || arguments.has("d");
    const bool bottom = arguments.has("r1") || arguments.has("d1");
    const bool top = arguments.has("r2") || arguments.has("d2");
    if (one && (bottom || top))
        throw arguments.error(arguments.node().at, "give one radius, or one for each end, not both");
    if (one) {
        const double r = radius(arguments, "r", "d");
        return {r, r};
    }
    if (bottom != top)
        throw arguments.error(arguments.node().at,
                              "give a radius for each end (r1 and r2), or one for both (r)");
    if (!bottom) return {1, 1};
    return {radius(arguments, "r1", "d1"), radius(arguments, "r2", "d2")};
}

ShapePointer cylinder(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"h", "r1", "r2", "center", "r", "d", "d1", "d2"});
    const double height = arguments.extent("h", 1);
    const auto [bottom, top] = cylinder_radii(arguments);
    if (!(bottom >= 0 && top >= 0))
        throw MakesNothing(arguments.error(
            node.at, fmt::format("a radius must not be negative, not {}", std::min(bottom, top))));
    if (bottom == 0 && top == 0)
        throw MakesNothing(arguments.error(node.at, "the radius must be greater than 0"));
    const bool center = arguments.boolean("center", false);
    const FacetSettings settings = facet_settings(arguments);
    return at_node(arguments, [&, bottom = bottom, top = top] {
        if (!keeps_facets(placement.facets, settings))
            return make_cylinder(height, bottom, top, center, placement.frame);
        const int fragments = openscad_fragments(std::max(bottom, top), settings);
        return shape_of(openscad_cylinder(height, bottom, top, center, fragments), placement.frame);
    });
}

ShapePointer torus(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"r1", "r2"});
    const double major = arguments.positive("r1");
    const double minor = arguments.positive("r2");
    if (!(minor < major))
        throw arguments.error("r2", "the minor radius 'r2' must be less than the major radius 'r1'");
    return at_node(arguments, [&] { return make_torus(major, minor, placement.frame); });
}

ShapePointer ellipsoid(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"r"});
    const Point semi_axes = arguments.vector("r");
    if (!(semi_axes.minCoeff() > 0)) throw arguments.error("r", "every semi-axis must be greater than 0");
    return at_node(arguments, [&] { return make_ellipsoid(semi_axes, placement.frame); });
}

ShapePointer wedge(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"size", "dx"});
    const Point size = arguments.vector("size");
    if (!(size.minCoeff() > 0)) throw arguments.error("size", "every side must be longer than 0");
    const double dx = arguments.number("dx", 0);
    if (!(dx >= 0)) throw arguments.error("dx", fmt::format("'dx' must not be negative, not {}", dx));
    return at_node(arguments, [&] { return make_wedge(size, dx, placement.frame); });
}

template <ShapePointer (*make)(int, double, double, const Eigen::Affine3d&)>
ShapePointer regular(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"n", "r", "h"});
    const int n = arguments.count("n", 3, max_fragments);
    const double r = arguments.positive("r");
    const double h = arguments.positive("h");
    return at_node(arguments, [&] { return make(n, r, h, placement.frame); });
}

std::vector<Point> points(const Arguments& arguments) {
    std::vector<Point> result;
    for (const Value& value : arguments.list("points")) result.push_back(arguments.vector(value, "points"));
    return result;
}

ShapePointer tetrahedron(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"points"});
    const std::vector<Point> corners = points(arguments);
    if (corners.size() != 4)
        throw arguments.error("points", fmt::format("'points' must be 4 points, not {}", corners.size()));
    return at_node(arguments, [&] {
        return make_tetrahedron({corners[0], corners[1], corners[2], corners[3]}, placement.frame);
    });
}

/// One face of a polyhedron, turned around: OpenSCAD's are clockwise seen from outside.
std::vector<std::uint32_t> polyhedron_face(const Arguments& arguments, const Value& face,
                                           std::size_t n_points) {
    std::vector<std::uint32_t> corners;
    for (const Value& value : arguments.list(face, "faces")) {
        const double index = arguments.number(value, "faces");
        if (index != std::floor(index) || index < 0 || index >= static_cast<double>(n_points))
            throw arguments.error(
                value.at, fmt::format("there is no point {}: the {} points count from 0", index, n_points));
        corners.push_back(static_cast<std::uint32_t>(index));
    }
    if (corners.size() < 3) throw arguments.error(face.at, "a face needs at least 3 points");
    std::ranges::reverse(corners);
    return corners;
}

ShapePointer polyhedron(const Node& node, const std::string& file, const Placement& placement) {
    const Arguments arguments(node, file, {"points", "faces", "triangles"});
    FacetedSolid solid{.points = points(arguments), .faces = {}, .names = {}};
    if (arguments.has("faces") && arguments.has("triangles"))
        throw arguments.error("triangles", "give 'faces' or 'triangles', not both");
    for (const Value& face : arguments.list(arguments.has("triangles") ? "triangles" : "faces")) {
        solid.names.push_back(fmt::format("face{}", solid.faces.size()));
        solid.faces.push_back(polyhedron_face(arguments, face, solid.points.size()));
    }
    if (solid.faces.empty()) throw MakesNothing(arguments.error("faces", "there are no faces"));
    return at_node(arguments, [&] { return shape_of(std::move(solid), placement.frame); });
}

constexpr NameRow<SolidMaker> solids[] = {
    {"cube", cube},
    {"sphere", sphere},
    {"cylinder", cylinder},
    {"torus", torus},
    {"ellipsoid", ellipsoid},
    {"wedge", wedge},
    {"prism", regular<make_prism>},
    {"pyramid", regular<make_pyramid>},
    {"tetrahedron", tetrahedron},
    {"polyhedron", polyhedron},
    {"import", import},
};

}  // namespace

SolidMaker find_solid(std::string_view name) {
    return look_up(solids, name);
}

std::vector<std::string_view> solid_names() {
    return names_of(solids);
}

}  // namespace maille::modeler
