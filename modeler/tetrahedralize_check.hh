#pragma once

#include <span>
#include <vector>

#include "modeler/facet_complex.hh"
#include "modeler/tetgen_protocol.hh"

namespace maille::modeler::tetgen {

/// The region of every cell, by the facets around it.
/// Throws Failure where facets disagree or one lacks a cell on a side that belongs to a region.
std::vector<Region> find_regions(const Answer& answer, const FacetComplex& complex);

/// Throws Failure, telling where, unless the answer's first points are those of the request bit by bit and
/// its facets cover every facet of the request.
void check_complete(const Answer& answer, const Request& request);

/// Throws Failure, telling where, unless every cell of a region is positively oriented, exactly, and each
/// region's cells have the volume within its facets.
void check_geometry(const Answer& answer, std::span<const Region> regions, const FacetComplex& complex);

/// Volume that the complex's facets enclose, by region number.
std::vector<double> region_volumes(const FacetComplex& complex);

}  // namespace maille::modeler::tetgen
