#include "modeler/shared_surface.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "modeler/arrange_union_find.hh"
#include "modeler/shape_ellipsoid.hh"
#include "modeler/shape_frame.hh"
#include "modeler/tessellate_rows.hh"

namespace maille::modeler {
namespace {

/// Of lengths, in parts of the surface's radius.
constexpr double tolerance = 1e-9;

bool near(double a, double b) {
    return std::abs(a - b) <= tolerance * std::max({1.0, std::abs(a), std::abs(b)});
}

struct Span {
    double low, high;
};

bool meet(const Span& a, const Span& b) {
    return a.low <= b.high + tolerance && b.low <= a.high + tolerance;
}

/// The heights between which the cone lies in the coordinates of another with the same side; nothing where
/// their sides differ.
std::optional<Span> span_on(const Cone& reference, const Cone& cone) {
    const Eigen::Affine3d map = reference.map().inverse() * cone.map();
    const Point bottom = map.translation(), way = map.linear().col(2);
    if (!(bottom.head<2>().norm() <= tolerance && way.head<2>().norm() <= tolerance)) return std::nullopt;
    if (!(map.linear().row(2).head<2>().norm() <= tolerance)) return std::nullopt;
    const Eigen::Matrix2d across = map.linear().topLeftCorner<2, 2>();
    const double scale = std::sqrt(std::abs(across.determinant()));
    const Eigen::Matrix2d stretch = across.transpose() * across / (scale * scale);
    if (!((stretch - Eigen::Matrix2d::Identity()).norm() <= tolerance)) return std::nullopt;
    const double top = bottom.z() + way.z();
    if (!near(scale * cone.radius(0), reference.radius(bottom.z())) ||
        !near(scale * cone.radius(1), reference.radius(top)))
        return std::nullopt;
    return Span{std::min(bottom.z(), top), std::max(bottom.z(), top)};
}

/// Whether what it makes of circles about its axis are circles about its axis.
bool is_right_circular(const Cone& cone) {
    const Eigen::Matrix3d gram = cone.map().linear().transpose() * cone.map().linear();
    return near(gram(0, 0) / gram(1, 1), 1) && std::abs(gram(0, 1)) <= tolerance * gram(0, 0) &&
           std::max(std::abs(gram(0, 2)), std::abs(gram(1, 2))) <=
               tolerance * std::sqrt(gram(0, 0) * gram(2, 2));
}

bool is_sphere(const Ellipsoid& shape) {
    return is_similarity(shape.map().linear());
}

bool are_equal(const Ellipsoid& a, const Ellipsoid& b) {
    const double radius = a.semi_axes()[0];
    return (a.map().translation() - b.map().translation()).norm() <= tolerance * radius &&
           near(b.semi_axes()[0] / radius, 1);
}

/// The end of a cone, as a circle in space.
struct Circle {
    Point centre, normal;
    double radius;
};

bool are_equal(const Circle& a, const Circle& b) {
    return (a.centre - b.centre).norm() <= tolerance * a.radius && near(b.radius / a.radius, 1) &&
           a.normal.cross(b.normal).norm() <= tolerance;
}

/// Number of the axis that the direction is parallel to.
std::optional<int> axis_along(const Eigen::Matrix3d& axes, const Point& direction) {
    for (int k = 0; k < 3; ++k)
        if (axes.col(k).cross(direction).norm() <= tolerance) return k;
    return std::nullopt;
}

using Axes = std::optional<Eigen::Matrix3d>;

Eigen::Matrix3d axes_of(const Point& up, const Point& first) {
    Eigen::Matrix3d axes;
    axes << first, up.cross(first), up;
    return axes;
}

/// Primitives on one surface, the first of which tells the coordinates.
struct Family {
    std::vector<std::uint32_t> members;
    std::vector<double> heights{};  ///< of cones: where there are rims
    Axes axes{};                    ///< along which circles have points, and of a sphere's great circles
    bool is_straight = false;
};

class Finder {
  public:
    Finder(std::span<const Primitive> primitives, std::span<double> sizes, double chord_tolerance)
        : primitives_(primitives),
          sizes_(sizes),
          chord_tolerance_(chord_tolerance),
          linked_(primitives.size()),
          circles_(3 * primitives.size()) {
        find_families();
        for (auto& [i, family] : families_)
            if (is_right_cylinder(i)) find_tangents(i, family);
        link_spheres();
        link_ends();
        level_sizes();
    }

