#include "modeler/build_copies.hh"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "modeler/shape_cone.hh"
#include "modeler/shape_ellipsoid.hh"
#include "modeler/shape_polyhedron.hh"
#include "modeler/shape_torus.hh"
#include "modeler/shape_turned.hh"

namespace maille::modeler {
namespace {

using Way = std::optional<Eigen::Vector3d>;

/// What of the standard solid comes to lie where the other map puts it: the rotation or mirror between the
/// maps leaves the solid as it is.
template <class Keeps>
Way between_maps(const Eigen::Affine3d& from, const Eigen::Affine3d& to, const Keeps& keeps) {
    if (from.linear() != to.linear() && !keeps(Eigen::Matrix3d(from.linear().inverse() * to.linear())))
        return std::nullopt;
    return to.translation() - from.translation();
}

bool is_orthogonal(const Eigen::Matrix3d& m) {
    return (m.transpose() * m - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-12;
}

/// Whether it maps the z axis on itself, and turns or mirrors about it.
bool is_about_axis(const Eigen::Matrix3d& m) {
    return is_orthogonal(m) && std::abs(m(2, 2) - 1) < 1e-12;
}

Way between(const Ellipsoid& from, const Ellipsoid& to) {
    return between_maps(from.map(), to.map(), is_orthogonal);
}

Way between(const Torus& from, const Torus& to) {
    if (from.major() != to.major() || from.minor() != to.minor()) return std::nullopt;
    return between_maps(from.map(), to.map(), [](Eigen::Matrix3d m) {
        m.col(2) *= m(2, 2) < 0 ? -1 : 1;
        return is_about_axis(m);
    });
}

Way between(const Cone& from, const Cone& to) {
    if (from.radius(0) != to.radius(0) || from.radius(1) != to.radius(1)) return std::nullopt;
    return between_maps(from.map(), to.map(), is_about_axis);
}

Way between(const Turned& from, const Turned& to) {
    if (from.span() != to.span() || from.profile() != to.profile()) return std::nullopt;
    return between_maps(from.map(), to.map(), [](const Eigen::Matrix3d&) { return false; });
}

Way between(const Polyhedron& from, const Polyhedron& to) {
    if (from.points().size() != to.points().size() || from.faces().size() != to.faces().size())
        return std::nullopt;
    for (std::uint32_t f = 0; f < from.faces().size(); ++f)
        if (from.polygon(f).loops != to.polygon(f).loops) return std::nullopt;
    const Eigen::Vector3d way = to.points()[0] - from.points()[0];
    double scale = 0;
    for (const auto& points : {from.points(), to.points()})
        for (const Point& p : points) scale = std::max(scale, p.cwiseAbs().maxCoeff());
    const double tolerance = 8 * std::numeric_limits<double>::epsilon() * scale;
    for (std::size_t i = 0; i < from.points().size(); ++i)
        if ((to.points()[i] - from.points()[i] - way).cwiseAbs().maxCoeff() > tolerance) return std::nullopt;
    return way;
}

template <class Kind>
bool try_kind(const Shape& from, const Shape& to, Way& way) {
    const auto *a = dynamic_cast<const Kind*>(&from), *b = dynamic_cast<const Kind*>(&to);
    if (a == nullptr || b == nullptr) return false;
    way = between(*a, *b);
    return true;
}

/// The corners of a polyhedron by those of the one that it was moved from.
std::map<std::tuple<double, double, double>, Point> corners_of(const Shape& from, const Shape& to) {
    std::map<std::tuple<double, double, double>, Point> corners;
    const auto* a = dynamic_cast<const Polyhedron*>(&from);
    const auto* b = dynamic_cast<const Polyhedron*>(&to);
    for (std::size_t i = 0; a != nullptr && b != nullptr && i < a->points().size(); ++i) {
        const Point& p = a->points()[i];
        corners[{p.x(), p.y(), p.z()}] = b->points()[i];
    }
    return corners;
}

}  // namespace

std::optional<Eigen::Vector3d> translation_between(const Shape& from, const Shape& to) {
    if (&from == &to) return Eigen::Vector3d::Zero().eval();
    Way way;
    (void)(try_kind<Polyhedron>(from, to, way) || try_kind<Cone>(from, to, way) ||
           try_kind<Ellipsoid>(from, to, way) || try_kind<Turned>(from, to, way) ||
           try_kind<Torus>(from, to, way));
    return way;
}

std::vector<std::size_t> first_alike(const std::vector<Primitive>& primitives,
                                     const std::vector<double>& sizes,
                                     std::span<const std::shared_ptr<const SharedSurface>> shared) {
    std::vector<std::size_t> result, firsts;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const auto alike = std::ranges::find_if(firsts, [&](std::size_t j) {
            if (sizes[i] != sizes[j] || shared[i] != shared[j]) return false;
            const Way way = translation_between(*primitives[j].shape, *primitives[i].shape);
            return way && (!shared[i] || way->isZero(0));
        });
        result.push_back(alike != firsts.end() ? *alike : i);
        if (result.back() == i) firsts.push_back(i);
    }
    return result;
}

Operand moved_operand(const Operand& original, const Primitive& from, const Primitive& to,
                      std::uint32_t first_surface_from, std::uint32_t first_surface_to) {
    Operand copy = original;
    copy.name = to.name;
    const Eigen::Vector3d way = translation_between(*from.shape, *to.shape).value();
    const auto corners = corners_of(*from.shape, *to.shape);
    std::vector<Point>& points = copy.surface.points;
    for (Point& p : points) p += way;
    for (std::size_t t = 0; t < copy.surface.triangles.size(); ++t) {
        const std::uint32_t face = copy.surface.surfaces[t] - first_surface_from;
        copy.surface.surfaces[t] = first_surface_to + face;
        for (const std::uint32_t v : copy.surface.triangles[t])
            points[v] = to.shape->project(face, points[v]);
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
        const Point& p = original.surface.points[v];
        if (const auto corner = corners.find({p.x(), p.y(), p.z()}); corner != corners.end())
            points[v] = corner->second;
    }
    for (const auto v : copy.mesh.vertices())
        copy.mesh.set_point(v, static_cast<std::size_t>(v.idx()) < points.size()
                                   ? points[static_cast<std::size_t>(v.idx())]
                                   : Point(copy.mesh.point(v) + way));
    return copy;
}

}  // namespace maille::modeler
