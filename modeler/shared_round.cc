#include <algorithm>
#include <cmath>
#include <numbers>

#include "modeler/coincident.hh"
#include "modeler/meridian.hh"
#include "modeler/shared_families.hh"

namespace maille::modeler {
namespace {

/// Closer than that circles are one: in parts of a cone's height, or angles.
constexpr double same_circle = 1e-6;

class Linker {
  public:
    explicit Linker(SharedFamilies& families) : families_(families) {}

    void run() {
        for (auto& [j, round] : families_.by_first()) {
            if (!is_free(j, round)) continue;
            for (auto& [i, cones] : families_.by_first())
                if (families_.as<Cone>(i) != nullptr && families_.may_touch(cones, round))
                    link_to_cones(i, cones, j, round);
        }
        for (auto& [j, round] : families_.by_first())
            for (auto& [k, other] : families_.by_first())
                if (j < k && is_free(j, round) && is_free(k, other) && families_.may_touch(round, other))
                    link(j, round, k, other);
        for (auto& [j, round] : families_.by_first())
            if (families_.as<Torus>(j) != nullptr) link_to_planes(j, round);
    }

  private:
    const Shape& shape(std::uint32_t i) const { return *families_.primitives()[i].shape; }

    /// Whether it is an ellipsoid or torus, and has no great circles along three axes already.
    bool is_free(std::uint32_t j, const SharedFamily& family) const {
        return families_.as<Cone>(j) == nullptr && !family.axes;
    }

    void link_to_cones(std::uint32_t i, SharedFamily& cones, std::uint32_t j, SharedFamily& round) {
        const Cone& cone = *families_.as<Cone>(i);
        const auto meridian = meridian_in(cone.map(), shape(j));
        if (!meridian) return;
        const auto [low, high] = std::ranges::minmax(cones.heights);
        const auto found = touching_circles(*meridian, cone, low, high, cones.heights);
        if (found.empty() || !turn_alike(i, cones, round)) return;
        families_.link_sizes(i, j);
        for (const TouchingCircle& circle : found) {
            const std::uint32_t number = number_on_cones(cones, circle.other);
            cones.circles.push_back({circle.other, number});
            add_circle(j, round, cone.map() * Point(cone.radius(circle.other), 0, circle.other), number);
        }
    }

    /// Gives the round surface a reference whose circles have the same points as the cone's, or tells whether
    /// the one that it has is such.
    bool turn_alike(std::uint32_t i, SharedFamily& cones, SharedFamily& round) {
        if (!round.reference) {
            if (is_nearly_round(*families_.as<Cone>(i)) && !cones.axes)
                cones.axes = axes_of(families_.up(i), families_.first_generator(i));
            round.reference = families_.reference(i);
            return true;
        }
        const Eigen::Matrix3d& linear = round.reference->map().linear();
        SharedFamily::Axes wanted = axes_of(linear.col(2).normalized(), linear.col(0).normalized());
        if (is_nearly_round(*round.reference) && !families_.agree(i, cones.axes, wanted)) return false;
        return turn_alike(*round.reference, families_.reference(i));
    }

    /// Whether circles about their axis have the same points on both.
    static bool turn_alike(const Cone& a, const Cone& b) {
        const Eigen::Matrix3d map = a.map().linear().inverse() * b.map().linear();
        const Eigen::Array2d x = map.col(0).head<2>().cwiseAbs(), y = map.col(1).head<2>().cwiseAbs();
        const double slack = coincidence * x.maxCoeff();
        const bool is_quarter_turn =
            x.minCoeff() <= slack && y.minCoeff() <= slack && std::abs(x.maxCoeff() - y.maxCoeff()) <= slack;
        if (is_nearly_round(a)) return is_quarter_turn;
        // How points are spread around an ellipse depends on its size.
        return a.map().matrix() == b.map().matrix() && a.radius(0) == b.radius(0) &&
               a.radius(1) == b.radius(1);
    }

