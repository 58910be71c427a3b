#include "tools/convergence/cases.hh"

#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/roots.hpp>

namespace maille::convergence {
namespace {

constexpr double pi = std::numbers::pi;

double square(double x) {
    return x * x;
}
double cube(double x) {
    return x * x * x;
}

template <class Function>
double integral(const Function& f, double from, double to) {
    return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(f, from, to, 12, 1e-12);
}

Case sphere() {
    return {"sphere",   "sphere(r = 1);", 0.4,
            4 * pi / 3, 4 * pi,           {{"sphere1/surface", 4 * pi}, {"sphere1", 4 * pi / 3}}};
}

Case ellipsoid() {
    // A spheroid of half axes 1, 1, 2: area by its eccentricity.
    const double e = std::sqrt(0.75);
    const double area = 2 * pi * (1 + 2 / e * std::asin(e));
    return {"ellipsoid", "scale([1, 1, 2]) sphere(r = 1);", 0.4, 8 * pi / 3,
            area,        {{"sphere1/surface", area}}};
}

Case cylinder() {
    return {"cylinder", "cylinder(h = 2, r = 1);",
            0.4,        2 * pi,
            6 * pi,     {{"cylinder1/side", 4 * pi}, {"cylinder1/bottom", pi}, {"cylinder1/top", pi}}};
}

Case cone() {
    const double slant = std::sqrt(square(0.6) + square(1.5));
    const double side = pi * (1 + 0.4) * slant;
    return {"cone",
            "cylinder(h = 1.5, r1 = 1, r2 = 0.4);",
            0.4,
            pi * 1.5 / 3 * (1 + 0.4 + 0.16),
            side + pi * 1.16,
            {{"cylinder1/side", side}, {"cylinder1/bottom", pi}, {"cylinder1/top", 0.16 * pi}}};
}

Case torus() {
    const double area = 4 * square(pi) * 2 * 0.6;
    return {"torus", "torus(r1 = 2, r2 = 0.6);", 0.4, 2 * square(pi) * 2 * 0.36,
            area,    {{"torus1/surface", area}}};
}

Case bicylinder() {
    return {"bicylinder", "", 0.4, 16.0 / 3, 16, {{"along_z/side", 8}, {"along_x/side", 8}}};
}

Case lens() {
    return {"lens", "",
            0.4,    2 * pi / 3 * 0.25 * 5.5,
            4 * pi, {{"front/surface", 2 * pi}, {"back/surface", 2 * pi}}};
}

Case napkin_ring() {
    return {"napkin_ring",
            "",
            0.3,
            pi / 6 * cube(1.2),
            2 * pi * 1.2 * (1 + 0.8),
            {{"ball/surface", 2 * pi * 1.2}, {"drill/side", 2 * pi * 1.2 * 0.8}}};
}

Case die() {
    constexpr double R = 1.35;
    const double pip = pi * square(0.16);
    const double disc = pi * (square(R) - 1);
    const double round = 4 * pi * square(R) - 6 * 2 * pi * R * (R - 1);
    Case c{"die",
           "",
           0.3,
           4 * pi / 3 * cube(R) - 2 * pi * square(R - 1) * (2 * R + 1) - 14 * pi * cube(0.16),
           round + 6 * disc + 21 * pip,
           {{"round/surface", round}}};
    const std::vector<std::pair<const char*, const char*>> sides{
        {"one", "x+"}, {"two", "y+"}, {"three", "z+"}, {"four", "z-"}, {"five", "y-"}, {"six", "x-"}};
    for (std::size_t n = 1; n <= sides.size(); ++n) {
        const auto& [pips, side] = sides[n - 1];
        c.sets[std::string(pips) + "/surface"] = static_cast<double>(n) * 2 * pip;
        c.sets[std::string("flat/") + side] = disc - static_cast<double>(n) * pip;
    }
    return c;
}

Case stacked_boxes() {
    // The block covers 4 of the slab's top, the kerb another 4; all sides but those show.
    return {"stacked_boxes",
            "",
            0.8,
            24,
            16 + 16 + 16 + 8 + 10,
            {{"slab", 16},
             {"block", 4},
             {"kerb", 4},
             {"concrete", 16},
             {"brick", 8},
             {"slab/z-", 16},
             {"slab/z+", 8},
             {"slab/x-", 4},
             {"slab/x+", 4},
             {"slab/y-", 4},
             {"slab/y+", 4},
             {"slab/z+/inner", 8},
             {"block/z+", 4},
             {"kerb/z+", 4}}};
}

Case two_materials() {
    const double ball = 4 * pi / 3 * cube(0.6);
    return {"two_materials",
            "",
            0.4,
            8,
            24,
            {{"ball", ball},
             {"lead", ball},
             {"block", 8 - ball},
             {"resin", 8 - ball},
             {"ball/surface/inner", 4 * pi * 0.36},
             {"block/x-", 4},
             {"block/z+", 4}}};
}

/// Millimetres; y is the way through the boss, z up. Where two solids of the union overlap the earlier owns
/// the place, and the later one's surfaces end there.
Case bracket() {
    // Of the boss's section (radius 16, centre at z = -5): the part below z = -2, in the upright.
    const double half_chord = std::sqrt(256.0 - 9), rise = std::asin(3.0 / 16);
    const double in_upright = 128 * pi + 3 * half_chord + 256 * rise;
    // And the part in the rib, 6 wide, whose top is at z = -19.
    const double reach = std::sqrt(256.0 - 9), in_rib = 3 * reach + 256 * rise - 6 * 14;
    // What the fillet (radius 9) leaves of the bar's section between the upright and the base.
    const double leg = 8 - std::sqrt(17.0), fillet_angle = pi / 2 - 2 * std::acos(8.0 / 9);
    const double leaf = 64 - (8 * std::sqrt(17.0) + 81 * fillet_angle / 2);
    // The rib's section beyond the upright and above the base: 25 wide at the bottom, 4 at the top.
    const double rib = 21 * (25.0 + 4) / 2;

    const double bushing = 18 * pi * (64 - 25);
    const double hole = pi * (10 * square(3.5) + 40.5);
    const double steel = 60 * 50 * 10 + 40 * 10 * 38 + (14 * 256 * pi - 10 * in_upright) +
                         (6 * rib - 2 * in_rib) + 34 * leaf - 14 * 64 * pi - 2 * hole;
    Case c{"bracket",
           "",
           3,
           steel + bushing,
           0,
           {{"base/x-", 50 * 10},
            {"base/x+", 50 * 10},
            {"base/y-", 60 * 10},
            {"base/y+", 60 * 10},
            {"base/z-", 60 * 50 - 2 * pi * square(3.5)},
            {"base/z+", 60 * 50 - 40 * 10 - 6 * 25 - 34 * leg - 2 * pi * square(6.5)},
            {"upright/x-", 10 * 38},
            {"upright/x+", 10 * 38},
            {"upright/y-", 40 * 38 - in_upright},
            {"upright/y+", 40 * 38 - in_upright - (6 * 21 - in_rib) - 34 * leg},
            {"upright/z+", 10 * (40 - 2 * half_chord)},
            {"boss/side", 16 * (2 * 2 * pi + 10 * (pi - 2 * rise) + 2 * (2 * pi - 2 * rise))},
            {"boss/bottom", pi * (256 - 64)},
            {"boss/top", pi * (256 - 64) - in_rib},
            {"rib/x+", 6 * 21 * std::sqrt(2.0)},
            {"rib/y-", rib - 2 * (reach - 14) - leaf},
            {"rib/y+", rib - 2 * (reach - 14) - leaf},
            {"rib/z+", 6 * 2},
            {"bar/x-", leaf},
            {"bar/x+", leaf},
            {"fillet/side", 34 * 9 * fillet_angle},
            {"bushing/side", 2 * pi * 8 * 4},
            {"bushing/bottom", pi * (64 - 25)},
            {"bushing/top", pi * (64 - 25)},
            {"bore/side", 2 * pi * 5 * 18},
            {"hole/side", 2 * 2 * pi * 3.5 * 7},
            {"countersink/side", 2 * pi * (3.5 + 6.5) * 3 * std::sqrt(2.0)}}};
    for (const auto& [name, area] : c.sets) c.area += area;
    c.sets["bushing/side/inner"] = 2 * pi * 8 * 14;
    c.sets["bushing"] = c.sets["bronze"] = bushing;
    c.sets["steel"] = steel;
    return c;
}

/// A round pipe along x of radius b meets an upright one of radius a < b, both axes through the origin.
struct Crossing {
    double a, b;

