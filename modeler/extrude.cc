#include "modeler/extrude.hh"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "modeler/extrude_ridge.hh"
#include "modeler/openscad_facets.hh"
#include "modeler/shape_turned.hh"
#include "modeler/shapes.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

using Corner = std::uint32_t;

/// A side between two layers: the edge from a to b below, from c to d above it, both along the loop.
struct Quad {
    Corner a, b, c, d;
};

/// A stack of images of a region: what both extrusions make, the one upwards, the other round z.
class Stack {
  public:
    Stack(const PlaneRegion& region, std::size_t first_side) : region_(region), first_side_(first_side) {
        for (const PlaneLoop& loop : region) n_corners_ += loop.size();
    }

    std::size_t n_layers() const { return points_.size() / n_corners_; }

    void add_layer(const std::function<Point(const Point2&)>& image) {
        for (const PlaneLoop& loop : region_)
            for (const Point2& p : loop) points_.push_back(image(p));
    }

    /// Calls add(name, quad, whether the loop is a hole) for each edge of the region.
    template <class Add>
    void for_each_side(std::size_t below, std::size_t above, const Add& add) const {
        std::size_t first = 0;
        std::size_t side = first_side_;
        for (const PlaneLoop& loop : region_) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const std::size_t j = (i + 1) % loop.size();
                add(fmt::format("side{}", side++),
                    Quad{corner(below, first + i), corner(below, first + j), corner(above, first + i),
                         corner(above, first + j)},
                    first > 0);
            }
            first += loop.size();
        }
    }

    const Point& point(Corner corner) const { return points_[corner]; }

    void add_face(std::vector<Corner> corners, std::string name) {
        faces_.push_back({{std::move(corners)}, std::move(name)});
    }

    /// The region itself as a face, seen from its front or from its back.
    void add_cap(std::size_t layer, bool is_front, const char* name) {
        PolyhedronFace face{{}, name};
        std::size_t first = 0;
        for (const PlaneLoop& loop : region_) {
            std::vector<Corner> corners;
            for (std::size_t i = 0; i < loop.size(); ++i) corners.push_back(corner(layer, first + i));
            if (!is_front) std::ranges::reverse(corners);
            face.loops.push_back(std::move(corners));
            first += loop.size();
        }
        faces_.push_back(std::move(face));
    }

    /// For the last layer, which is a line.
    Ridge ridge(Eigen::Index axis) { return {points_, corner(n_layers() - 1, 0), axis}; }

    void add_faces(std::vector<PolyhedronFace> faces) {
        std::ranges::move(faces, std::back_inserter(faces_));
    }

    std::shared_ptr<const Shape> solid(const Eigen::Affine3d& frame) {
        return make_polyhedron(std::move(points_), std::move(faces_), frame);
    }

  private:
    Corner corner(std::size_t layer, std::size_t i) const {
        return static_cast<Corner>(layer * n_corners_ + i);
    }

    const PlaneRegion& region_;
    std::size_t first_side_;
    std::size_t n_corners_ = 0;
    std::vector<Point> points_;
    std::vector<PolyhedronFace> faces_;
};

/// Whether OpenSCAD 2021 splits a side along the diagonal from a to d: where that is the shorter one seen
/// from above, or `if_equal`.
bool splits_from_a(const Stack& stack, const Quad& quad, bool if_equal) {
    constexpr double equal = 1e-5;  // difference by mean
    const auto length = [&](Corner p, Corner q) {
        return (stack.point(q) - stack.point(p)).head<2>().norm();
    };
    const double from_a = length(quad.a, quad.d), from_b = length(quad.b, quad.c);
    if (2 * std::abs(from_a - from_b) <= equal * (from_a + from_b)) return if_equal;
    return from_a < from_b;
}

}  // namespace

