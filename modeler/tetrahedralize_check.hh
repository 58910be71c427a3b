#pragma once

#include <cstdint>
#include <vector>

#include "modeler/facet_complex.hh"
#include "modeler/tetgen_protocol.hh"

namespace maille::modeler::tetgen {

/// The cells of an answer by the facets between them.
struct Regions {
    std::vector<Region> of_cell;
    std::vector<std::uint32_t> component;  ///< of each cell: cells that no facet separates have the same
    std::uint32_t n_components = 0;
};

/// Tells the region of every cell from the facets around it.
/// Throws Failure where facets disagree or one lacks a cell on a side that belongs to a region.
Regions find_regions(const Answer& answer, const FacetComplex& complex);

/// Throws Failure, telling where, unless the answer's first points are those of the request bit by bit and
/// its facets cover every facet of the request.
void check_complete(const Answer& answer, const Request& request);

/// Throws Failure, telling where, unless every cell of a region is positively oriented, exactly, and each
/// region's cells have the volume within its facets.
void check_geometry(const Answer& answer, const Regions& regions, const FacetComplex& complex);

/// Volume that the complex's facets enclose, by region number.
std::vector<double> region_volumes(const FacetComplex& complex);

}  // namespace maille::modeler::tetgen