    /// Volume that they share above the origin.
    double volume() const {
        return integral([&](double t) { return 2 * square(a * std::cos(t)) * height(t); }, -pi / 2, pi / 2);
    }
    /// Area of the lying pipe's surface that the upright one cuts out above the origin.
    double patch() const {
        return integral([&](double t) { return 2 * square(a * std::cos(t)) * b / height(t); }, -pi / 2,
                        pi / 2);
    }
    /// Area of the upright pipe's surface below the lying one's.
    double sleeve() const {
        return integral([&](double t) { return 2 * a * height(t); }, -pi / 2, pi / 2);
    }
    /// Height of the lying pipe over y = a sin t.
    double height(double t) const { return std::sqrt(square(b) - square(a * std::sin(t))); }
};

Case tee() {
    const Crossing outer{0.4, 0.5};
    const Crossing bore{0.28, 0.35};
    Case c{"tee",
           "",
           0.3,
           pi * (0.25 * 3 + 0.16 * 1.4) - outer.volume() -
               (pi * (square(0.35) * 3 + square(0.28) * 1.4) - bore.volume()),
           0,
           {{"run/side", pi * 3 - outer.patch()},
            {"branch/side", 2 * pi * 0.4 * 1.4 - outer.sleeve()},
            {"run_bore/side", 2 * pi * 0.35 * 3 - bore.patch()},
            {"branch_bore/side", 2 * pi * 0.28 * 1.4 - bore.sleeve()},
            {"run/bottom", pi * (0.25 - square(0.35))},
            {"run/top", pi * (0.25 - square(0.35))},
            {"branch/top", pi * (0.16 - square(0.28))}}};
    for (const auto& [name, area] : c.sets) c.area += area;
    return c;
}

/// The ring of torus_with_hole: where a line along the hole enters and leaves it.
class DrilledRing {
  public:
    using Point = Eigen::Vector3d;

