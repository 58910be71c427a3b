#include "modeler/geo_primitives.hh"

#include <algorithm>

#include <fmt/format.h>

#include "modeler/name_table.hh"
#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

constexpr int most_points = 1'000'000;

double then_number(GeoScanner& scanner) {
    scanner.expect(';');
    return scanner.number();
}

Point then_vector(GeoScanner& scanner) {
    scanner.expect(';');
    return scanner.vector();
}

template <class Curve>
const Curve& curve(GeoScanner& scanner, const std::map<std::string, Curve, std::less<>>& curves,
                   std::string_view what) {
    const Location at = scanner.current().at;
    const std::string name = scanner.word(what);
    const auto found = curves.find(name);
    if (found == curves.end()) throw scanner.error(at, fmt::format("there is no {} '{}'", what, name));
    return found->second;
}

/// Makes the body once its parentheses are closed.
using Maker = std::function<GeoBody()>;

Maker plane(GeoScanner& scanner, const GeoCurves&) {
    const Point point = scanner.vector(), normal = then_vector(scanner);
    return [=] { return geo_plane(point, normal); };
}

Maker sphere(GeoScanner& scanner, const GeoCurves&) {
    const Point centre = scanner.vector();
    const double radius = then_number(scanner);
    return [=] { return geo_sphere(centre, radius); };
}

Maker cylinder(GeoScanner& scanner, const GeoCurves&) {
    const Point a = scanner.vector(), b = then_vector(scanner);
    const double radius = then_number(scanner);
    return [=] { return geo_cylinder(a, b, radius); };
}

Maker cone(GeoScanner& scanner, const GeoCurves&) {
    const Point a = scanner.vector();
    const double radius_a = then_number(scanner);
    const Point b = then_vector(scanner);
    const double radius_b = then_number(scanner);
    return [=] { return geo_cone(a, radius_a, b, radius_b); };
}

Maker elliptic_cylinder(GeoScanner& scanner, const GeoCurves&) {
    const Point centre = scanner.vector(), longer = then_vector(scanner), shorter = then_vector(scanner);
    return [=] { return geo_elliptic_cylinder(centre, longer, shorter); };
}

Maker elliptic_cone(GeoScanner& scanner, const GeoCurves&) {
    const Point base = scanner.vector(), longer = then_vector(scanner), shorter = then_vector(scanner);
    const double h = then_number(scanner), ratio = then_number(scanner);
    return [=] { return geo_elliptic_cone(base, longer, shorter, h, ratio); };
}

Maker ellipsoid(GeoScanner& scanner, const GeoCurves&) {
    const Point centre = scanner.vector();
    std::array<Point, 3> axes;
    for (Point& axis : axes) axis = then_vector(scanner);
    return [=] { return geo_ellipsoid(centre, axes); };
}

Maker orthobrick(GeoScanner& scanner, const GeoCurves&) {
    const Point low = scanner.vector(), high = then_vector(scanner);
    return [=] { return geo_brick(low, high); };
}

Maker torus(GeoScanner& scanner, const GeoCurves&) {
    const Point centre = scanner.vector(), normal = then_vector(scanner);
    const double major = then_number(scanner), minor = then_number(scanner);
    return [=] { return geo_torus(centre, normal, major, minor); };
}

/// Points, each with a semicolon; another one; faces of three or four points that count from 1.
Maker polyhedron(GeoScanner& scanner, const GeoCurves&) {
    std::vector<Point> points;
    do {
        points.push_back(scanner.vector());
        scanner.expect(';');
    } while (!scanner.accept(';'));
    std::vector<std::vector<std::uint32_t>> faces;
    do {
        std::vector<std::uint32_t>& face = faces.emplace_back();
        const Location at = scanner.current().at;
        int n = 0;
        do {
            const int corner = scanner.count(1, static_cast<int>(points.size())) - 1;
            if (std::ranges::find(face, corner) == face.end())
                face.push_back(static_cast<std::uint32_t>(corner));
        } while (++n < 4 && scanner.accept(','));
        if (face.size() < 3) throw scanner.error(at, "a face needs three different points");
    } while (scanner.accept(';'));
    return [=] { return geo_polyhedron(points, faces); };
}

Maker revolution(GeoScanner& scanner, const GeoCurves& curves) {
    const Point a = scanner.vector(), b = then_vector(scanner);
    scanner.expect(';');
    const GeoCurve<2>& profile = curve(scanner, curves.flat, "curve2d");
    return [=] { return geo_revolution(a, b, profile); };
}

