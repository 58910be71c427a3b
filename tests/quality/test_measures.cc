#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "quality/measures.hh"

using namespace maille::quality;

namespace {

using Tet = std::array<Point, 4>;

TetGeometry geometry(const Tet& p) {
    return tet_geometry(p[0], p[1], p[2], p[3]);
}

/// All dimensionless measures.
std::array<double, 16> shape(const Tet& p) {
    const TetGeometry t = geometry(p);
    return {beta(t),         sigma(t),        omega(t),           tau(t),
            kappa(t),        alpha(t),        gamma(t),           radius_ratio(t),
            dihedral_min(t), dihedral_max(t), solid_angle_min(t), solid_angle_max(t),
            aspect(t),       condition(t),    mean_ratio(t),      scaled_jacobian(t)};
}

const Tet regular{Point(1, 1, 1), Point(-1, 1, -1), Point(1, -1, -1), Point(-1, -1, 1)};
/// Three right angles at the origin.
const Tet corner{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
/// A path of three unit steps: a sixth of a cube.
const Tet kuhn{Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(1, 1, 1)};

Tet random_tet(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-1, 1);
    Tet p;
    do
        for (Point& q : p) q = Point(coordinate(random), coordinate(random), coordinate(random));
    while ((p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) < 1e-3);
    return p;
}

/// The angle at the edge ab between the faces that go to c and to d, by the directions across the edge.
double angle_at(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point along = (b - a).normalized();
    const auto across = [&](const Point& q) {
        return Point(q - a - (q - a).dot(along) * along).normalized();
    };
    return std::acos(std::clamp(across(c).dot(across(d)), -1.0, 1.0)) * 180 / std::acos(-1.0);
}

constexpr double tight = 1e-12;

}  // namespace

TEST_CASE("every shape measure of a regular tetrahedron is 1") {
    const TetGeometry t = geometry(regular);
    const double edge = std::sqrt(8.0);
    for (auto* measure :
         {beta, sigma, omega, tau, kappa, alpha, gamma, aspect, condition, mean_ratio, scaled_jacobian})
        CHECK(measure(t) == doctest::Approx(1).epsilon(tight));
    CHECK(volume(t) == doctest::Approx(8.0 / 3).epsilon(tight));
    CHECK(inradius(t) == doctest::Approx(edge * std::sqrt(6.0) / 12).epsilon(tight));
    CHECK(circumradius(t) == doctest::Approx(edge * std::sqrt(6.0) / 4).epsilon(tight));
    for (auto* length : {shortest_edge, longest_edge, mean_edge, rms_edge})
        CHECK(length(t) == doctest::Approx(edge).epsilon(tight));
    CHECK(dihedral_min(t) == doctest::Approx(std::acos(1.0 / 3) * 180 / std::acos(-1.0)).epsilon(tight));
    CHECK(dihedral_max(t) == doctest::Approx(dihedral_min(t)).epsilon(tight));
    CHECK(phi(t, edge / 2) == doctest::Approx(2).epsilon(tight));
}

