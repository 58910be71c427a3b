#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "modeler/model.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::convergence {

/// A model whose measures are known from geometry alone.
struct Case {
    std::string name;    ///< of a file in the folder of examples, without ".csg"; else of the table's row
    std::string source;  ///< the model's text; empty: it is the example
    double size;         ///< edge length to begin with
    double volume;
    double area;
    /// Area of face sets (their names have a '/') and volume of cell sets.
    std::map<std::string, double> sets;
};

/// Every shipped example whose measures have a formula or an integral, and the basic round solids.
std::vector<Case> all_cases();

/// The case's model, without the sizes that it wishes for itself, so that one size rules.
modeler::Model model_of(const Case& c, const std::filesystem::path& examples);

/// Relative errors of a mesh of the case.
struct Errors {
    double volume = 0, area = 0;
    double worst_set = 0;  ///< greatest over the sets
    std::string worst_set_name;
};
/// Throws InputError where the mesh lacks one of the sets.
/// doesn't know.
Errors errors(const Case& c, const volmesh::TetMesh& mesh);

}  // namespace maille::convergence
