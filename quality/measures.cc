#include "quality/measures.hh"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Geometry>

#include "quality/accurate_volume.hh"

namespace maille::quality {
namespace {

/// A power of two near the largest coordinate, within the range whose inverse is finite.
double power_of_two_near(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return std::ldexp(1.0, std::max(exponent, -1000));
}

/// Below this sine, as it were, of the solid angle at a vertex the volume has lost three digits or more.
constexpr double near_flat = 1e-3;

double cube(double x) {
    return x * x * x;
}

/// Quotients of measures: 0 where everything has collapsed.
double ratio(double part, double whole) {
    return whole > 0 ? part / whole : 0;
}

double degrees(double radians) {
    return radians * (180 / std::numbers::pi);
}

/// The angle at an edge: the cross product of two face normals is 6 V times the edge.
double dihedral(const TetGeometry& t, int edge) {
    return degrees(std::atan2(6 * t.volume * t.lengths[edge], -t.normal_products[edge]));
}

/// The edge with the least or the greatest angle, found by cotangents. Precondition: a positive volume.
template <class Better>
int edge_of_extreme_angle(const TetGeometry& t, const Better& is_better) {
    const auto cotangent = [&](int edge) { return -t.normal_products[edge] / t.lengths[edge]; };
    int best = 0;
    for (int edge = 1; edge < 6; ++edge)
        if (is_better(cotangent(edge), cotangent(best))) best = edge;
    return best;
}

/// The edges at each vertex, each before the edge opposite it in the face that it spans with the next: at a
/// vertex with edges x, y and z, the pairs (x, y), (y, z), (z, x) span the faces with the third sides listed.
struct Corner {
    std::array<int, 3> edges;
    std::array<int, 3> third_sides;
};
constexpr std::array<Corner, 4> corners{{{{0, 1, 2}, {3, 5, 4}},    // ab ac ad; bc cd bd
                                         {{0, 3, 4}, {1, 5, 2}},    // ab bc bd; ac cd ad
                                         {{1, 3, 5}, {0, 4, 2}},    // ac bc cd; ab bd ad
                                         {{2, 4, 5}, {0, 3, 1}}}};  // ad bd cd; ab bc ac

double product_of_edges(const TetGeometry& t, const Corner& corner) {
    const auto& [x, y, z] = corner.edges;
    return t.lengths[x] * t.lengths[y] * t.lengths[z];
}

/// What 6 V is over tan(angle / 2): x y z + (x.y) z + (y.z) x + (z.x) y, x, y and z being the edges from the
/// corner.
double solid_angle_divisor(const TetGeometry& t, const Corner& corner) {
    double divisor = product_of_edges(t, corner);
    for (int i = 0; i < 3; ++i) {
        const double x = t.lengths[corner.edges[i]];
        const double y = t.lengths[corner.edges[(i + 1) % 3]];
        const double third = t.lengths[corner.third_sides[i]];
        divisor += (x * x + y * y - third * third) / 2 * t.lengths[corner.edges[(i + 2) % 3]];
    }
    return divisor;
}

std::array<double, 4> solid_angle_divisors(const TetGeometry& t) {
    std::array<double, 4> divisors;
    for (int i = 0; i < 4; ++i) divisors[i] = solid_angle_divisor(t, corners[i]);
    return divisors;
}

double solid_angle(const TetGeometry& t, double divisor) {
    return 2 * std::atan2(6 * t.volume, divisor);
}

}  // namespace

TetGeometry tet_geometry(const Point& a, const Point& b, const Point& c, const Point& d) {
    TetGeometry t;
    std::array<Point, 6> edges{b - a, c - a, d - a, c - b, d - b, d - c};
    double size = 0;
    for (const Point& edge : edges)
        for (double x : edge) size = std::max(size, std::abs(x));
    if (!(size > 0) || !std::isfinite(size)) return t;

    t.unit = power_of_two_near(size);
    for (Point& edge : edges) edge *= 1 / t.unit;
    const auto& [ab, ac, ad, bc, bd, cd] = edges;

    double sum_of_squares = 0;
    for (int i = 0; i < 6; ++i) {
        const double square = edges[i].squaredNorm();
        sum_of_squares += square;
        t.lengths[i] = std::sqrt(square);
        t.mean_edge += t.lengths[i] / 6;
    }
    t.rms_edge = std::sqrt(sum_of_squares / 6);
    const auto [shortest, longest] = std::minmax_element(t.lengths.begin(), t.lengths.end());
    t.shortest_edge = *shortest;
    t.longest_edge = *longest;

    const std::array<Point, 4> normals{bc.cross(bd), ad.cross(ac), ab.cross(ad), ac.cross(ab)};
    double area = 0;
    for (int i = 0; i < 4; ++i) {
        t.areas[i] = normals[i].norm() / 2;
        area += t.areas[i];
    }
    // The two faces at an edge are those opposite the vertices that it doesn't have.
    t.normal_products = {normals[2].dot(normals[3]), normals[1].dot(normals[3]), normals[1].dot(normals[2]),
                         normals[0].dot(normals[3]), normals[0].dot(normals[2]), normals[0].dot(normals[1])};

    const Point towards_center =
        ab.squaredNorm() * normals[1] + ac.squaredNorm() * normals[2] + ad.squaredNorm() * normals[3];
    AccurateVolume accurate{-ad.dot(normals[3]), towards_center.norm()};
    if (std::abs(accurate.six_volumes) < near_flat * t.lengths[0] * t.lengths[1] * t.lengths[2])
        accurate = accurate_volume(a, b, c, d, t.unit);
    t.volume = accurate.six_volumes / 6;
    t.inradius = ratio(3 * t.volume, area);
    // No sphere through both ends of an edge is smaller than it: rounding may not say so for a near-flat
    // cell.
    if (t.volume != 0)
        t.circumradius =
            std::max(accurate.twelve_volumes_times_radius / std::abs(12 * t.volume), t.longest_edge / 2);
    return t;
}

double volume(const TetGeometry& t) {
    return t.volume * cube(t.unit);
}
double inradius(const TetGeometry& t) {
    return t.inradius * t.unit;
}
double circumradius(const TetGeometry& t) {
    return std::isinf(t.circumradius) ? t.circumradius : t.circumradius * t.unit;
}
double shortest_edge(const TetGeometry& t) {
    return t.shortest_edge * t.unit;
}
double longest_edge(const TetGeometry& t) {
    return t.longest_edge * t.unit;
}
double mean_edge(const TetGeometry& t) {
    return t.mean_edge * t.unit;
}
double rms_edge(const TetGeometry& t) {
    return t.rms_edge * t.unit;
}

double radius_ratio(const TetGeometry& t) {
    return t.inradius / t.circumradius;
}
double beta(const TetGeometry& t) {
    return 3 * radius_ratio(t);
}
double sigma(const TetGeometry& t) {
    return 2 * std::numbers::sqrt2 * std::numbers::sqrt3 * ratio(t.inradius, t.longest_edge);
}
double omega(const TetGeometry& t) {
    return std::numbers::sqrt2 * std::numbers::sqrt3 / 4 * t.longest_edge / t.circumradius;
}
double tau(const TetGeometry& t) {
    return ratio(t.shortest_edge, t.longest_edge);
}

double kappa(const TetGeometry& t) {
    double squares = 0;
    for (double area : t.areas) squares += area * area;
    return 2187 * ratio(cube(t.volume) * std::abs(t.volume), cube(squares));
}

double alpha(const TetGeometry& t) {
    return 6 * std::numbers::sqrt2 * ratio(t.volume, cube(t.mean_edge));
}
double gamma(const TetGeometry& t) {
    return 6 * std::numbers::sqrt2 * ratio(t.volume, cube(t.rms_edge));
}

double dihedral_min(const TetGeometry& t) {
    if (!(t.volume > 0)) return 0;
    return dihedral(t, edge_of_extreme_angle(t, std::greater{}));
}

double dihedral_max(const TetGeometry& t) {
    if (!(t.volume > 0)) return 180;
    return dihedral(t, edge_of_extreme_angle(t, std::less{}));
}

double solid_angle_min(const TetGeometry& t) {
    if (!(t.volume > 0)) return 0;
    return solid_angle(t, std::ranges::max(solid_angle_divisors(t)));
}

double solid_angle_max(const TetGeometry& t) {
    if (!(t.volume > 0)) return 2 * std::numbers::pi;
    return solid_angle(t, std::ranges::min(solid_angle_divisors(t)));
}

double aspect(const TetGeometry& t) {
    const double least_height = ratio(3 * t.volume, *std::ranges::max_element(t.areas));
    return std::numbers::sqrt3 / std::numbers::sqrt2 * ratio(least_height, t.longest_edge);
}

double condition(const TetGeometry& t) {
    double squares = 0;
    for (double area : t.areas) squares += area * area;
    return 18 * ratio(t.volume, std::sqrt(squares) * std::sqrt(6.0) * t.rms_edge);
}

double mean_ratio(const TetGeometry& t) {
    const double root = std::cbrt(3 * t.volume);
    return 2 * ratio(root * std::abs(root), t.rms_edge * t.rms_edge);
}

double scaled_jacobian(const TetGeometry& t) {
    double product = 0;
    for (const Corner& corner : corners) product = std::max(product, product_of_edges(t, corner));
    return 6 * std::numbers::sqrt2 * ratio(t.volume, product);
}

double phi(const TetGeometry& t, double size) {
    return longest_edge(t) / size;
}

}  // namespace maille::quality
