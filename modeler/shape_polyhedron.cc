#include "modeler/shape_polyhedron.hh"

#include <algorithm>
#include <unordered_map>

#include "modeler/shape_distance.hh"
#include "modeler/tessellate_polygon.hh"

namespace maille::modeler {

Point area_vector(std::span<const Point> points, const std::vector<std::vector<std::uint32_t>>& loops) {
    const Point origin = points[loops.front().front()];
    Point sum = Point::Zero();
    for (const auto& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Point a = points[loop[i]] - origin, b = points[loop[(i + 1) % loop.size()]] - origin;
            sum += a.cross(b);
        }
    return sum;
}

std::vector<Triangle> triangulate_polygon(std::span<const Point> points,
                                          const std::vector<std::vector<std::uint32_t>>& loops,
                                          const Plane& plane) {
    std::vector<Eigen::Vector2d> flat;
    std::vector<std::uint32_t> index;
    std::vector<std::vector<std::uint32_t>> local(loops.size());
    for (std::size_t i = 0; i < loops.size(); ++i)
        for (std::uint32_t vertex : loops[i]) {
            local[i].push_back(static_cast<std::uint32_t>(index.size()));
            index.push_back(vertex);
            flat.push_back(plane.flatten(points[vertex]));
        }
    std::vector<Triangle> triangles = triangulate(flat, local);
    for (Triangle& triangle : triangles)
        for (std::uint32_t& corner : triangle) corner = index[corner];
    return triangles;
}

Polyhedron::Polyhedron(std::vector<Point> points, std::vector<Polygon> polygons)
    : points_(std::move(points)), polygons_(std::move(polygons)) {
    for (const Polygon& polygon : polygons_) {
        planes_.emplace_back(points_[polygon.loops.front().front()], area_vector(points_, polygon.loops));
        faces_.push_back({polygon.name, true});
    }
    if (is_convex()) return;
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < polygons_.size(); ++i)
        for (const Triangle& triangle : triangulate_polygon(points_, polygons_[i].loops, planes_[i]))
            triangles.push_back(triangle);
    distance_ = std::make_shared<SignedDistance>(points_, triangles);
}

bool Polyhedron::is_convex() const {
    constexpr std::size_t most_faces = 64;  // with more of them a search tree is quicker than the planes
    const double tolerance = 1e-13 * bounding_box().diagonal().norm();
    return planes_.size() <= most_faces && std::ranges::all_of(planes_, [&](const Plane& plane) {
               return std::ranges::all_of(points_,
                                          [&](const Point& p) { return plane.distance(p) <= tolerance; });
           });
}

Eigen::AlignedBox3d Polyhedron::bounding_box() const {
    Eigen::AlignedBox3d box;
    for (const Point& p : points_) box.extend(p);
    return box;
}

double Polyhedron::implicit(const Point& p) const {
    if (distance_) return (*distance_)(p);
    double largest = -std::numeric_limits<double>::infinity();
    for (const Plane& plane : planes_) largest = std::max(largest, plane.distance(p));
    return largest;
}

double Polyhedron::face_implicit(std::uint32_t face, const Point& p) const {
    return planes_[face].distance(p);
}

Point Polyhedron::face_normal(std::uint32_t face, const Point&) const {
    return planes_[face].normal();
}

Eigen::Matrix3d Polyhedron::face_curvature(std::uint32_t, const Point&) const {
    return Eigen::Matrix3d::Zero();
}

Point Polyhedron::project(std::uint32_t face, const Point& p) const {
    return planes_[face].project(p);
}

double Polyhedron::max_curvature(std::uint32_t) const {
    return 0;
}

}  // namespace maille::modeler