TEST_CASE("the corner and the path tetrahedron of a cube have their analytic values") {
    const TetGeometry c = geometry(corner);
    const double r = 1 / (3 + std::sqrt(3.0));
    CHECK(volume(c) == doctest::Approx(1.0 / 6).epsilon(tight));
    CHECK(inradius(c) == doctest::Approx(r).epsilon(tight));
    CHECK(circumradius(c) == doctest::Approx(std::sqrt(3.0) / 2).epsilon(tight));
    CHECK(sigma(c) == doctest::Approx(2 * std::sqrt(6.0) * r / std::sqrt(2.0)).epsilon(tight));
    CHECK(omega(c) ==
          doctest::Approx(std::sqrt(6.0) / 4 * std::sqrt(2.0) / (std::sqrt(3.0) / 2)).epsilon(tight));
    CHECK(tau(c) == doctest::Approx(std::sqrt(0.5)).epsilon(tight));
    CHECK(kappa(c) == doctest::Approx(2187 / std::pow(6.0, 4) / std::pow(1.5, 3)).epsilon(tight));
    CHECK(alpha(c) == doctest::Approx(std::sqrt(2.0) / std::pow((1 + std::sqrt(2.0)) / 2, 3)).epsilon(tight));
    CHECK(gamma(c) == doctest::Approx(std::sqrt(2.0) / std::pow(1.5, 1.5)).epsilon(tight));
    CHECK(dihedral_min(c) ==
          doctest::Approx(std::acos(1 / std::sqrt(3.0)) * 180 / std::acos(-1.0)).epsilon(tight));
    CHECK(dihedral_max(c) == doctest::Approx(90).epsilon(tight));

    // The least r/Lmax and Lmin/Lmax of the paper's table 1 are this shape's.
    const TetGeometry k = geometry(kuhn);
    CHECK(tau(k) == doctest::Approx(0.577350).epsilon(1e-6));
    CHECK(sigma(k) ==
          doctest::Approx(2 * std::sqrt(6.0) / (2 + 2 * std::sqrt(2.0)) / std::sqrt(3.0)).epsilon(tight));
    CHECK(dihedral_min(k) == doctest::Approx(45).epsilon(tight));
    CHECK(dihedral_max(k) == doctest::Approx(90).epsilon(tight));
}

TEST_CASE("measures depend on neither place, turn, scale nor numbering") {
    constexpr unsigned seed = 20240817;
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    // Even permutations keep the orientation.
    constexpr std::array<std::array<int, 4>, 4> even{
        {{1, 0, 3, 2}, {1, 2, 0, 3}, {3, 2, 1, 0}, {0, 2, 3, 1}}};
    for (int round = 0; round < 200; ++round) {
        const Tet p = random_tet(random);
        const auto expected = shape(p);
        const Eigen::Quaterniond turn =
            Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
        const double scale = std::pow(10.0, 4 * normal(random));
        const auto order = even[round % 4];
        Tet q;
        for (int i = 0; i < 4; ++i) q[i] = scale * (turn * p[order[i]] + Point(1, -2, 3));
        const auto found = shape(q);
        for (std::size_t m = 0; m < found.size(); ++m) {
            CAPTURE(m);
            CHECK(found[m] == doctest::Approx(expected[m]).epsilon(1e-9));
        }
        CHECK(volume(geometry(q)) == doctest::Approx(volume(geometry(p)) * std::pow(scale, 3)).epsilon(1e-9));
    }
}

TEST_CASE("scaling by a power of two changes no bit, however large or small") {
    const Tet p{Point(0.1, 0.2, 0.3), Point(1.7, 0.1, 0.4), Point(0.3, 1.1, 0.2), Point(0.4, 0.6, 1.3)};
    for (double scale : {std::ldexp(1.0, 900), std::ldexp(1.0, -900), std::ldexp(1.0, 40)}) {
        Tet q;
        for (int i = 0; i < 4; ++i) q[i] = scale * p[i];
        CHECK(shape(q) == shape(p));
    }
}

