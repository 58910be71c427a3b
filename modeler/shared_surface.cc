#include "modeler/shared_surface.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "modeler/coincident.hh"
#include "modeler/shape_polyhedron.hh"
#include "modeler/shared_families.hh"
#include "modeler/tessellate_rows.hh"

namespace maille::modeler {
namespace {

class Finder {
  public:
    Finder(std::span<const Primitive> primitives, std::span<double> sizes, double chord_tolerance)
        : families_(primitives), sizes_(sizes), chord_tolerance_(chord_tolerance) {
        for (auto& [i, family] : families_.by_first())
            if (families_.is_cylinder(i) && is_nearly_round(*as<Cone>(i))) find_tangents(i, family);
        link_spheres();
        link_ends();
        link_round_surfaces(families_);
        level_sizes();
    }

    std::vector<std::shared_ptr<const SharedSurface>> cuts() {
        count_edges();
        std::vector<std::shared_ptr<const SharedSurface>> result(families_.primitives().size());
        for (auto& [i, family] : families_.by_first())
            if (const auto cut = cut_of(i, family)) {
                const auto shared = std::make_shared<const SharedSurface>(*cut);
                for (const std::uint32_t member : family.members) result[member] = shared;
            }
        return result;
    }

  private:
    template <class Kind>
    const Kind* as(std::uint32_t i) const {
        return families_.as<Kind>(i);
    }
    bool is_right_cylinder(std::uint32_t i) const {
        return families_.is_cylinder(i) && is_right_circular(*as<Cone>(i));
    }

    /// Planes, edges and cylinders that the cylinder touches along a line or at a point. Two cylinders of one
    /// radius whose axes meet touch where both are farthest from the plane of the axes; with the same edges
    /// there, and equally many, they meet as mitred prisms do.
    void find_tangents(std::uint32_t i, SharedFamily& family) {
        const Cone& cylinder = *as<Cone>(i);
        const auto touch_at = [&](const Point& direction) {
            if (!family.axes) family.axes = axes_of(families_.up(i), direction);
            family.is_straight = family.is_straight || axis_along(*family.axes, direction);
        };
        const auto touch_in_plane = [&](const Eigen::Vector2d& local) {
            touch_at((cylinder.map().linear().leftCols<2>() * local).normalized());
        };
        for (std::uint32_t j = 0; j < families_.primitives().size(); ++j) {
            if (!families_.may_touch(family, j)) continue;
            const Shape& other = *families_.primitives()[j].shape;
            for (std::uint32_t face = 0; face < other.faces().size(); ++face) {
                if (!other.faces()[face].planar) continue;
                const Point p = other.project(face, cylinder.map().translation());
                if (const auto direction = touching_direction(cylinder, other.face_normal(face, p), p))
                    touch_in_plane(*direction);
            }
            if (is_right_cylinder(i) && is_right_cylinder(j) && families_.family_of(j) != i)
                find_tangent_cylinder(i, j, touch_at);
        }
        for (std::uint32_t j = 0; j < families_.primitives().size(); ++j)
            if (const auto* polyhedron = as<Polyhedron>(j);
                polyhedron != nullptr && families_.may_touch(family, j))
                for (const auto& [a, b] : edges_of(*polyhedron))
                    if (const auto direction = touching_direction_of_edge(cylinder, a, b))
                        touch_in_plane(*direction);
    }

    void find_tangent_cylinder(std::uint32_t i, std::uint32_t j, const auto& touch_at) {
        const double radius = as<Cone>(i)->map().linear().col(0).norm();
        const Point up = families_.up(i);
        const Point between = as<Cone>(j)->map().translation() - as<Cone>(i)->map().translation();
        const Point across = up.cross(families_.up(j));
        const bool are_parallel = across.norm() <= coincidence;
        const Point way = are_parallel ? Point(between - between.dot(up) * up)
                                       : Point(between.dot(across) / across.squaredNorm() * across);
        const double distance = way.norm() / radius;
        const double ratio = as<Cone>(j)->map().linear().col(0).norm() / radius;
        if (!near(distance, 1 + ratio) && !near(distance, std::abs(1 - ratio))) return;
        if (distance > coincidence)
            touch_at(way.normalized());
        else if (!are_parallel) {
            touch_at(across.normalized());
            families_.unite_circles(families_.circle_number(i, false), families_.circle_number(j, false));
        }
    }

