#include "examples/adaptive/problems.hh"

#include <cmath>
#include <complex>
#include <numbers>

#include "volmesh/error.hh"

namespace adaptive {
namespace {

using Complex = std::complex<double>;

constexpr double radius = 0.5;
constexpr double power = 2.0 / 3;

double s_of(const Point& p) {
    return (p.head<2>().squaredNorm() - radius * radius) / (2 * radius);
}

/// w to some power; its angle is 0 on the hole's bottom and 3/2 pi on its side.
Complex w_to(double exponent, const Point& p) {
    const Complex w(-s_of(p), -p.z());
    const double angle = std::arg(w);
    const double least = -std::numbers::pi / 4;  // in the middle of the hole
    return std::polar(std::pow(std::abs(w), exponent),
                      exponent * (angle < least ? angle + 2 * std::numbers::pi : angle));
}

double value(const Point& p) {
    return w_to(power, p).imag();
}

/// The derivatives of Im w^(2/3) by s and by z.
double by_s(const Point& p) {
    return -power * w_to(power - 1, p).imag();
}
double by_z(const Point& p) {
    return -power * w_to(power - 1, p).real();
}
double by_s_twice(const Point& p) {
    return power * (power - 1) * w_to(power - 2, p).imag();
}

Point gradient(const Point& p) {
    const double u_s = by_s(p);
    return {u_s * p.x() / radius, u_s * p.y() / radius, by_z(p)};
}

/// Of u(s(R), z), harmonic in s and z: the rest of the Laplacian comes from s(R) and from the axis.
double source(const Point& p) {
    return -(by_s_twice(p) * 2 * s_of(p) + 2 * by_s(p)) / radius;
}

}  // namespace

Example fichera() {
    const auto zero = [](const Point&) { return 0.0; };
    return {.name = "fichera",
            .model = "fichera.csg",
            .problem = {[](const Point&) { return 1.0; }, {{"notch/", zero}}},
            .exact = {},
            .exact_energy = 0};
}

Example blind_hole() {
    const auto zero = [](const Point&) { return 0.0; };
    return {.name = "blind_hole",
            .model = "blind_hole.csg",
            .problem = {source, {{"block/", value}, {"hole/", zero}}},
            .exact = Exact{gradient}};
}

Example example(const std::string& name) {
    for (Example each : {fichera(), blind_hole()})
        if (each.name == name) return each;
    throw maille::InputError("there is no example \"" + name + "\": fichera or blind_hole");
}

}  // namespace adaptive