Maker extrusion(GeoScanner& scanner, const GeoCurves& curves) {
    const GeoCurve<3>& path = curve(scanner, curves.spatial, "curve3d");
    scanner.expect(';');
    const GeoCurve<2>& profile = curve(scanner, curves.flat, "curve2d");
    const Point z = then_vector(scanner);
    return [=] { return geo_extrusion(path, profile, z); };
}

using Reader = Maker (*)(GeoScanner&, const GeoCurves&);
constexpr NameRow<Reader> readers[] = {
    {"plane", plane},
    {"sphere", sphere},
    {"cylinder", cylinder},
    {"cone", cone},
    {"ellipticcylinder", elliptic_cylinder},
    {"ellipticcone", elliptic_cone},
    {"ellipsoid", ellipsoid},
    {"orthobrick", orthobrick},
    {"polyhedron", polyhedron},
    {"torus", torus},
    {"revolution", revolution},
    {"extrusion", extrusion},
};

/// The arc from one point to another about a centre, the shorter way.
template <int N>
GeoSegment<N> arc_about(const Eigen::Vector<double, N>& from, const Eigen::Vector<double, N>& centre,
                        const Eigen::Vector<double, N>& to) {
    const double radius = (from - centre).norm();
    if (!(radius > 0) || std::abs((to - centre).norm() - radius) > 1e-9 * radius)
        throw InputError("the ends of an arc have to be equally far from its middle point");
    const Eigen::Vector<double, N> u = (from - centre) / radius, v = (to - centre).normalized();
    if (1 + u.dot(v) < 1e-9) throw InputError("an arc has to be shorter than half a circle: split it");
    return {from, centre + radius * (u + v) / (1 + u.dot(v)), to, false};
}

}  // namespace

template <int N>
GeoCurve<N> read_geo_curve(GeoScanner& scanner) {
    using P = Eigen::Vector<double, N>;
    scanner.expect('(');
    std::vector<P> points(static_cast<std::size_t>(scanner.count(2, most_points)));
    scanner.expect(';');
    for (P& p : points) {
        for (int i = 0; i < N; ++i) {
            if (i > 0) scanner.expect(',');
            p[i] = scanner.number();
        }
        scanner.expect(';');
    }
    GeoCurve<N> curve;
    const int n_segments = scanner.count(1, most_points);
    const auto next_point = [&] {
        scanner.expect(',');
        return points[static_cast<std::size_t>(scanner.count(1, static_cast<int>(points.size()))) - 1];
    };
    for (int i = 0; i < n_segments; ++i) {
        scanner.expect(';');
        const Location at = scanner.current().at;
        const int kind = scanner.count(2, N == 2 ? 4 : 3);
        const P a = next_point(), b = next_point();
        if (kind == 2)
            curve.push_back({a, a, b, true});
        else if (kind == 3)
            curve.push_back({a, b, next_point(), false});
        else
            try {
                curve.push_back(arc_about<N>(a, b, next_point()));
            } catch (const InputError& error) {
                throw scanner.error(at, error.what());
            }
        const GeoSegment<N>& segment = curve.back();
        if (segment.a == segment.c) throw scanner.error(at, "this segment ends where it starts");
        if (!segment.is_straight && (segment.a == segment.b || segment.b == segment.c))
            throw scanner.error(at, "the three points of this segment have to differ");
        if (i > 0 && segment.a != curve[curve.size() - 2].c)
            throw scanner.error(at, "this segment does not start where the one before ends");
    }
    scanner.expect(')');
    return curve;
}

template GeoCurve<2> read_geo_curve<2>(GeoScanner&);
template GeoCurve<3> read_geo_curve<3>(GeoScanner&);

std::optional<GeoBody> read_geo_primitive(std::string_view kind, GeoScanner& scanner,
                                          const GeoCurves& curves) {
    const Reader read = look_up(readers, kind);
    if (read == nullptr) return std::nullopt;
    const Location at = scanner.current().at;
    scanner.expect('(');
    const Maker make = read(scanner, curves);
    scanner.expect(')');
    try {
        return make();
    } catch (const InputError& error) {
        throw scanner.error(at, fmt::format("{}: {}", kind, error.what()));
    }
}

std::vector<std::string_view> geo_primitive_names() {
    return names_of(readers);
}

}  // namespace maille::modeler