    std::vector<std::shared_ptr<const SharedSurface>> cuts() {
        std::map<std::uint32_t, int> counts;
        for (const std::uint32_t i : round_)
            for (const bool end : {false, true}) {
                int& count = counts[circles_.find(circle_number(i, end))];
                count = std::max(count, count_of(i, end));
            }
        std::vector<std::shared_ptr<const SharedSurface>> result(primitives_.size());
        for (auto& [i, family] : families_) {
            if (family.members.size() < 2 && !family.axes) continue;
            const auto cut = std::make_shared<const SharedSurface>(
                as<Cone>(i) != nullptr
                    ? SharedSurface{cone_cut(i, family, counts)}
                    : SharedSurface{SharedSphere{family.axes.value_or(Eigen::Matrix3d::Identity()),
                                                 counts[circles_.find(circle_number(i, false))]}});
            for (const std::uint32_t member : family.members) result[member] = cut;
        }
        return result;
    }

  private:
    template <class Kind>
    const Kind* as(std::uint32_t i) const {
        return dynamic_cast<const Kind*>(primitives_[i].shape.get());
    }
    bool is_cylinder(std::uint32_t i) const {
        const auto* cone = as<Cone>(i);
        return cone != nullptr && cone->radius(0) == cone->radius(1);
    }
    bool is_right_cylinder(std::uint32_t i) const {
        return is_cylinder(i) && is_right_circular(*as<Cone>(i));
    }
    Point up(std::uint32_t i) const { return as<Cone>(i)->map().linear().col(2).normalized(); }
    Point first_generator(std::uint32_t i) const { return as<Cone>(i)->map().linear().col(0).normalized(); }

    bool may_touch(std::uint32_t a, std::uint32_t b) const { return boxes_[a].intersects(boxes_[b]); }

    bool are_on_one(std::uint32_t a, std::uint32_t b) const {
        if (as<Cone>(a) != nullptr && as<Cone>(b) != nullptr) {
            const auto span = span_on(*as<Cone>(a), *as<Cone>(b));
            return span && meet({0, 1}, *span);
        }
        return as<Ellipsoid>(a) != nullptr && as<Ellipsoid>(b) != nullptr &&
               are_equal(*as<Ellipsoid>(a), *as<Ellipsoid>(b));
    }

    void find_families() {
        for (std::uint32_t i = 0; i < primitives_.size(); ++i) {
            const Eigen::AlignedBox3d box = primitives_[i].shape->bounding_box();
            const double margin = 2 * tolerance * box.diagonal().norm();
            boxes_.emplace_back(box.min().array() - margin, box.max().array() + margin);
            const auto* ellipsoid = as<Ellipsoid>(i);
            if (as<Cone>(i) != nullptr || (ellipsoid != nullptr && is_sphere(*ellipsoid)))
                round_.push_back(i);
        }
        detail::UnionFind sets(primitives_.size());
        for (std::size_t a = 0; a < round_.size(); ++a)
            for (std::size_t b = a + 1; b < round_.size(); ++b)
                if (may_touch(round_[a], round_[b]) && are_on_one(round_[a], round_[b]))
                    sets.unite(round_[a], round_[b]);
        for (const std::uint32_t i : round_) {
            family_of_[i] = sets.find(i);
            Family& family = families_[sets.find(i)];
            family.members.push_back(i);
            if (as<Cone>(i) == nullptr) continue;
            const Span span = span_on(*as<Cone>(family.members[0]), *as<Cone>(i)).value_or(Span{0, 1});
            family.heights.insert(family.heights.end(), {span.low, span.high});
        }
    }

