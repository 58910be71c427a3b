#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/primitive.hh"
#include "modeler/shape_cone.hh"
#include "volmesh/union_find.hh"

namespace maille::modeler {

/// A circle about a round surface's axis where it has to have points.
struct SharedCircle {
    double place;  ///< on a cone the height in the first member's coordinates; else the meridian's angle
    std::uint32_t number;  ///< circles of one number have equally many edges
};

/// Primitives on one surface, the first of which tells the coordinates.
struct SharedFamily {
    using Axes = std::optional<Eigen::Matrix3d>;

    std::vector<std::uint32_t> members;
    std::vector<double> heights{};        ///< of cones: where there are rims
    std::vector<SharedCircle> circles{};  ///< besides those
    Axes axes{};               ///< along which circles have points, and of a sphere's great circles
    bool is_straight = false;  ///< of a cylinder: has an edge along a line
    std::optional<Cone>
        reference{};  ///< of ellipsoids and tori that have circles about an axis: see SharedRound
};

/// Number of the axis that the direction is parallel to.
std::optional<int> axis_along(const Eigen::Matrix3d& axes, const Point& direction);
/// Orthonormal, in columns: the first direction, one across, the one up.
Eigen::Matrix3d axes_of(const Point& up, const Point& first);

/// The round surfaces of a model, each with the primitives that lie on it, and what they have in common.
class SharedFamilies {
  public:
    explicit SharedFamilies(std::span<const Primitive> primitives);

    template <class Kind>
    const Kind* as(std::uint32_t i) const {
        return dynamic_cast<const Kind*>(primitives_[i].shape.get());
    }
    bool is_cylinder(std::uint32_t i) const;
    Point up(std::uint32_t i) const { return as<Cone>(i)->map().linear().col(2).normalized(); }
    Point first_generator(std::uint32_t i) const { return as<Cone>(i)->map().linear().col(0).normalized(); }

    std::span<const Primitive> primitives() const { return primitives_; }
    std::span<const std::uint32_t> round() const { return round_; }
    /// By their first member.
    std::map<std::uint32_t, SharedFamily>& by_first() { return families_; }
    const SharedFamily& family(std::uint32_t first) const { return families_.at(first); }
    std::uint32_t family_of(std::uint32_t i) const { return family_of_.at(i); }
    bool may_touch(const SharedFamily& family, std::uint32_t primitive) const;
    bool may_touch(const SharedFamily& a, const SharedFamily& b) const;

    /// The same size from now on.
    void link_sizes(std::uint32_t a, std::uint32_t b) { linked_.unite(a, b); }
    std::uint32_t size_group(std::uint32_t family) { return linked_.find(family); }

    /// Number of a cone's end, of all circles of a cylinder, of all great circles of a sphere.
    std::uint32_t circle_number(std::uint32_t i, bool end) const;
    std::uint32_t new_circle() { return circles_.add(); }
    void unite_circles(std::uint32_t a, std::uint32_t b) { circles_.unite(a, b); }
    std::uint32_t circle_group(std::uint32_t number) { return circles_.find(number); }

    /// Makes the axes agree with those of a cone, where they can.
    bool agree(std::uint32_t cone, SharedFamily::Axes& of_cone, SharedFamily::Axes& of_other) const;
    /// A cone turned about itself, so that its first generator is in the direction of an axis of its family.
    Cone reference(std::uint32_t i) const;

  private:
    bool are_on_one(std::uint32_t a, std::uint32_t b) const;

    std::span<const Primitive> primitives_;
    std::vector<Eigen::AlignedBox3d> boxes_;            ///< by primitive, a little larger
    std::vector<std::uint32_t> round_;                  ///< cones, ellipsoids and tori
    std::map<std::uint32_t, SharedFamily> families_;    ///< by their first member
    std::map<std::uint32_t, std::uint32_t> family_of_;  ///< by primitive
    volmesh::UnionFind linked_;                         ///< families that have to be of one size
    volmesh::UnionFind circles_;                        ///< by number
};

/// Finds where ellipsoids and tori touch others along circles about their axis.
void link_round_surfaces(SharedFamilies& families);

}  // namespace maille::modeler