std::shared_ptr<const Shape> linear_extrude(const PlaneRegion& region, const LinearExtrusion& extrusion,
                                            std::size_t first_side, const Eigen::Affine3d& frame) {
    Stack stack(region, first_side);
    const double bottom = extrusion.center ? -extrusion.height / 2 : 0;
    for (int k = 0; k <= extrusion.slices; ++k) {
        const double part = static_cast<double>(k) / extrusion.slices;
        const double angle = -extrusion.twist * part;
        const double c = cos_degrees(angle), s = sin_degrees(angle);
        const Point2 scale = Point2::Ones() + part * (extrusion.scale - Point2::Ones());
        const double z = bottom + extrusion.height * part;
        stack.add_layer([&](const Point2& p) {
            return Point(scale.x() * (c * p.x() - s * p.y()), scale.y() * (s * p.x() + c * p.y()), z);
        });
    }
    const auto ends_flat = [&](std::size_t k) {
        return k + 2 == stack.n_layers() && extrusion.scale.minCoeff() == 0;
    };
    std::optional<Ridge> ridge;
    if (extrusion.scale.minCoeff() == 0 && extrusion.scale.maxCoeff() > 0)
        ridge = stack.ridge(extrusion.scale.x() > 0 ? 0 : 1);
    // The triangle of a side that has an edge above.
    const auto add_upper = [&](std::size_t k, Corner foot, Corner d, Corner c, const std::string& name) {
        if (ridge && ends_flat(k))
            ridge->add(foot, d, c, name);
        else
            stack.add_face({foot, d, c}, name);
    };
    const bool is_flat = extrusion.twist == 0 && extrusion.scale.x() == extrusion.scale.y();
    for (std::size_t k = 0; k + 1 < stack.n_layers(); ++k)
        stack.for_each_side(k, k + 1, [&](const std::string& name, const Quad& quad, bool is_hole) {
            const auto [a, b, c, d] = quad;
            if (is_flat) {
                stack.add_face({a, b, d, c}, name);
            } else if (splits_from_a(stack, quad, (extrusion.twist <= 0) == is_hole) != ends_flat(k)) {
                stack.add_face({a, b, d}, name);
                add_upper(k, a, d, c, name);
            } else {
                stack.add_face({a, b, c}, name);
                add_upper(k, b, d, c, name);
            }
        });
    if (ridge) stack.add_faces(ridge->faces());
    stack.add_cap(0, false, "bottom");
    if (extrusion.scale.minCoeff() > 0) stack.add_cap(stack.n_layers() - 1, true, "top");
    try {
        return stack.solid(frame);
    } catch (const InputError& error) {
        if (extrusion.scale.minCoeff() > 0 || extrusion.scale.maxCoeff() == 0) throw;
        throw InputError(fmt::format("the shape shrinks to a line, along which the solid touches itself ({})",
                                     error.what()));
    }
}

std::shared_ptr<const Shape> rotate_extrude(const PlaneRegion& region, const RotateExtrusion& extrusion,
                                            std::size_t first_side, const Eigen::Affine3d& frame) {
    double least = 0, greatest = 0;
    for (const PlaneLoop& loop : region)
        for (const Point2& p : loop) {
            least = std::min(least, p.x());
            greatest = std::max(greatest, p.x());
        }
    const double on_axis = 1e-12 * std::max(-least, greatest);
    if (least < -on_axis && greatest > on_axis)
        throw InputError("the shape reaches across the axis x = 0, round which it is turned");

    const bool is_full = extrusion.angle == 360;
    const int n_layers = is_full ? extrusion.fragments : extrusion.fragments + 1;
    Stack stack(region, first_side);
    for (int k = 0; k < n_layers; ++k) {
        const double angle =
            (is_full ? 180 - 360.0 * k / extrusion.fragments : extrusion.angle * k / extrusion.fragments);
        const double c = cos_degrees(angle), s = sin_degrees(angle);
        stack.add_layer([&](const Point2& p) {
            const double radius = std::abs(p.x()) <= on_axis ? 0 : p.x();
            return Point(radius * c, radius * s, p.y());
        });
    }
    const std::size_t n = stack.n_layers();
    for (std::size_t k = 0; k + (is_full ? 0 : 1) < n; ++k)
        stack.for_each_side(k, (k + 1) % n, [&](const std::string& name, const Quad& quad, bool) {
            stack.add_face({quad.a, quad.b, quad.d, quad.c}, name);
        });
    if (!is_full) {
        stack.add_cap(0, false, "start");
        stack.add_cap(n - 1, true, "end");
    }
    return stack.solid(frame);
}

std::shared_ptr<const Shape> rotate_extrude_round(const PlaneRegion& region, double angle,
                                                  std::size_t first_side, const Eigen::Affine3d& frame) {
    Profile profile;
    std::size_t side = first_side;
    for (const PlaneLoop& loop : region) {
        auto& edges = profile.emplace_back();
        for (std::size_t i = 0; i < loop.size(); ++i)
            edges.push_back(
                {.from = loop[i], .to = loop[(i + 1) % loop.size()], .name = fmt::format("side{}", side++)});
    }
    return make_turned(std::move(profile), angle, frame);
}

}  // namespace maille::modeler
