#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "modeler/geo_body.hh"
#include "modeler/lexer.hh"

namespace maille::modeler {

/// A primitive at its place. Solids that are used several times share theirs, and with it what it is called.
struct GeoLeaf {
    GeoBody body;
    Eigen::Affine3d map = Eigen::Affine3d::Identity();
    Location at{};
    std::string kind;    ///< "plane", ...
    std::string name{};  ///< by the solid that it was first a part of
    std::vector<std::string>
        sets{};       ///< of its own faces: bcname, or "bc" and a number; empty where none is given
    double size = 0;  ///< the smallest maxh; 0 where none is given
};

/// A solid: a primitive, or a boolean operation.
struct GeoNode {
    enum class Kind : std::uint8_t { leaf, all, any, complement } kind = Kind::leaf;
    std::shared_ptr<GeoLeaf> leaf{};
    std::vector<std::shared_ptr<const GeoNode>> children{};
};
using GeoSolid = std::shared_ptr<const GeoNode>;

/// A top-level object: a part of the mesh.
struct GeoObject {
    std::string name;
    Location at{};
    GeoSolid solid;
    std::string material{};
    double size = 0;
    std::map<const GeoLeaf*, std::string> sets{};  ///< instead of the leaves' own, by boundarycondition
};

/// What a .geo file of Netgen's says. Throws InputError with file, line and column.
std::vector<GeoObject> parse_geo(std::string_view text, const std::string& file);

/// Each leaf once, in the order of the text.
std::vector<GeoLeaf*> leaves_of(const GeoNode& solid);

}  // namespace maille::modeler
