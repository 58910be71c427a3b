#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modeler/geo_body.hh"
#include "modeler/geo_scanner.hh"

namespace maille::modeler {

struct GeoCurves {
    std::map<std::string, GeoCurve<2>, std::less<>> flat;
    std::map<std::string, GeoCurve<3>, std::less<>> spatial;
};

/// What stands after `curve2d name =` or `curve3d name =`, parentheses included.
template <int N>
GeoCurve<N> read_geo_curve(GeoScanner& scanner);

/// The primitive of that kind, whose parentheses come next; nothing where the word names none.
std::optional<GeoBody> read_geo_primitive(std::string_view kind, GeoScanner& scanner,
                                          const GeoCurves& curves);
std::vector<std::string_view> geo_primitive_names();

}  // namespace maille::modeler
