#include "quality/objective.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace maille::quality {
namespace {

/// A cell seen from its first vertex p. Normals are those of the faces opposite each vertex, inwards, as long
/// as twice the area.
struct Frame {
    std::array<Point, 3> spokes;  ///< from p to the others
    std::array<Point, 3> rims;    ///< opposite edges: from 1 to 2, 2 to 3, 3 to 1, by the third vertex
    std::array<Point, 4> normals;
    std::array<double, 4> squared_areas;  ///< of the normals
    double volume;                        ///< six times
    std::array<double, 3> spoke_squares, rim_squares;

    Frame(const Point& p, const Point& b, const Point& c, const Point& d)
        : spokes{b - p, c - p, d - p}, rims{d - c, b - d, c - b} {
        normals[1] = spokes[1].cross(spokes[2]);
        normals[2] = spokes[2].cross(spokes[0]);
        normals[3] = spokes[0].cross(spokes[1]);
        normals[0] = -(normals[1] + normals[2] + normals[3]);
        volume = spokes[0].dot(normals[1]);
        for (int i = 0; i < 4; ++i) squared_areas[i] = normals[i].squaredNorm();
        for (int i = 0; i < 3; ++i) {
            spoke_squares[i] = spokes[i].squaredNorm();
            rim_squares[i] = rims[i].squaredNorm();
        }
    }

    double gamma() const {
        double squares = 0;
        for (int i = 0; i < 3; ++i) squares += spoke_squares[i] + rim_squares[i];
        squares /= 6;
        return squares > 0 ? std::numbers::sqrt2 * volume / (squares * std::sqrt(squares)) : 0;
    }

    /// x y z: squares of the products of opposite edges.
    std::array<double, 3> products() const {
        return {spoke_squares[0] * rim_squares[0], spoke_squares[1] * rim_squares[1],
                spoke_squares[2] * rim_squares[2]};
    }
    double sum_of_areas() const {
        return std::sqrt(squared_areas[0]) + std::sqrt(squared_areas[1]) + std::sqrt(squared_areas[2]) +
               std::sqrt(squared_areas[3]);
    }
};

/// 16 times the squared area of the triangle with sides the roots of x, y and z.
double heron(const std::array<double, 3>& xyz) {
    const auto& [x, y, z] = xyz;
    return 2 * (x * y + y * z + z * x) - x * x - y * y - z * z;
}

/// The faces at a spoke, and at a rim.
constexpr std::array<std::array<int, 2>, 3> faces_at_spoke{{{2, 3}, {1, 3}, {1, 2}}};
constexpr std::array<std::array<int, 2>, 3> faces_at_rim{{{0, 1}, {0, 2}, {0, 3}}};

double weight_of_angle(const Frame& t, int i, int j) {
    return t.normals[i].dot(t.normals[j]) > 0 ? obtuse_weight : 1;
}

/// 3 r / R = 12 (6V)^2 / (sum of double areas, times the root of Heron's product).
double weighted_beta(const Frame& t) {
    const double sixteen = heron(t.products());
    const double below = t.sum_of_areas() * std::sqrt(std::max(sixteen, 0.0));
    return below > 0 ? beta_weight * 12 * t.volume * t.volume / below : 0;
}

/// Logarithmic gradients in p: of the volume and of the areas.
struct LogSlopes {
    Point volume;
    std::array<double, 4> areas;  ///< double ones, of the faces opposite each vertex
    std::array<Point, 4> area_parts;

    explicit LogSlopes(const Frame& t) : volume(t.normals[0] / t.volume) {
        for (int i = 0; i < 4; ++i) areas[i] = std::sqrt(t.squared_areas[i]);
        area_parts[0].setZero();
        for (int i = 1; i < 4; ++i) area_parts[i] = t.normals[i].cross(t.rims[i - 1]) / t.squared_areas[i];
    }
};

Point log_slope_of_beta(const Frame& t, const LogSlopes& log) {
    const auto xyz = t.products();
    const double sum = xyz[0] + xyz[1] + xyz[2];
    Point heron_slope = Point::Zero();
    Point areas_slope = Point::Zero();
    for (int i = 0; i < 3; ++i) {
        heron_slope -= 4 * (sum - 2 * xyz[i]) * t.rim_squares[i] * t.spokes[i];
        areas_slope += log.areas[i + 1] * log.area_parts[i + 1];
    }
    const double all_areas = log.areas[0] + log.areas[1] + log.areas[2] + log.areas[3];
    return 2 * log.volume - areas_slope / all_areas - heron_slope / (2 * heron(xyz));
}

}  // namespace

Shape shape(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Frame t(a, b, c, d);
    const double weighted = weighted_beta(t);
    if (!(t.volume > 0)) return {t.gamma(), -weighted / beta_weight};
    double least = std::numeric_limits<double>::infinity();
    const auto add = [&](double square, const std::array<int, 2>& at) {
        const auto [i, j] = at;
        const double weight = weight_of_angle(t, i, j);
        least = std::min(least, weight * weight * square / (t.squared_areas[i] * t.squared_areas[j]));
    };
    for (int i = 0; i < 3; ++i) {
        add(t.spoke_squares[i], faces_at_spoke[i]);
        add(t.rim_squares[i], faces_at_rim[i]);
    }
    return {std::min(t.volume * std::sqrt(least), weighted), weighted / beta_weight};
}

double objective(const Point& a, const Point& b, const Point& c, const Point& d) {
    return shape(a, b, c, d).objective;
}

double least_objective(const Point& p, const Bases& bases, double enough) {
    double least = std::numeric_limits<double>::infinity();
    for (const Base& base : bases) {
        least = std::min(least, objective(p, base));
        if (least <= enough) break;
    }
    return least;
}

void append_slopes(const Point& p, const Base& base, double most, Slopes& slopes) {
    const Frame t(p, base[0], base[1], base[2]);
    if (!(t.volume > 0)) {
        const double value = t.gamma();
        double squares = 0;
        for (int i = 0; i < 3; ++i) squares += t.spoke_squares[i] + t.rim_squares[i];
        if (value > most || !(squares > 0)) return;
        const Point outward = t.spokes[0] + t.spokes[1] + t.spokes[2];
        const double factor = std::numbers::sqrt2 / std::pow(squares / 6, 1.5);
        slopes.push_back({value, factor * t.normals[0] + 3 * value / squares * outward});
        return;
    }
    const LogSlopes log(t);
    const auto add = [&](double square, const std::array<int, 2>& at, const Point& edge_part) {
        const auto [i, j] = at;
        const double value =
            weight_of_angle(t, i, j) * t.volume * std::sqrt(square) / (log.areas[i] * log.areas[j]);
        if (value <= most)
            slopes.push_back(
                {value, value * (log.volume + edge_part - log.area_parts[i] - log.area_parts[j])});
    };
    for (int i = 0; i < 3; ++i) {
        add(t.spoke_squares[i], faces_at_spoke[i], -t.spokes[i] / t.spoke_squares[i]);
        add(t.rim_squares[i], faces_at_rim[i], Point::Zero());
    }
    const double value = weighted_beta(t);
    if (value <= most) slopes.push_back({value, value * log_slope_of_beta(t, log)});
}

Slope beta_slope(const Point& p, const Base& base) {
    const Frame t(p, base[0], base[1], base[2]);
    const double beta = weighted_beta(t) / beta_weight;
    return {beta, beta * log_slope_of_beta(t, LogSlopes(t))};
}

}  // namespace maille::quality
