#include "modeler/openscad_facets.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "volmesh/error.hh"

namespace maille::modeler {
namespace {

constexpr double finest_grid = 0.00000095367431640625;
constexpr double least_angle_or_length = 0.01;

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

/// Sine of an angle from 0 to 90 degrees, OpenSCAD's to the last bit: that decides how arcs are divided.
double sine_of_acute(double angle) {
    if (angle == 30) return 0.5;
    if (angle == 45) return std::sqrt(0.5);
    if (angle == 60) return std::sqrt(3.0) / 2;
    return angle <= 45 ? std::sin(radians(angle)) : std::cos(radians(90 - angle));
}

/// Counter-clockwise seen from above; returns the number of the first point.
std::uint32_t add_ring(FacetedSolid& solid, double radius, double z, int fragments) {
    const auto first = static_cast<std::uint32_t>(solid.points.size());
    for (int i = 0; i < fragments; ++i) {
        const double angle = 360.0 * i / fragments;
        solid.points.emplace_back(radius * cos_degrees(angle), radius * sin_degrees(angle), z);
    }
    return first;
}

void add_face(FacetedSolid& solid, std::vector<std::uint32_t> corners, const char* name) {
    solid.faces.push_back(std::move(corners));
    solid.names.emplace_back(name);
}

/// The ring itself as a face that looks up, or down.
void add_cap(FacetedSolid& solid, std::uint32_t ring, int fragments, bool looks_up, const char* name) {
    std::vector<std::uint32_t> corners(static_cast<std::size_t>(fragments));
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = ring + static_cast<std::uint32_t>(i);
    if (!looks_up) std::ranges::reverse(corners);
    add_face(solid, std::move(corners), name);
}

void add_band(FacetedSolid& solid, std::uint32_t lower, std::uint32_t upper, int fragments,
              const char* name) {
    const auto n = static_cast<std::uint32_t>(fragments);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        add_face(solid, {lower + i, lower + j, upper + j, upper + i}, name);
    }
}

/// Triangles from a ring to a point above it, or below it.
void add_fan(FacetedSolid& solid, std::uint32_t ring, double apex_z, bool apex_above, int fragments,
             const char* name) {
    const auto apex = static_cast<std::uint32_t>(solid.points.size());
    solid.points.emplace_back(0, 0, apex_z);
    const auto n = static_cast<std::uint32_t>(fragments);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        add_face(solid,
                 apex_above ? std::vector{ring + i, ring + j, apex} : std::vector{ring + j, ring + i, apex},
                 name);
    }
}

}  // namespace

double sin_degrees(double angle) {
    const double turned = std::fmod(angle, 360.0);
    const double positive = turned < 0 ? turned + 360 : turned;
    const double half = positive >= 180 ? positive - 180 : positive;
    const double sine = sine_of_acute(half > 90 ? 180 - half : half);
    return positive >= 180 && sine != 0 ? -sine : sine;
}

double cos_degrees(double angle) {
    return sin_degrees(angle + 90);
}

int openscad_fragments(double radius, const FacetSettings& settings) {
    if (radius < finest_grid) return 3;
    const double by_angle = 360 / std::max(settings.fa, least_angle_or_length);
    const double by_length = radius * 2 * std::numbers::pi / std::max(settings.fs, least_angle_or_length);
    const double fragments = settings.fn > 0 ? std::max(std::floor(settings.fn), 3.0)
                                             : std::ceil(std::max(std::min(by_angle, by_length), 5.0));
    if (fragments > max_fragments)
        throw InputError(fmt::format("{} facets around are more than {}: lower $fn, or raise $fa or $fs",
                                     fragments, max_fragments));
    return static_cast<int>(fragments);
}

int openscad_slices(double height, double twist, const Eigen::Vector2d& scale, double reach, double shift,
                    const FacetSettings& settings) {
    const bool is_uniform = scale.x() == scale.y();
    const double fs = std::max(settings.fs, least_angle_or_length);
    double slices = 1;
    if (twist != 0) {
        const double turn = std::abs(radians(twist));
        double way = reach * turn;  // of the farthest corner, seen from above: an arc or a piece of a spiral
        if (is_uniform && scale.x() != 1) {
            const auto spiral = [](double angle) {
                return (angle * std::hypot(1, angle) + std::asinh(angle)) / 2;
            };
            const double end = turn * std::max(1.0, scale.x()) / std::abs(scale.x() - 1);
            way = reach / end * (spiral(end) - spiral(end - turn));
        }
        const double by_angle = std::ceil(std::abs(twist) / std::max(settings.fa, least_angle_or_length));
        const double by_length = std::ceil(std::hypot(way, height) / fs);
        const double most = reach < finest_grid ? 1
                            : settings.fn > 0   ? std::ceil(std::abs(twist) / 360 * settings.fn)
                                                : std::min(by_angle, by_length);
        slices = std::max({most, std::ceil(std::abs(twist) / 120), 1.0});
    } else if (!is_uniform && shift >= finest_grid) {
        slices = settings.fn > 0 ? std::floor(settings.fn) : std::ceil(std::hypot(shift, height) / fs);
    }
    if (slices > max_fragments)
        throw InputError(
            fmt::format("{} slices are more than {}: give 'slices', lower $fn, or raise $fa or $fs", slices,
                        max_fragments));
    return std::max(1, static_cast<int>(slices));
}

FacetedSolid openscad_sphere(double radius, int fragments) {
    FacetedSolid solid;
    const int rings = (fragments + 1) / 2;
    std::uint32_t above = 0;
    for (int i = 0; i < rings; ++i) {
        const double polar = 180 * (i + 0.5) / rings;
        const std::uint32_t ring =
            add_ring(solid, radius * sin_degrees(polar), radius * cos_degrees(polar), fragments);
        if (i == 0)
            add_cap(solid, ring, fragments, true, "surface");
        else
            add_band(solid, ring, above, fragments, "surface");
        above = ring;
    }
    add_cap(solid, above, fragments, false, "surface");
    return solid;
}

FacetedSolid openscad_cylinder(double height, double bottom_radius, double top_radius, bool center,
                               int fragments) {
    FacetedSolid solid;
    const double bottom_z = center ? -height / 2 : 0;
    const double top_z = center ? height / 2 : height;
    if (bottom_radius > 0) {
        const std::uint32_t bottom = add_ring(solid, bottom_radius, bottom_z, fragments);
        if (top_radius > 0) {
            const std::uint32_t top = add_ring(solid, top_radius, top_z, fragments);
            add_band(solid, bottom, top, fragments, "side");
            add_cap(solid, top, fragments, true, "top");
        } else {
            add_fan(solid, bottom, top_z, true, fragments, "side");
        }
        add_cap(solid, bottom, fragments, false, "bottom");
    } else {
        const std::uint32_t top = add_ring(solid, top_radius, top_z, fragments);
        add_fan(solid, top, bottom_z, false, fragments, "side");
        add_cap(solid, top, fragments, true, "top");
    }
    return solid;
}

}  // namespace maille::modeler
