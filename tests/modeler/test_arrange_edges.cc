#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "modeler/arrange.hh"
#include "tests/modeler/arrange_checks.hh"

using namespace maille::modeler;
using namespace maille::modeler::test;

namespace {

/// Every whole number from the one to the other.
std::vector<double> steps(double low, double high) {
    std::vector<double> lines;
    for (double x = low; x <= high; ++x) lines.push_back(x);
    return lines;
}

using Polygon = std::vector<Eigen::Vector2d>;

/// The part of a convex polygon where coordinate `axis` times `sign` is at most `limit`.
Polygon clipped(const Polygon& polygon, Eigen::Index axis, double sign, double limit) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = sign * a[axis] - limit, db = sign * b[axis] - limit;
        if (da <= 0) result.push_back(a);
        if ((da < 0) != (db < 0)) result.push_back(a + (b - a) * (da / (da - db)));
    }
    return result;
}

double area(const Polygon& polygon) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        sum += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    return sum;
}

/// Area of a regular polygon where |x| <= half_x and |y| <= half_y.
double clipped_area(double radius, int n, double half_x, double half_y) {
    Polygon polygon;
    for (int i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n;
        polygon.emplace_back(radius * std::cos(a), radius * std::sin(a));
    }
    for (const double sign : {-1.0, 1.0})
        polygon = clipped(clipped(polygon, 0, sign, half_x), 1, sign, half_y);
    return area(polygon);
}

}  // namespace

TEST_CASE("Random trees of boxes cut into squares have the volumes that counting cells gives") {
    for (unsigned seed = 0; seed < 30; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        std::vector<std::array<Vector3d, 2>> corners;
        std::vector<ClosedSurface> primitives;
        for (std::uint32_t i = 0; i < 7; ++i) {
            std::array<std::vector<double>, 3> lines;
            for (auto& l : lines) {
                const auto low = static_cast<int>(random() % 4), length = static_cast<int>(random() % 5);
                l = steps(low, std::min(6, low + 1 + length));
            }
            primitives.push_back(grid_box(lines, 6 * i));
            corners.push_back({Vector3d(lines[0].front(), lines[1].front(), lines[2].front()),
                               Vector3d(lines[0].back(), lines[1].back(), lines[2].back())});
        }
        const CsgTree tree = random_tree(random, 0, 7);
        check_volumes(arrange(primitives, tree), count_cells(corners, tree, 6), 1e-13);
    }
}

TEST_CASE("A surface is cut along its own edges where others meet it there") {
    // The bar's faces have edges exactly where the faces of the cube cross them, and the cone cuts both.
    const ClosedSurface cube = grid_box({steps(-15, 15), steps(-15, 15), steps(-15, 15)});
    const ClosedSurface bar = grid_box({std::vector<double>{-25, -15, -5, 5, 15, 25}, {-5, 5}, {-5, 5}}, 6);
    constexpr int n = 30;
    ClosedSurface cone = cylinder(1, 50, n, 12);
    const auto radius = [](double z) { return 20 - 0.3 * (z + 20); };
    for (auto& p : cone.points) {
        p.z() -= 20;
        p.head<2>() *= radius(p.z());
    }
    const CsgTree tree = node(Operation::intersection, {pair(Operation::difference), leaf(2)});

    double expected = 0;
    constexpr int slices = 30000;  // midpoint rule, whole slices on either side of the bar's faces
    for (int i = 0; i < slices; ++i) {
        const double z = -15 + 30 * (i + 0.5) / slices;
        expected += clipped_area(radius(z), n, 15, 15);
        if (std::abs(z) < 5) expected -= clipped_area(radius(z), n, 15, 5);
    }
    expected *= 30.0 / slices;
    CHECK(volume_of({cube, bar, cone}, tree) == doctest::Approx(expected).epsilon(1e-8));
}
