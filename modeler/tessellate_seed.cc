#include "modeler/tessellate_seed.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

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

double Sizing::for_curvature(double curvature) const {
    double length = options_.size;
    if (curvature > 0) {
        length = std::min(length, std::numbers::pi / 4 / curvature);
        // The middle of an equilateral triangle of edge e is e^2 / 6R below a sphere of radius R.
        if (options_.chord_tolerance > 0)
            length = std::min(length, std::sqrt(6 * options_.chord_tolerance / curvature));
    }
    return length;
}

double Sizing::at(std::uint32_t face, const Point& p) const {
    const double least = for_curvature(shape_.max_curvature(face));
    if (least == options_.size) return least;
    return std::max(for_curvature(shape_.face_curvature(face, p).norm()), least / 4);
}

}  // namespace maille::modeler