TEST_CASE("measures stay within their bounds and agree with independent formulas") {
    constexpr unsigned seed = 99;
    CAPTURE(seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 500; ++round) {
        const Tet p = random_tet(random);
        const TetGeometry t = geometry(p);
        for (auto* measure : {beta, sigma, tau, kappa, alpha, gamma}) {
            CHECK(measure(t) > 0);
            CHECK(measure(t) <= 1 + tight);
        }
        CHECK(omega(t) <= std::sqrt(1.5) + tight);

        Eigen::Matrix3d edges;
        edges << (p[1] - p[0]).transpose(), (p[2] - p[0]).transpose(), (p[3] - p[0]).transpose();
        CHECK(volume(t) == doctest::Approx(edges.determinant() / 6).epsilon(1e-9));
        const Point center = edges.fullPivLu().solve(Point(edges.rowwise().squaredNorm() / 2));
        CHECK(circumradius(t) == doctest::Approx(center.norm()).epsilon(1e-9));

        std::array<double, 6> angles{};
        std::array<double, 6> lengths{};
        int k = 0;
        for (int i = 0; i < 4; ++i)
            for (int j = i + 1; j < 4; ++j, ++k) {
                const int l = i == 0 ? (j == 1 ? 2 : 1) : 0;
                angles[k] = angle_at(p[i], p[j], p[l], p[6 - i - j - l]);
                lengths[k] = (p[i] - p[j]).norm();
            }
        CHECK(dihedral_min(t) ==
              doctest::Approx(*std::min_element(angles.begin(), angles.end())).epsilon(1e-7));
        CHECK(dihedral_max(t) ==
              doctest::Approx(*std::max_element(angles.begin(), angles.end())).epsilon(1e-7));
        CHECK(shortest_edge(t) == doctest::Approx(*std::min_element(lengths.begin(), lengths.end())));
        CHECK(longest_edge(t) == doctest::Approx(*std::max_element(lengths.begin(), lengths.end())));
    }
}

TEST_CASE("a mirror image has the same measures with the sign turned") {
    std::mt19937 random(7);
    for (int round = 0; round < 50; ++round) {
        Tet p = random_tet(random);
        const TetGeometry t = geometry(p);
        std::swap(p[2], p[3]);
        const TetGeometry mirrored = geometry(p);
        for (auto* measure : {beta, sigma, kappa, alpha, gamma, volume, inradius, aspect, condition,
                              mean_ratio, scaled_jacobian})
            CHECK(measure(mirrored) == doctest::Approx(-measure(t)).epsilon(1e-9));
        for (auto* measure : {omega, tau, circumradius, longest_edge})
            CHECK(measure(mirrored) == doctest::Approx(measure(t)).epsilon(1e-9));
        CHECK(dihedral_min(mirrored) == 0);
        CHECK(dihedral_max(mirrored) == 180);
    }
}

TEST_CASE("flat and collapsed tetrahedra have defined values") {
    const Point o(0, 0, 0);
    const Point x(1, 0, 0);
    const double huge = std::numeric_limits<double>::max();
    const std::vector<Tet> flat{
        {o, x, Point(1, 1, 0), Point(0, 1, 0)},               // square
        {o, Point(3, 0, 0), Point(0, 3, 0), Point(1, 1, 0)},  // a point in a triangle
        {o, x, Point(2, 0, 0), Point(5, 0, 0)},               // on a line
        {o, o, x, Point(0, 1, 0)},                            // an edge of no length
        {o, o, o, x},
        {o, o, o, o},
        {Point(huge, 0, 0), Point(-huge, 0, 0), Point(0, huge, 0),
         Point(0, 0, huge)},  // differences overflow
    };
    for (const Tet& p : flat) {
        const TetGeometry t = geometry(p);
        for (auto* measure : {beta, sigma, omega, kappa, alpha, gamma, volume, inradius, radius_ratio, aspect,
                              condition, mean_ratio, scaled_jacobian, solid_angle_min})
            CHECK(measure(t) == 0);
        CHECK(solid_angle_max(t) == 2 * std::acos(-1.0));
        CHECK(tau(t) >= 0);
        CHECK(tau(t) <= 1);
        CHECK(std::isinf(circumradius(t)));
        CHECK(dihedral_min(t) == 0);
        CHECK(dihedral_max(t) == 180);
        CHECK(phi(t, 1) >= 0);
    }
    CHECK(geometry({o, o, o, o}).longest_edge == 0);
}