    /// The number of the circle at that height; a new one if there is none.
    std::uint32_t number_on_cones(const SharedFamily& cones, double height) {
        const std::uint32_t first = cones.members[0];
        if (families_.is_cylinder(first)) return families_.circle_number(first, false);
        for (const std::uint32_t member : cones.members)
            for (const bool end : {false, true}) {
                const Eigen::Affine3d map =
                    families_.as<Cone>(first)->map().inverse() * families_.as<Cone>(member)->map();
                if (std::abs((map * Point(0, 0, end)).z() - height) <= same_circle)
                    return families_.circle_number(member, end);
            }
        for (const SharedCircle& circle : cones.circles)
            if (std::abs(circle.place - height) <= same_circle) return circle.number;
        return families_.new_circle();
    }

    /// Through a point in space.
    void add_circle(std::uint32_t j, SharedFamily& round, const Point& p, std::uint32_t number) {
        const Eigen::Affine3d& frame = round.reference->map();
        const Point local = frame.inverse() * p;
        double angle = meridian_in(frame, shape(j)).value().angle_of({local.head<2>().norm(), local.z()});
        if (angle <= -std::numbers::pi + same_circle) angle += 2 * std::numbers::pi;
        for (const SharedCircle& circle : round.circles)
            if (std::abs(circle.place - angle) <= same_circle)
                return families_.unite_circles(circle.number, number);
        round.circles.push_back({angle, number});
    }

    /// Two ellipsoids or tori.
    void link(std::uint32_t j, SharedFamily& round, std::uint32_t k, SharedFamily& other) {
        const std::optional<Eigen::Affine3d> frame = round.reference   ? round.reference->map()
                                                     : other.reference ? other.reference->map()
                                                                       : common_frame(shape(j), shape(k));
        const auto of_round = frame ? meridian_in(*frame, shape(j)) : std::nullopt;
        const auto of_other = frame ? meridian_in(*frame, shape(k)) : std::nullopt;
        if (!of_round || !of_other) return;
        const auto found = touching_circles(*of_round, *of_other);
        if (found.empty()) return;
        if (!round.reference) round.reference = other.reference ? other.reference : Cone(1, 1, *frame);
        if (!other.reference) other.reference = round.reference;
        if (!turn_alike(*round.reference, *other.reference)) return;
        families_.link_sizes(j, k);
        for (const TouchingCircle& circle : found) {
            const Eigen::Vector2d p = of_other->at(circle.other);
            const std::uint32_t number = families_.new_circle();
            add_circle(j, round, *frame * Point(p.x(), 0, p.y()), number);
            add_circle(k, other, *frame * Point(p.x(), 0, p.y()), number);
        }
    }

    void link_to_planes(std::uint32_t j, SharedFamily& round) {
        const Eigen::Affine3d& map = families_.as<Torus>(j)->map();
        const Meridian meridian = meridian_in(map, shape(j)).value();
        for (std::uint32_t k = 0; k < families_.primitives().size(); ++k) {
            if (!families_.may_touch(round, k)) continue;
            for (std::uint32_t face = 0; face < shape(k).faces().size(); ++face) {
                if (!shape(k).faces()[face].planar) continue;
                const Point p = shape(k).project(face, map.translation());
                const Point normal = map.linear().transpose() * shape(k).face_normal(face, p);
                const auto angle = touching_angle(meridian, (map.inverse() * p).z());
                if (!angle || !(normal.head<2>().norm() <= coincidence * normal.norm())) continue;
                if (!round.reference) round.reference = Cone(1, 1, map);
                const Eigen::Vector2d q = meridian.at(*angle);
                add_circle(j, round, map * Point(q.x(), 0, q.y()), families_.new_circle());
            }
        }
    }

    SharedFamilies& families_;
};

}  // namespace

void link_round_surfaces(SharedFamilies& families) {
    Linker(families).run();
}

}  // namespace maille::modeler
