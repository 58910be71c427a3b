#include "modeler/align.hh"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>

#include <Eigen/QR>

#include "modeler/arrange_box_tree.hh"
#include "modeler/shape_polyhedron.hh"

namespace maille::modeler {
namespace {

/// A planar face of a polyhedron of the model.
struct FlatFace {
    std::uint32_t primitive;
    std::uint32_t face;
    std::vector<Point> corners;
    Plane plane;
    Eigen::AlignedBox3d box;
    double area;
};

bool is_square_to_axis(const Plane& plane) {
    return plane.normal().cwiseAbs().maxCoeff() == 1;
}

bool holds(const Plane& plane, std::span<const Point> points, double tolerance) {
    return std::ranges::all_of(points,
                               [&](const Point& p) { return std::abs(plane.distance(p)) <= tolerance; });
}

std::vector<FlatFace> flat_faces(const Model& model) {
    std::vector<FlatFace> faces;
    for (std::uint32_t i = 0; i < model.primitives.size(); ++i) {
        const auto* shape = dynamic_cast<const Polyhedron*>(model.primitives[i].shape.get());
        if (shape == nullptr) continue;
        for (std::uint32_t f = 0; f < shape->faces().size(); ++f) {
            const auto& loops = shape->polygon(f).loops;
            FlatFace& face = faces.emplace_back(
                FlatFace{i, f, {}, shape->plane(f), {}, area_vector(shape->points(), loops).norm()});
            for (const auto& loop : loops)
                for (const std::uint32_t v : loop) face.corners.push_back(shape->points()[v]);
            for (const Point& p : face.corners) face.box.extend(p);
        }
    }
    return faces;
}

/// By face: one that its plane is to become the plane of; itself where it stays.
std::vector<std::size_t> leaders(const std::vector<FlatFace>& faces, double tolerance) {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const FlatFace& face : faces) {
        const Point margin = Point::Constant(tolerance);
        boxes.emplace_back(face.box.min() - margin, face.box.max() + margin);
    }
    const detail::BoxTree tree(boxes);
    std::vector<std::size_t> order(faces.size()), leader(faces.size());
    std::iota(order.begin(), order.end(), 0u);
    std::iota(leader.begin(), leader.end(), 0u);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        return std::pair(is_square_to_axis(faces[a].plane), faces[a].area) >
               std::pair(is_square_to_axis(faces[b].plane), faces[b].area);
    });
    std::vector<std::uint8_t> is_done(faces.size());
    for (const std::size_t first : order) {
        if (is_done[first]) continue;
        is_done[first] = 1;
        const FlatFace& lead = faces[first];
        std::vector<std::size_t> group{first};
        for (std::size_t k = 0; k < group.size(); ++k)
            tree.visit_box(boxes[group[k]], [&](std::uint32_t other) {
                if (!is_done[other] && holds(lead.plane, faces[other].corners, tolerance) &&
                    holds(faces[other].plane, lead.corners, tolerance)) {
                    is_done[other] = 1;
                    leader[other] = first;
                    group.push_back(other);
                }
                return true;
            });
    }
    return leader;
}

/// The point nearest to `p` in all the planes; nothing where they have none in common.
std::optional<Point> nearest_in(std::span<const Plane* const> planes, const Point& p, double slack) {
    Eigen::MatrixX3d normals(planes.size(), 3);
    Eigen::VectorXd distances(planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        normals.row(row) = planes[i]->normal();
        distances[row] = -planes[i]->distance(p);
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixX3d> solver;
    solver.setThreshold(1e-4);
    solver.compute(normals);
    Point moved = p + solver.solve(distances);
    for (const Plane* plane : planes)
        if (is_square_to_axis(*plane)) moved = plane->project(moved);
    const bool is_in_all = std::ranges::all_of(
        planes, [&](const Plane* plane) { return std::abs(plane->distance(moved)) <= slack; });
    return is_in_all ? std::optional(moved) : std::nullopt;
}

/// The polyhedron with the given planes of its faces instead of its own; null where they don't fit it.
std::shared_ptr<const Shape> with_planes(const Polyhedron& shape, const std::vector<const Plane*>& planes,
                                         double tolerance) {
    const double slack = 1e-14 * (shape.bounding_box().diagonal().norm() +
                                  shape.bounding_box().center().cwiseAbs().maxCoeff());
    std::vector<Point> points(shape.points().begin(), shape.points().end());
    std::vector<std::vector<const Plane*>> planes_at(points.size());
    std::vector<std::uint8_t> moves(points.size());
    std::vector<Polyhedron::Polygon> polygons;
    for (std::uint32_t f = 0; f < planes.size(); ++f) {
        polygons.push_back(shape.polygon(f));
        for (const auto& loop : polygons.back().loops)
            for (const std::uint32_t v : loop) {
                planes_at[v].push_back(planes[f]);
                moves[v] |= planes[f] != &shape.plane(f);
            }
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
        if (!moves[v]) continue;
        const auto moved = nearest_in(planes_at[v], points[v], slack);
        if (!moved || (*moved - points[v]).norm() > 10 * tolerance) return nullptr;
        points[v] = *moved;
    }
    return std::make_shared<Polyhedron>(std::move(points), std::move(polygons));
}

/// Whether faces of one polyhedron in different planes would come into one, as those of a thin film.
bool are_pressed_together(std::span<const FlatFace> faces, std::span<const std::size_t> leader,
                          double rounding) {
    std::map<std::size_t, std::size_t> first_led;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const std::size_t first = first_led.try_emplace(leader[i], i).first->second;
        if (!holds(faces[first].plane, faces[i].corners, rounding)) return true;
    }
    return false;
}

}  // namespace

Model aligned(const Model& model, double tolerance) {
    const std::vector<FlatFace> faces = flat_faces(model);
    const std::vector<std::size_t> leader = leaders(faces, tolerance);
    const double rounding = 1e-6 * tolerance;
    Model result = model;
    for (std::size_t first = 0, end = 0; first < faces.size(); first = end) {
        const std::uint32_t primitive = faces[first].primitive;
        const auto& shape = static_cast<const Polyhedron&>(*model.primitives[primitive].shape);
        end = first + shape.faces().size();
        std::vector<const Plane*> planes;
        bool is_changed = false;
        for (std::size_t i = first; i < end; ++i) {
            const Plane& wanted = faces[leader[i]].plane;
            const bool moves = !holds(wanted, faces[i].corners, rounding);
            planes.push_back(moves ? &wanted : &shape.plane(faces[i].face));
            is_changed = is_changed || moves;
        }
        const auto own = [&](const auto& all) { return std::span(all).subspan(first, end - first); };
        if (is_changed && !are_pressed_together(own(faces), own(leader), rounding))
            if (auto moved = with_planes(shape, planes, tolerance))
                result.primitives[primitive].shape = moved;
    }
    return result;
}

}  // namespace maille::modeler