    static std::vector<std::pair<Point, Point>> edges_of(const Polyhedron& polyhedron) {
        std::vector<std::pair<Point, Point>> edges;
        for (std::uint32_t face = 0; face < polyhedron.faces().size(); ++face)
            for (const auto& loop : polyhedron.polygon(face).loops)
                for (std::size_t k = 0; k < loop.size(); ++k)
                    edges.emplace_back(polyhedron.points()[loop[k]],
                                       polyhedron.points()[loop[(k + 1) % loop.size()]]);
        return edges;
    }

    /// One after the other: each contact of a cylinder and a sphere for which their axes agree.
    void link_spheres() {
        for (auto& [i, cylinders] : families_.by_first()) {
            if (!is_right_cylinder(i)) continue;
            const auto [low, high] = std::ranges::minmax(cylinders.heights);
            for (auto& [j, spheres] : families_.by_first()) {
                const auto* sphere = as<Ellipsoid>(j);
                if (sphere == nullptr || !is_sphere(*sphere)) continue;
                const Point centre = as<Cone>(i)->map().inverse() * sphere->map().translation();
                if (!near(sphere->semi_axes()[0] / as<Cone>(i)->map().linear().col(0).norm(), 1) ||
                    !(centre.head<2>().norm() <= coincidence) || !meet({low, high}, {centre.z(), centre.z()}))
                    continue;
                if (!families_.agree(i, cylinders.axes, spheres.axes)) continue;
                const std::uint32_t number = families_.circle_number(i, false);
                cylinders.circles.push_back({centre.z(), number});
                families_.link_sizes(i, j);
                families_.unite_circles(number, families_.circle_number(j, false));
            }
        }
    }

    /// Cones that end in the same circle.
    void link_ends() {
        struct End {
            std::uint32_t primitive;
            bool is_top;
        };
        std::vector<End> ends;
        for (const std::uint32_t i : families_.round())
            for (const bool end : {false, true})
                if (const auto* cone = as<Cone>(i);
                    cone != nullptr && is_nearly_round(*cone) && cone->cap(end))
                    ends.push_back({i, end});
        auto& families = families_.by_first();
        for (std::size_t a = 0; a < ends.size(); ++a)
            for (std::size_t b = a + 1; b < ends.size(); ++b) {
                if (!are_ends_equal(*as<Cone>(ends[a].primitive), ends[a].is_top,
                                    *as<Cone>(ends[b].primitive), ends[b].is_top))
                    continue;
                const std::uint32_t i = families_.family_of(ends[a].primitive),
                                    j = families_.family_of(ends[b].primitive);
                if (i != j && !families_.agree(i, families.at(i).axes, families.at(j).axes)) continue;
                families_.unite_circles(families_.circle_number(ends[a].primitive, ends[a].is_top),
                                        families_.circle_number(ends[b].primitive, ends[b].is_top));
            }
    }

    void level_sizes() {
        std::map<std::uint32_t, double> smallest;
        for (const bool is_known : {false, true})
            for (const auto& [i, family] : families_.by_first()) {
                double& size = smallest.try_emplace(families_.size_group(i), sizes_[i]).first->second;
                for (const std::uint32_t member : family.members)
                    (is_known ? sizes_[member] : size) = std::min(size, sizes_[member]);
            }
    }

    /// Circles of one number have equally many edges, as many as any of them needs.
    void count_edges() {
        const auto raise = [&](std::uint32_t number, int wanted) {
            int& count = counts_[families_.circle_group(number)];
            count = std::max(count, wanted);
        };
        for (const std::uint32_t i : families_.round())
            for (const bool end : {false, true}) raise(families_.circle_number(i, end), count_at_end(i, end));
        for (const auto& [i, family] : families_.by_first())
            for (const SharedCircle& circle : family.circles)
                raise(circle.number, count_at(i, family, circle.place));
    }

    int count(std::uint32_t number) { return counts_[families_.circle_group(number)]; }

