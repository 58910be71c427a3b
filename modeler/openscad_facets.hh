#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modeler/primitive.hh"

namespace maille::modeler {

/// A closed polyhedron: faces counter-clockwise seen from outside, with their names.
struct FacetedSolid {
    std::vector<Point> points;
    std::vector<std::vector<std::uint32_t>> faces;
    std::vector<std::string> names;
};

/// OpenSCAD's special variables that say how many facets a round solid has.
struct FacetSettings {
    double fn = 0;   ///< number of facets around; 0: as $fa and $fs say
    double fa = 12;  ///< smallest angle of a facet, in degrees
    double fs = 2;   ///< smallest length of a facet
};

/// Sine and cosine of an angle in degrees, exact at multiples of 30 as far as a double can be.
double sin_degrees(double angle);
double cos_degrees(double angle);

/// Round solids with more facets around than this are refused.
inline constexpr int max_fragments = 2000;

/// How many facets OpenSCAD 2021 gives a circle of this radius (its get_fragments_from_r).
/// Throws InputError for more than `max_fragments`.
int openscad_fragments(double radius, const FacetSettings& settings);

/// In how many slices OpenSCAD 2021 extrudes a shape of which no other number is asked for. `reach` is the
/// distance of its farthest corner from the origin, `shift` the longest way that the scale moves a corner.
int openscad_slices(double height, double twist, const Eigen::Vector2d& scale, double reach, double shift,
                    const FacetSettings& settings);

/// The polyhedron that OpenSCAD 2021 makes of a sphere: rings of vertices on it, half a step away from the
/// poles.
FacetedSolid openscad_sphere(double radius, int fragments);

/// The polyhedron that OpenSCAD 2021 makes of a cylinder or cone; at most one of the radii is 0.
FacetedSolid openscad_cylinder(double height, double bottom_radius, double top_radius, bool center,
                               int fragments);

}  // namespace maille::modeler