    /// Distance along the hole from its middle plane to the ring's surface, forwards (1) or backwards (-1).
    double reach(const Point& start, int way) const {
        const auto level = [&](double t) { return implicit(start + way * t * along_); };
        std::uintmax_t steps = 100;
        const auto [low, high] = boost::math::tools::toms748_solve(
            level, 0.0, 1.2, boost::math::tools::eps_tolerance<double>(50), steps);
        return (low + high) / 2;
    }
    double chord(double radius, double angle) const {
        return reach(start(radius, angle), 1) + reach(start(radius, angle), -1);
    }
    /// Area of the ring's surface over that of the hole's section, at both ends.
    double mouths(double radius, double angle) const {
        double sum = 0;
        for (int way : {1, -1}) {
            const Point q = start(radius, angle) + way * reach(start(radius, angle), way) * along_;
            sum += 1 / std::abs(normal(q).dot(along_));
        }
        return sum;
    }
    /// Over the hole's section.
    template <class Function>
    static double over_disc(const Function& f, double radius) {
        return integral(
            [&](double r) { return r * integral([&](double angle) { return f(r, angle); }, 0, 2 * pi); }, 0,
            radius);
    }

  private:
    Point start(double radius, double angle) const {
        return Point(2, 0, 0) + radius * (std::cos(angle) * across_ + std::sin(angle) * Point::UnitY());
    }
    static double implicit(const Point& p) { return square(p.head<2>().norm() - 2) + square(p.z()) - 0.36; }
    static Point normal(const Point& p) {
        const double rho = p.head<2>().norm();
        return Point((rho - 2) * p.x() / rho, (rho - 2) * p.y() / rho, p.z()).normalized();
    }

    const double tilt_ = pi / 9;
    const Point along_{std::sin(tilt_), 0, std::cos(tilt_)};
    const Point across_{std::cos(tilt_), 0, -std::sin(tilt_)};
};

Case torus_with_hole() {
    const DrilledRing ring;
    const double drilled = DrilledRing::over_disc([&](double r, double t) { return ring.chord(r, t); }, 0.25);
    const double mouths = DrilledRing::over_disc([&](double r, double t) { return ring.mouths(r, t); }, 0.25);
    const double bore = integral([&](double t) { return 0.25 * ring.chord(0.25, t); }, 0, 2 * pi);

    // Beyond x = -2.3: rho = 2 + 0.6 cos t is cut off over the angle 2 acos(2.3 / rho).
    const double end = std::acos(0.5);
    const auto angle = [](double t) { return 2 * std::acos(std::min(1.0, 2.3 / (2 + 0.6 * std::cos(t)))); };
    const double off = integral(
        [&](double t) { return 2 * square(0.6 * std::sin(t)) * (2 + 0.6 * std::cos(t)) * angle(t); }, 0, end);
    const double skin_off =
        integral([&](double t) { return 2 * 0.6 * (2 + 0.6 * std::cos(t)) * angle(t); }, 0, end);
    // Half widths of the flat by height z = 0.6 sin s.
    const double flat = integral(
        [&](double s) {
            const double rho = 2 + 0.6 * std::cos(s);
            return 2 * std::sqrt(std::max(0.0, square(rho) - square(2.3))) * 0.6 * std::cos(s);
        },
        -end, end);
    const double skin = 4 * square(pi) * 2 * 0.6 - mouths - skin_off;
    return {"torus_with_hole",
            "",
            0.3,
            2 * square(pi) * 2 * 0.36 - drilled - off,
            skin + bore + flat,
            {{"ring/surface", skin}, {"hole/side", bore}}};
}

}  // namespace

std::vector<Case> all_cases() {
    return {sphere(), ellipsoid(),   cylinder(),      cone(),          torus(), bicylinder(),      lens(),
            die(),    napkin_ring(), stacked_boxes(), two_materials(), tee(),   torus_with_hole(), bracket()};
}

}  // namespace maille::convergence