    template <class Kind>
    Sizing sizing(const Kind& shape, std::uint32_t i) const {
        return {shape, {.size = sizes_[i], .chord_tolerance = chord_tolerance_}, thinnest_radius(shape)};
    }

    /// Edges that the size asks for at the end of a cone or along a great circle of a sphere.
    int count_at_end(std::uint32_t i, bool end) const {
        if (const auto* cone = as<Cone>(i))
            return cone->cap(end) ? rim_count(*cone, sizing(*cone, i), end) : 0;
        const auto* sphere = as<Ellipsoid>(i);
        if (sphere == nullptr || !is_sphere(*sphere)) return 0;
        const double radius = sphere->semi_axes()[0];
        // As many equilateral triangles in an eighth of the sphere as it has room for.
        const double density = std::sqrt(2 * std::numbers::pi / std::numbers::sqrt3);
        return 4 * doubling_count(density * radius / sizing(*sphere, i).for_curvature(1 / radius), 3);
    }

    /// Edges that the size asks for along another circle.
    int count_at(std::uint32_t i, const SharedFamily& family, double place) const {
        if (const auto* cone = as<Cone>(i)) {
            const Circumference circle(cone->map(), sizing(*cone, i), cone->radius(place));
            return rim_count(circle, circle.length());
        }
        const Shape& shape = *families_.primitives()[i].shape;
        if (!family.reference) return 0;
        const Eigen::Affine3d& frame = family.reference->map();
        if (const auto* torus = as<Torus>(i)) return rim_count(shape, frame, sizing(*torus, i), place);
        return rim_count(shape, frame, sizing(*as<Ellipsoid>(i), i), place);
    }

    std::optional<SharedSurface> cut_of(std::uint32_t i, const SharedFamily& family) {
        if (as<Cone>(i) != nullptr) {
            if (family.members.size() < 2 && !family.axes && family.circles.empty()) return std::nullopt;
            return SharedSurface{cone_cut(i, family)};
        }
        if (!family.circles.empty()) return SharedSurface{round_cut(family)};
        const auto* sphere = as<Ellipsoid>(i);
        if (sphere == nullptr || !is_sphere(*sphere) || (family.members.size() < 2 && !family.axes))
            return std::nullopt;
        return SharedSurface{SharedSphere{family.axes.value_or(Eigen::Matrix3d::Identity()),
                                          count(families_.circle_number(i, false))}};
    }

    SharedCone cone_cut(std::uint32_t i, const SharedFamily& family) {
        std::map<double, int> rims;
        for (const std::uint32_t member : family.members) {
            const Eigen::Affine3d map = as<Cone>(i)->map().inverse() * as<Cone>(member)->map();
            for (const bool end : {false, true})
                rims[(map * Point(0, 0, end ? 1 : 0)).z()] = count(families_.circle_number(member, end));
        }
        for (const double height : family.heights)
            rims.try_emplace(height, count(families_.circle_number(i, false)));
        for (const SharedCircle& circle : family.circles)
            rims.try_emplace(circle.place, count(circle.number));
        SharedCone cut{.reference = families_.reference(i), .rims = {}, .is_straight = family.is_straight};
        for (const auto& [height, count] : rims)
            if (cut.rims.empty() || !near(cut.rims.back().height, height))
                cut.rims.push_back({height, count});
            else
                cut.rims.back().count = std::max(cut.rims.back().count, count);
        return cut;
    }

    SharedRound round_cut(const SharedFamily& family) {
        SharedRound cut{.reference = family.reference.value(), .rims = {}};
        for (const SharedCircle& circle : family.circles)
            cut.rims.push_back({circle.place, count(circle.number)});
        std::ranges::sort(cut.rims, {}, &RoundRim::angle);
        return cut;
    }

    SharedFamilies families_;
    std::span<double> sizes_;
    double chord_tolerance_;
    std::map<std::uint32_t, int> counts_;  ///< of edges, by group of circles
};

}  // namespace

std::vector<std::shared_ptr<const SharedSurface>> find_shared_surfaces(std::span<const Primitive> primitives,
                                                                       std::span<double> sizes,
                                                                       double chord_tolerance) {
    return Finder(primitives, sizes, chord_tolerance).cuts();
}

}  // namespace maille::modeler
