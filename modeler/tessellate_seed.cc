#include "modeler/tessellate_seed.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "modeler/shape_frame.hh"

namespace maille::modeler {

std::uint32_t SurfaceSeed::add_point(const Point& p) {
    points.push_back(p);
    return static_cast<std::uint32_t>(points.size() - 1);
}

void SurfaceSeed::add_triangle(const Triangle& triangle, std::uint32_t surface, bool mirrored) {
    triangles.push_back(triangle);
    if (mirrored) std::swap(triangles.back()[0], triangles.back()[1]);
    surfaces.push_back(surface);
}

Sizing::Sizing(const Shape& shape, const TessellateOptions& options, double thinnest_radius)
    : shape_(shape),
      options_(options),
      thinnest_radius_(thinnest_radius),
      max_curvature_(1 / thinnest_radius) {
    for (std::uint32_t face = 0; face < shape.faces().size(); ++face)
        max_curvature_ = std::max(max_curvature_, shape.max_curvature(face));
}

double Sizing::for_curvature(double curvature) const {
    if (!(curvature > 0)) return options_.size;
    const double eighth = std::numbers::pi / 4 / std::min(curvature, 8 / thinnest_radius_);
    double length = std::min(options_.size, eighth);
    // The middle of an equilateral triangle of edge e is e^2 / 6R below a sphere of radius R; some edges are
    // longer than wanted.
    if (options_.chord_tolerance > 0)
        length =
            std::min(length, std::sqrt(3 * options_.chord_tolerance / std::min(curvature, max_curvature_)));
    return length;
}

double Sizing::at(std::uint32_t face, const Point& p) const {
    if (shape_.faces()[face].planar) return options_.size;
    const Eigen::Matrix3d curvature = shape_.face_curvature(face, p);
    const double mean = std::abs(curvature.trace()) / 2;  // of the two principal curvatures
    return for_curvature(mean + std::sqrt(std::max(0.0, curvature.squaredNorm() / 2 - mean * mean)));
}

int doubling_count(double wanted, int least) {
    int scale = 1;
    while (wanted * wanted >= 5 * 6) {
        wanted /= 2;
        scale *= 2;
    }
    const int below = static_cast<int>(wanted);
    return std::max(least, scale * (wanted * wanted < below * (below + 1) ? below : below + 1));
}

double thinnest_radius(const Ellipsoid& shape) {
    return shape.semi_axes()[2];
}

double thinnest_radius(const Torus& shape) {
    return shape.minor() * smallest_stretch(shape.map().linear());
}

double thinnest_radius(const Cone& shape) {
    const double smaller = std::min(shape.radius(0), shape.radius(1));
    const Eigen::Matrix2d gram =
        shape.map().linear().leftCols<2>().transpose() * shape.map().linear().leftCols<2>();
    const double half_trace = gram.trace() / 2;
    const double spread = std::hypot((gram(0, 0) - gram(1, 1)) / 2, gram(0, 1));
    const double least_stretch = std::sqrt(gram.determinant() / (half_trace + spread));
    return least_stretch * (smaller > 0 ? smaller : 2);
}

double thinnest_radius(const Polyhedron&) {
    return std::numeric_limits<double>::infinity();
}

double thinnest_radius(const Turned& shape) {
    double thinnest = std::numeric_limits<double>::infinity();
    for (const auto& loop : shape.profile())
        for (const ProfileEdge& edge : loop) {
            if (edge.on_axis()) continue;
            const double smaller = std::min(edge.from.x(), edge.to.x());
            const double larger = std::max(edge.from.x(), edge.to.x());
            thinnest = std::min(thinnest, edge.centre ? edge.radius() : smaller > 0 ? smaller : 2 * larger);
        }
    return thinnest * smallest_stretch(shape.map().linear());
}

std::vector<double> graded_places(std::vector<double> wanted, double way) {
    constexpr double growth = 0.5;  // of a step, per way
    const std::size_t parts = wanted.size();
    const double part = way / static_cast<double>(parts);
    for (std::size_t i = 1; i < parts; ++i) wanted[i] = std::min(wanted[i], wanted[i - 1] + growth * part);
    for (std::size_t i = parts - 1; i-- > 0;) wanted[i] = std::min(wanted[i], wanted[i + 1] + growth * part);

    std::vector<double> steps(parts + 1, 0);
    for (std::size_t i = 0; i < parts; ++i) steps[i + 1] = steps[i] + part / wanted[i];
    const double count = std::max(1.0, std::round(steps.back()));
    std::vector<double> places;
    std::size_t i = 0;
    for (double k = 0; k < count; ++k) {
        const double target = steps.back() * k / count;
        while (steps[i + 1] <= target) ++i;
        places.push_back((static_cast<double>(i) + (target - steps[i]) / (steps[i + 1] - steps[i])) /
                         static_cast<double>(parts));
    }
    places.push_back(1);
    return places;
}

}  // namespace maille::modeler
