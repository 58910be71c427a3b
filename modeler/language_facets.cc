#include "modeler/language_facets.hh"

#include <fmt/format.h>

#include "modeler/makes_nothing.hh"

namespace maille::modeler {

FacetSettings facet_settings(const Arguments& arguments) {
    const FacetSettings usual;
    return {.fn = arguments.number("$fn", usual.fn),
            .fa = arguments.number("$fa", usual.fa),
            .fs = arguments.number("$fs", usual.fs)};
}

bool keeps_facets(Facets facets, const FacetSettings& settings) {
    switch (facets) {
        case Facets::keep:
            return true;
        case Facets::round:
            return false;
        case Facets::automatic:
            break;
    }
    constexpr double least_prism = 3;
    constexpr double most_prism = 8;
    return settings.fn >= least_prism && settings.fn <= most_prism;
}

double radius(const Arguments& arguments, std::string_view radius_name, std::string_view diameter_name) {
    if (!arguments.has(diameter_name)) return arguments.number(radius_name);
    if (arguments.has(radius_name))
        throw arguments.error(diameter_name,
                              fmt::format("give '{}' or '{}', not both", radius_name, diameter_name));
    return arguments.number(diameter_name) / 2;
}

double radius_of_round(const Arguments& arguments) {
    const bool given = arguments.has("r") || arguments.has("d");
    const double r = given ? radius(arguments, "r", "d") : 1;
    if (!(r > 0))
        throw MakesNothing(
            arguments.error(arguments.has("d") ? "d" : "r", "the radius must be greater than 0"));
    return r;
}

}  // namespace maille::modeler
