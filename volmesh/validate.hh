#pragma once

#include <string>
#include <vector>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// What is wrong with a mesh, in words; nothing where it is right.
struct Validation {
    std::vector<std::string> errors;  ///< at most `max_errors` in full, then their number
    /// Whether nothing is wrong.
    bool ok() const { return errors.empty(); }
};

/// Checks that the mesh is conforming (each face has one or two cells, on opposite sides; every neighbour
/// link is mutual), that every cell is positively oriented (exactly), that the boundary is closed, that
/// incidences are true (vertex to cell, edge and face numbers, fans), that edges' and faces' sets agree in
/// all their cells and that properties have their sizes. Cost: some ten passes over the mesh.
Validation validate(const TetMesh& mesh, std::size_t max_errors = 20);

}  // namespace maille::volmesh
