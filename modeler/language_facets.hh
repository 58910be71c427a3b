#pragma once

#include "modeler/arguments.hh"
#include "modeler/model.hh"
#include "modeler/openscad_facets.hh"

namespace maille::modeler {

/// What `$fn`, `$fa` and `$fs` of a node say.
FacetSettings facet_settings(const Arguments& arguments);

/// Whether a round solid with these settings is OpenSCAD's polyhedron.
bool keeps_facets(Facets facets, const FacetSettings& settings);

/// A radius that may be given by its diameter instead.
double radius(const Arguments& arguments, std::string_view radius_name, std::string_view diameter_name);

/// The argument as radius or diameter; 1, as in OpenSCAD, where neither is given.
double radius_of_round(const Arguments& arguments);

}  // namespace maille::modeler