    /// Planes and cylinders that the cylinder touches along a line or at a point. Two cylinders of one radius
    /// whose axes meet touch where both are farthest from the plane of the axes; with the same edges there,
    /// and equally many, they meet as mitred prisms do.
    void find_tangents(std::uint32_t i, Family& family) {
        const Eigen::Affine3d& map = as<Cone>(i)->map();
        const double radius = map.linear().col(0).norm();
        const auto touch_at = [&](const Point& direction) {
            if (!family.axes) family.axes = axes_of(up(i), direction);
            family.is_straight = family.is_straight || axis_along(*family.axes, direction);
        };
        const auto touches = [&](std::uint32_t other) {
            return std::ranges::any_of(family.members, [&](auto member) { return may_touch(member, other); });
        };
        for (std::uint32_t j = 0; j < primitives_.size(); ++j) {
            const Shape& other = *primitives_[j].shape;
            if (!touches(j)) continue;
            for (std::uint32_t face = 0; face < other.faces().size(); ++face) {
                if (!other.faces()[face].planar) continue;
                const Point normal = other.face_normal(face, map.translation());
                if (std::abs(normal.dot(up(i))) <= tolerance &&
                    near(std::abs(other.face_implicit(face, map.translation())) / radius, 1))
                    touch_at(normal);
            }
            if (!is_right_cylinder(j) || family_of_[j] == i) continue;
            const Point between = as<Cone>(j)->map().translation() - map.translation();
            const Point across = up(i).cross(up(j));
            const bool are_parallel = across.norm() <= tolerance;
            const Point way = are_parallel ? Point(between - between.dot(up(i)) * up(i))
                                           : Point(between.dot(across) / across.squaredNorm() * across);
            const double distance = way.norm() / radius;
            const double ratio = as<Cone>(j)->map().linear().col(0).norm() / radius;
            if (!near(distance, 1 + ratio) && !near(distance, std::abs(1 - ratio))) continue;
            if (distance > tolerance)
                touch_at(way.normalized());
            else if (!are_parallel) {
                touch_at(across.normalized());
                circles_.unite(circle_number(i, false), circle_number(j, false));
            }
        }
    }

    /// One after the other: each contact of a cylinder and a sphere for which their axes agree.
    void link_spheres() {
        for (auto& [i, cylinders] : families_) {
            if (!is_right_cylinder(i)) continue;
            const auto [low, high] = std::ranges::minmax(cylinders.heights);
            for (auto& [j, spheres] : families_) {
                const auto* sphere = as<Ellipsoid>(j);
                if (sphere == nullptr) continue;
                const Point centre = as<Cone>(i)->map().inverse() * sphere->map().translation();
                if (!near(sphere->semi_axes()[0] / as<Cone>(i)->map().linear().col(0).norm(), 1) ||
                    !(centre.head<2>().norm() <= tolerance) || !meet({low, high}, {centre.z(), centre.z()}))
                    continue;
                if (!agree(i, cylinders.axes, spheres.axes)) continue;
                cylinders.heights.push_back(centre.z());
                linked_.unite(i, j);
                circles_.unite(circle_number(i, false), circle_number(j, false));
            }
        }
    }

    /// Cones that end in the same circle.
    void link_ends() {
        struct End {
            Circle circle;
            std::uint32_t primitive;
            bool is_top;
        };
        std::vector<End> ends;
        for (const std::uint32_t i : round_) {
            const auto* cone = as<Cone>(i);
            if (cone == nullptr || !is_right_circular(*cone)) continue;
            for (const bool end : {false, true})
                if (cone->cap(end))
                    ends.push_back({{cone->map() * Point(0, 0, end ? 1 : 0), up(i),
                                     cone->radius(end) * cone->map().linear().col(0).norm()},
                                    i,
                                    end});
        }
        for (std::size_t a = 0; a < ends.size(); ++a)
            for (std::size_t b = a + 1; b < ends.size(); ++b) {
                if (!are_equal(ends[a].circle, ends[b].circle)) continue;
                const std::uint32_t i = family_of_[ends[a].primitive], j = family_of_[ends[b].primitive];
                if (i != j && !agree(i, families_[i].axes, families_[j].axes)) continue;
                circles_.unite(circle_number(ends[a].primitive, ends[a].is_top),
                               circle_number(ends[b].primitive, ends[b].is_top));
            }
    }

    /// Makes the axes agree with those of a cone, where they can.
    bool agree(std::uint32_t cone, Axes& of_cone, Axes& of_other) const {
        if (!of_cone && of_other && axis_along(*of_other, up(cone))) of_cone = of_other;
        if (!of_cone && of_other) return false;
        if (!of_cone) of_cone = axes_of(up(cone), first_generator(cone));
        if (!of_other) of_other = of_cone;
        return axis_along(*of_other, of_cone->col(0)) && axis_along(*of_other, of_cone->col(1)) &&
               axis_along(*of_other, of_cone->col(2));
    }

