#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include "modeler/close_values.hh"
#include "modeler/shape_frame.hh"
#include "modeler/shape_polyhedron.hh"
#include "modeler/shape_polyhedron_sense.hh"
#include "modeler/shapes.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using Loop = std::vector<std::uint32_t>;
using Faces = std::vector<PolyhedronFace>;

void check_indices(const std::vector<Point>& points, const Faces& faces) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!points[i].allFinite())
            throw InputError(fmt::format("point {} of the polyhedron is not finite", i));
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (faces[i].loops.empty())
            throw InputError(fmt::format("face {} of the polyhedron has no points", i));
        for (const Loop& loop : faces[i].loops)
            for (std::uint32_t vertex : loop)
                if (vertex >= points.size())
                    throw InputError(
                        fmt::format("face {} of the polyhedron names point {}, but there are only {}", i,
                                    vertex, points.size()));
    }
}

/// Takes equal points for one, the first of them; then drops repeated points from loops, and loops that are
/// left with fewer than three.
void weld(const std::vector<Point>& points, Faces& faces) {
    std::vector<std::uint32_t> order(points.size()), first(points.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto coordinates = [&](std::uint32_t i) {
        return std::tuple(points[i].x(), points[i].y(), points[i].z());
    };
    std::ranges::stable_sort(order, {}, coordinates);
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool same = k > 0 && coordinates(order[k - 1]) == coordinates(order[k]);
        first[order[k]] = same ? first[order[k - 1]] : order[k];
    }
    for (PolyhedronFace& face : faces) {
        for (Loop& loop : face.loops) {
            for (std::uint32_t& vertex : loop) vertex = first[vertex];
            const auto rest = std::ranges::unique(loop);
            loop.erase(rest.begin(), rest.end());
            while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
        }
        std::erase_if(face.loops, [](const Loop& loop) { return loop.size() < 3; });
    }
    std::erase_if(faces, [](const PolyhedronFace& face) { return face.loops.empty(); });
    if (faces.size() < 4 &&
        !std::ranges::any_of(faces, [](const auto& face) { return face.loops.size() > 1; }))
        throw InputError("a polyhedron needs at least four faces");
}

/// Gives coordinates that differ by rounding only one value, so that what is meant to be axis-aligned is.
void merge_close_coordinates(std::vector<Point>& points) {
    double scale = 0;
    for (const Point& p : points) scale = std::max(scale, p.cwiseAbs().maxCoeff());
    const double tolerance = 8 * std::numeric_limits<double>::epsilon() * scale;
    std::vector<double*> values;
    for (int axis = 0; axis < 3; ++axis) {
        values.clear();
        for (Point& p : points) values.push_back(&p[axis]);
        merge_close_values(values, tolerance);
    }
}

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

/// Throws unless every edge has one face on each side.
void check_closed(const Faces& faces) {
    std::map<DirectedEdge, std::uint32_t> left;
    for (std::uint32_t i = 0; i < faces.size(); ++i)
        for (const Loop& loop : faces[i].loops)
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const DirectedEdge edge(loop[k], loop[(k + 1) % loop.size()]);
                const auto [place, is_new] = left.emplace(edge, i);
                if (!is_new)
                    throw InputError(
                        fmt::format("faces \"{}\" and \"{}\" of the polyhedron both pass from point {} to "
                                    "point {}: every edge has "
                                    "to belong to two faces that pass it in opposite senses",
                                    faces[place->second].name, faces[i].name, edge.first, edge.second));
            }
    for (const auto& [edge, face] : left)
        if (!left.contains({edge.second, edge.first}))
            throw InputError(fmt::format(
                "the polyhedron is not closed: only face \"{}\" has the edge from point {} to point {}",
                faces[face].name, edge.first, edge.second));
}