TEST_CASE("near-degenerate tetrahedra keep to the bounds") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (double height = 1; height > 1e-320; height *= 1e-3) {
        for (int round = 0; round < 20; ++round) {
            Tet p;
            for (Point& q : p) q = Point(coordinate(random), coordinate(random), height * coordinate(random));
            if (round % 2 == 0)
                p[3] = p[0] + height * Point(coordinate(random), coordinate(random), coordinate(random));
            for (double value : shape(p)) CHECK(std::isfinite(value));
            const TetGeometry t = geometry(p);
            for (auto* measure :
                 {beta, sigma, kappa, alpha, gamma, tau, aspect, condition, mean_ratio, scaled_jacobian})
                CHECK(std::abs(measure(t)) <= 1 + tight);
            CHECK(omega(t) <= std::sqrt(1.5) + tight);
            CHECK(dihedral_min(t) <= dihedral_max(t));
        }
    }
    // A sliver of height h over a unit square: two angles tend to 180 degrees and four to 0, linearly in h.
    const double h = 1e-9;
    const TetGeometry sliver = geometry({Point(0, 0, 0), Point(1, 0, h), Point(1, 1, 0), Point(0, 1, h)});
    const double degree = 180 / std::acos(-1.0);
    REQUIRE(sliver.volume != 0);
    const TetGeometry upright =
        sliver.volume > 0 ? sliver
                          : geometry({Point(0, 0, 0), Point(0, 1, h), Point(1, 1, 0), Point(1, 0, h)});
    CHECK(dihedral_min(upright) == doctest::Approx(2 * h * degree).epsilon(1e-6));
    CHECK(180 - dihedral_max(upright) == doctest::Approx(2 * std::sqrt(2.0) * h * degree).epsilon(1e-4));
}

TEST_CASE("solid angles, heights and the map from the regular tetrahedron have their analytic values") {
    const double pi = std::acos(-1.0);
    const TetGeometry at_regular = geometry(regular);
    CHECK(solid_angle_min(at_regular) == doctest::Approx(std::acos(23.0 / 27)).epsilon(tight));
    CHECK(solid_angle_max(at_regular) == doctest::Approx(std::acos(23.0 / 27)).epsilon(tight));
    // An eighth of the sphere at the corner.
    const TetGeometry at_corner = geometry(corner);
    CHECK(solid_angle_max(at_corner) == doctest::Approx(pi / 2).epsilon(tight));
    CHECK(aspect(at_corner) ==
          doctest::Approx(1 / std::sqrt(3.0) / std::sqrt(2.0) * std::sqrt(1.5)).epsilon(tight));
    CHECK(scaled_jacobian(at_corner) == doctest::Approx(1 / std::sqrt(2.0)).epsilon(tight));
    CHECK(mean_ratio(at_corner) == doctest::Approx(12 * std::cbrt(0.25) / 9).epsilon(tight));
    std::mt19937 random(8);
    for (int i = 0; i < 200; ++i) {
        const Tet p = random_tet(random);
        const TetGeometry t = geometry(p);
        // By the angles between faces (Girard), and by the map's matrix itself.
        double least = 10, greatest = 0;
        for (int k = 0; k < 4; ++k) {
            const Point &o = p[k], &x = p[(k + 1) % 4], &y = p[(k + 2) % 4], &z = p[(k + 3) % 4];
            const double girard =
                (angle_at(o, x, y, z) + angle_at(o, y, z, x) + angle_at(o, z, x, y)) * pi / 180 - pi;
            least = std::min(least, girard);
            greatest = std::max(greatest, girard);
        }
        CHECK(std::abs(solid_angle_min(t) - least) < 1e-7);
        CHECK(std::abs(solid_angle_max(t) - greatest) < 1e-7);
        Eigen::Matrix3d edges, regular_edges;
        edges << p[1] - p[0], p[2] - p[0], p[3] - p[0];
        regular_edges << regular[1] - regular[0], regular[2] - regular[0], regular[3] - regular[0];
        const Eigen::Matrix3d map = edges * regular_edges.inverse();
        CHECK(condition(t) == doctest::Approx(3 / (map.norm() * map.inverse().norm())).epsilon(1e-9));
        CHECK(
            mean_ratio(t) ==
            doctest::Approx(3 * std::cbrt(std::pow(map.determinant(), 2)) / map.squaredNorm()).epsilon(1e-9));
    }
}