    void level_sizes() {
        std::map<std::uint32_t, double> smallest;
        for (const bool is_known : {false, true})
            for (const auto& [i, family] : families_) {
                double& size = smallest.try_emplace(linked_.find(i), sizes_[i]).first->second;
                for (const std::uint32_t member : family.members)
                    (is_known ? sizes_[member] : size) = std::min(size, sizes_[member]);
            }
    }

    /// Circles of one number have equally many edges: all of a cylinder's, all of a sphere's.
    std::uint32_t circle_number(std::uint32_t i, bool end) const {
        if (as<Cone>(i) == nullptr || is_cylinder(i)) return 3 * family_of_.at(i);
        return 3 * i + (end ? 2 : 1);
    }

    /// Edges of the circle that the size asks for.
    int count_of(std::uint32_t i, bool end) const {
        const TessellateOptions options{.size = sizes_[i], .chord_tolerance = chord_tolerance_};
        if (const auto* cone = as<Cone>(i))
            return cone->cap(end) ? rim_count(*cone, Sizing(*cone, options, thinnest_radius(*cone)), end) : 0;
        const auto& sphere = *as<Ellipsoid>(i);
        const double radius = sphere.semi_axes()[0];
        const Sizing sizing(sphere, options, thinnest_radius(sphere));
        // As many equilateral triangles in an eighth of the sphere as it has room for.
        const double density = std::sqrt(2 * std::numbers::pi / std::numbers::sqrt3);
        return 4 * doubling_count(density * radius / sizing.for_curvature(1 / radius), 3);
    }

    SharedCone cone_cut(std::uint32_t i, const Family& family, std::map<std::uint32_t, int>& counts) {
        std::map<double, int> rims;
        for (const std::uint32_t member : family.members) {
            const Eigen::Affine3d map = as<Cone>(i)->map().inverse() * as<Cone>(member)->map();
            for (const bool end : {false, true})
                rims[(map * Point(0, 0, end ? 1 : 0)).z()] =
                    counts[circles_.find(circle_number(member, end))];
        }
        for (const double height : family.heights)
            rims.try_emplace(height, counts[circles_.find(circle_number(i, false))]);
        SharedCone cut{.reference = reference(i, family), .rims = {}, .is_straight = family.is_straight};
        for (const auto& [height, count] : rims)
            if (cut.rims.empty() || !near(cut.rims.back().height, height))
                cut.rims.push_back({height, count});
            else
                cut.rims.back().count = std::max(cut.rims.back().count, count);
        return cut;
    }

    /// Turned about itself, so that its first generator is in the direction of an axis.
    Cone reference(std::uint32_t i, const Family& family) const {
        const Cone& cone = *as<Cone>(i);
        if (!family.axes) return cone;
        Point first = first_generator(i);
        double best = -1;
        for (int k = 0; k < 3; ++k)
            for (const double sign : {1.0, -1.0}) {
                const Point axis = sign * family.axes->col(k);
                const double cosine = axis.dot(first_generator(i));
                if (std::abs(axis.dot(up(i))) > 0.5 || !(cosine > best + tolerance)) continue;
                best = cosine;
                first = axis;
            }
        if ((first - first_generator(i)).norm() <= tolerance) return cone;
        const Point local = cone.map().linear().inverse() * first;
        const Eigen::AngleAxisd turn(std::atan2(local.y(), local.x()), Point::UnitZ());
        return {cone.radius(0), cone.radius(1), cone.map() * turn};
    }

    std::span<const Primitive> primitives_;
    std::span<double> sizes_;
    double chord_tolerance_;
    std::vector<Eigen::AlignedBox3d> boxes_;            ///< by primitive, a little larger
    std::vector<std::uint32_t> round_;                  ///< cones and spheres
    std::map<std::uint32_t, Family> families_;          ///< by their first member
    std::map<std::uint32_t, std::uint32_t> family_of_;  ///< by primitive
    detail::UnionFind linked_;                          ///< families that have to be of one size
    detail::UnionFind circles_;                         ///< by `circle_number`
};

}  // namespace

std::vector<std::shared_ptr<const SharedSurface>> find_shared_surfaces(std::span<const Primitive> primitives,
                                                                       std::span<double> sizes,
                                                                       double chord_tolerance) {
    return Finder(primitives, sizes, chord_tolerance).cuts();
}

}  // namespace maille::modeler