/// Where parts touch at a point only, each gets a point of its own there: the faces around it are several
/// fans.
void part_fans(std::vector<Point>& points, Faces& faces) {
    std::map<DirectedEdge, std::uint32_t> previous;  // of each directed edge: the start of the one before it
    for (const PolyhedronFace& face : faces)
        for (const Loop& loop : face.loops)
            for (std::size_t k = 0; k < loop.size(); ++k)
                previous[{loop[k], loop[(k + 1) % loop.size()]}] = loop[(k + loop.size() - 1) % loop.size()];
    std::map<DirectedEdge, std::uint32_t> start;  // of each directed edge, once it is known
    std::vector<std::uint8_t> is_taken(points.size());
    for (const auto& [edge, before] : previous) {
        if (start.contains(edge)) continue;
        std::uint32_t point = edge.first;
        if (is_taken[point]) {
            points.push_back(points[point]);
            point = static_cast<std::uint32_t>(points.size()) - 1;
        } else {
            is_taken[point] = 1;
        }
        for (DirectedEdge e = edge; start.emplace(e, point).second;) e.second = previous.at(e);
    }
    for (PolyhedronFace& face : faces)
        for (Loop& loop : face.loops) {
            const Loop given = loop;
            for (std::size_t k = 0; k < loop.size(); ++k)
                loop[k] = start.at({given[k], given[(k + 1) % given.size()]});
        }
}

/// Appends the face, in triangles if it is not planar.
void add_polygons(const std::vector<Point>& points, const PolyhedronFace& face,
                  std::vector<Polyhedron::Polygon>& polygons) {
    const Point& origin = points[face.loops.front().front()];
    const Point area = area_vector(points, face.loops);
    double extent = 0;
    for (const Loop& loop : face.loops)
        for (std::uint32_t vertex : loop) extent = std::max(extent, (points[vertex] - origin).norm());
    if (!(area.norm() > 1e-14 * extent * extent))
        throw InputError(fmt::format("face \"{}\" of the polyhedron has no area", face.name));
    const Plane plane(origin, area);
    const double scale = origin.cwiseAbs().maxCoeff() + extent;
    const bool is_planar = std::ranges::all_of(face.loops, [&](const Loop& loop) {
        return std::ranges::all_of(loop, [&](std::uint32_t vertex) {
            return std::abs(plane.distance(points[vertex])) <= 1e-14 * scale;
        });
    });
    std::vector<std::array<std::uint32_t, 3>> triangles;
    try {
        triangles = triangulate_polygon(points, face.loops, plane);
    } catch (const InputError& error) {
        throw InputError(fmt::format("face \"{}\" of the polyhedron: {}", face.name, error.what()));
    }
    if (is_planar) {
        polygons.push_back({face.loops, face.name});
        return;
    }
    for (const auto& [a, b, c] : triangles) polygons.push_back({{{a, b, c}}, face.name});
}

}  // namespace

std::shared_ptr<const Shape> make_polyhedron(std::vector<Point> points, std::vector<PolyhedronFace> faces,
                                             const Eigen::Affine3d& frame) {
    check_frame(frame);
    check_indices(points, faces);
    weld(points, faces);
    agree_on_sense(faces);
    check_closed(faces);
    part_fans(points, faces);
    for (Point& p : points) p = frame * p;
    merge_close_coordinates(points);
    turn_outwards(points, faces);
    std::vector<Polyhedron::Polygon> polygons;
    for (const PolyhedronFace& face : faces) add_polygons(points, face, polygons);

    // Only the points that a face uses, in order of appearance.
    constexpr std::uint32_t none = ~0u;
    std::vector<std::uint32_t> number(points.size(), none);
    std::vector<Point> used;
    for (Polyhedron::Polygon& polygon : polygons)
        for (Loop& loop : polygon.loops)
            for (std::uint32_t& vertex : loop) {
                if (number[vertex] == none) {
                    number[vertex] = static_cast<std::uint32_t>(used.size());
                    used.push_back(points[vertex]);
                }
                vertex = number[vertex];
            }
    return std::make_shared<Polyhedron>(std::move(used), std::move(polygons));
}

std::shared_ptr<const Shape> make_polyhedron(std::vector<Point> points,
                                             std::vector<std::vector<std::uint32_t>> faces,
                                             std::vector<std::string> face_names,
                                             const Eigen::Affine3d& frame) {
    if (faces.size() != face_names.size())
        throw InputError(
            fmt::format("the polyhedron has {} faces but {} face names", faces.size(), face_names.size()));
    std::vector<PolyhedronFace> named;
    for (std::size_t i = 0; i < faces.size(); ++i)
        named.push_back({{std::move(faces[i])}, std::move(face_names[i])});
    return make_polyhedron(std::move(points), std::move(named), frame);
}

}  // namespace maille::modeler
