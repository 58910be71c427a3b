#include "modeler/shared_families.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modeler/coincident.hh"

namespace maille::modeler {

std::optional<int> axis_along(const Eigen::Matrix3d& axes, const Point& direction) {
    for (int k = 0; k < 3; ++k)
        if (axes.col(k).cross(direction).norm() <= coincidence) return k;
    return std::nullopt;
}

Eigen::Matrix3d axes_of(const Point& up, const Point& first) {
    Eigen::Matrix3d axes;
    axes << first, up.cross(first), up;
    return axes;
}

SharedFamilies::SharedFamilies(std::span<const Primitive> primitives)
    : primitives_(primitives), linked_(primitives.size()), circles_(3 * primitives.size()) {
    for (std::uint32_t i = 0; i < primitives_.size(); ++i) {
        const Eigen::AlignedBox3d box = primitives_[i].shape->bounding_box();
        const double margin = 2 * coincidence * box.diagonal().norm();
        boxes_.emplace_back(box.min().array() - margin, box.max().array() + margin);
        if (as<Cone>(i) != nullptr || as<Ellipsoid>(i) != nullptr || as<Torus>(i) != nullptr)
            round_.push_back(i);
    }
    volmesh::UnionFind sets(primitives_.size());
    for (std::size_t a = 0; a < round_.size(); ++a)
        for (std::size_t b = a + 1; b < round_.size(); ++b)
            if (boxes_[round_[a]].intersects(boxes_[round_[b]]) && are_on_one(round_[a], round_[b]))
                sets.unite(round_[a], round_[b]);
    for (const std::uint32_t i : round_) {
        family_of_[i] = sets.find(i);
        SharedFamily& family = families_[sets.find(i)];
        family.members.push_back(i);
        if (as<Cone>(i) == nullptr) continue;
        const Span span = span_on(*as<Cone>(family.members[0]), *as<Cone>(i)).value_or(Span{0, 1});
        family.heights.insert(family.heights.end(), {span.low, span.high});
    }
}

bool SharedFamilies::are_on_one(std::uint32_t a, std::uint32_t b) const {
    if (as<Cone>(a) != nullptr && as<Cone>(b) != nullptr) {
        const auto span = span_on(*as<Cone>(a), *as<Cone>(b));
        return span && meet({0, 1}, *span);
    }
    if (as<Torus>(a) != nullptr && as<Torus>(b) != nullptr) return are_equal(*as<Torus>(a), *as<Torus>(b));
    return as<Ellipsoid>(a) != nullptr && as<Ellipsoid>(b) != nullptr &&
           are_equal(*as<Ellipsoid>(a), *as<Ellipsoid>(b));
}

bool SharedFamilies::is_cylinder(std::uint32_t i) const {
    const auto* cone = as<Cone>(i);
    return cone != nullptr && cone->radius(0) == cone->radius(1);
}

bool SharedFamilies::may_touch(const SharedFamily& family, std::uint32_t primitive) const {
    return std::ranges::any_of(family.members,
                               [&](std::uint32_t i) { return boxes_[i].intersects(boxes_[primitive]); });
}

bool SharedFamilies::may_touch(const SharedFamily& a, const SharedFamily& b) const {
    return std::ranges::any_of(b.members, [&](std::uint32_t i) { return may_touch(a, i); });
}

std::uint32_t SharedFamilies::circle_number(std::uint32_t i, bool end) const {
    if (as<Cone>(i) == nullptr || is_cylinder(i)) return 3 * family_of(i);
    return 3 * i + (end ? 2 : 1);
}

bool SharedFamilies::agree(std::uint32_t cone, SharedFamily::Axes& of_cone,
                           SharedFamily::Axes& of_other) const {
    if (!of_cone && of_other && axis_along(*of_other, up(cone))) of_cone = of_other;
    if (!of_cone && of_other) return false;
    if (!of_cone) of_cone = axes_of(up(cone), first_generator(cone));
    if (!of_other) of_other = of_cone;
    return axis_along(*of_other, of_cone->col(0)) && axis_along(*of_other, of_cone->col(1)) &&
           axis_along(*of_other, of_cone->col(2));
}

Cone SharedFamilies::reference(std::uint32_t i) const {
    const Cone& cone = *as<Cone>(i);
    const SharedFamily::Axes& axes = family(family_of(i)).axes;
    if (!axes) return cone;
    // An axis that is across, and of the four directions a quarter of a turn from each other the nearest.
    const Point axis = axes->col(std::abs(axes->col(0).dot(up(i))) > 0.5 ? 1 : 0);
    const Point local = cone.map().linear().inverse() * axis;
    const double angle = std::remainder(std::atan2(local.y(), local.x()), std::numbers::pi / 2);
    if (std::abs(angle) <= coincidence) return cone;
    return {cone.radius(0), cone.radius(1), cone.map() * Eigen::AngleAxisd(angle, Point::UnitZ())};
}

}  // namespace maille::modeler
