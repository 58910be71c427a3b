#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "modeler/model.hh"
#include "modeler/outline.hh"
#include "modeler/shapes.hh"

namespace maille::modeler {

/// A solid as a value, to write models in C++:
///
///     const Solid part = (box({4, 2, .5}).named("plate") - cylinder(1, .4).named("hole").at({1, 1,
///     -.2})).size(.2); volmesh::TetMesh mesh = build(part, {.size = .5});
///
/// Immutable; a copy costs a pointer, and solids share what they are made of. Names, materials and sizes hold
/// for all that is in a solid, the innermost wins; primitives without a name are called by their kind and
/// number.
class Solid {
  public:
    ///@{
    /// The same with a name, of a material, or with a wanted edge length.
    Solid named(std::string name) const;
    Solid of(std::string material) const;
    Solid size(double edge_length) const;
    ///@}

    Solid at(const Point& by) const;  ///< moved by that vector
    /// About an axis through the origin.
    Solid rotated(double degrees, const Point& axis = Point::UnitZ()) const;
    ///@{
    /// About the origin. Throws InputError where a factor is 0.
    Solid scaled(const Point& factors) const;
    Solid scaled(double factor) const { return scaled(Point::Constant(factor)); }
    ///@}
    /// In the plane through the origin across that direction.
    Solid mirrored(const Point& normal) const;
    /// Throws InputError where the map flattens.
    Solid mapped(const Eigen::Affine3d& map) const;

    /// The primitives and the tree. Throws InputError where there is no solid left, or where a half-space
    /// makes it endless.
    Model model() const;
    /// The same, so that build takes a solid.
    operator Model() const { return model(); }

    friend Solid operator+(const Solid& a, const Solid& b);  ///< union
    friend Solid operator-(const Solid& a, const Solid& b);  ///< difference
    friend Solid operator&(const Solid& a, const Solid& b);  ///< intersection
    friend Solid operator|(const Solid& a, const Solid& b);  ///< fragment: both, with their common faces

    /// Any shape, made when it is known where it stands; `kind` is its name where it is given none.
    using Maker = std::function<std::shared_ptr<const Shape>(const Eigen::Affine3d& frame)>;
    static Solid primitive(std::string kind, Maker make);  ///< a solid of that shape

  private:
    struct Node;
    explicit Solid(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
    Solid changed(Node node) const;
    static Solid combined(Operation operation, const Solid& a, const Solid& b);
    friend class SolidModeler;
    friend Solid halfspace(const Point& point, const Point& normal);

    std::shared_ptr<const Node> node_;
};

///@{
/// The solids of shapes.hh. All throw InputError on parameters that make no solid.
Solid box(const Point& size, bool center = false);
Solid sphere(double radius);
Solid ellipsoid(const Point& semi_axes);
Solid cylinder(double height, double radius, bool center = false);
Solid cone(double height, double bottom_radius, double top_radius, bool center = false);
Solid torus(double major, double minor);
Solid wedge(const Point& size, double dx);
Solid prism(int n, double radius, double height);
Solid pyramid(int n, double radius, double height);
Solid tetrahedron(const std::array<Point, 4>& points);
Solid polyhedron(std::vector<Point> points, std::vector<std::vector<std::uint32_t>> faces);
///@}
/// All that is behind the plane; only in an intersection, or subtracted.
Solid halfspace(const Point& point, const Point& normal);
///@{
/// A flat region (its outline counter-clockwise, holes clockwise) moved up, or turned about z by `angle`
/// degrees.
Solid extruded(const PlaneRegion& region, double height);
Solid turned(const PlaneRegion& region, double angle = 360);
///@}

}  // namespace maille::modeler
