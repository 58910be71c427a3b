#pragma once

#include <array>
#include <variant>
#include <vector>

#include "modeler/profile.hh"
#include "modeler/shape_cone_side.hh"
#include "modeler/shape_plane.hh"
#include "modeler/shape_turned_arc.hh"

namespace maille::modeler {

/// The affine image of what a profile sweeps when it turns about the z axis, from the half-plane of the
/// positive x axis, counter-clockwise, by `span` degrees. One face for each edge that is not on the axis, in
/// the order of the profile: an annulus, the side of a cylinder or cone, or part of a torus or sphere; then,
/// unless the turn is full, the profile itself at its start and end.
class Turned final : public Shape {
  public:
    /// With arcs in the profile the map has to keep angles.
    Turned(Profile profile, double span, const std::array<std::string, 2>& cap_names,
           const Eigen::Affine3d& map);

    std::span<const PrimitiveFace> faces() const override { return faces_; }
    Eigen::AlignedBox3d bounding_box() const override;
    double implicit(const Point& p) const override;
    double face_implicit(std::uint32_t face, const Point& p) const override;
    Point face_normal(std::uint32_t face, const Point& p) const override;
    Eigen::Matrix3d face_curvature(std::uint32_t face, const Point& p) const override;
    Point project(std::uint32_t face, const Point& p) const override;
    double max_curvature(std::uint32_t face) const override;

    const Profile& profile() const { return profile_; }
    const Eigen::Affine3d& map() const { return map_; }
    double span() const { return span_; }
    bool is_full() const { return span_ == 360; }
    /// The face at the start or end of a turn that is not full.
    std::uint32_t cap(bool end) const { return static_cast<std::uint32_t>(faces_.size()) - (end ? 1 : 2); }
    const Plane& plane(std::uint32_t face) const { return std::get<Plane>(surfaces_[face]); }

  private:
    /// The side of a cone, seen from outside or from inside.
    struct Side {
        ConeSide cone;
        double sense;
    };

    void add_edge(const ProfileEdge& edge);
    double farthest_along(const Eigen::RowVector3d& direction) const;

    Profile profile_;
    double span_;
    Eigen::Affine3d map_, inverse_;
    double least_stretch_;
    double size_ = 0;  ///< of the profile
    std::vector<PrimitiveFace> faces_;
    std::vector<std::variant<Plane, Side, TurnedArc>> surfaces_;
};

/// A solid of revolution about z, as OpenSCAD's `rotate_extrude`, but truly round: the region's x is the
/// distance from z, its y is z, and it turns from the positive x axis, counter-clockwise for an `angle` (in
/// degrees) above 0. The region must not reach across x = 0; where it lies at x < 0 it starts on the negative
/// x axis. Faces: the names of the edges, and `start` and `end` unless the turn is full. Throws InputError
/// for a profile of which no solid can be made, or one with arcs where the frame does not keep angles.
std::shared_ptr<const Shape> make_turned(Profile profile, double angle, const Eigen::Affine3d& frame);

}  // namespace maille::modeler
