#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "modeler/facet_complex.hh"
#include "volmesh/tet_mesh.hh"
#include "volmesh/tri_mesh.hh"

namespace maille::modeler {

/// How to fill a solid.
struct TetrahedralizeOptions {
    /// Seconds of processor time that one run of TetGen may take, a third of it after each that took longer;
    /// 0: by the expected number of cells.
    double time_limit = 0;
    /// What is meshed, for messages: "cube1".
    std::string name = "the solid";
};

/// A tetrahedral mesh of a complex of facets.
struct ComplexMesh {
    std::vector<Eigen::Vector3d> points;              ///< the complex's, bit by bit, then new ones
    std::vector<std::array<std::uint32_t, 4>> cells;  ///< positively oriented
    std::vector<Region> regions;                      ///< of each cell
    std::vector<std::array<std::uint32_t, 4>>
        neighbors;  ///< the cell beyond the face opposite each vertex, if any
    std::vector<std::array<std::uint32_t, 3>> facets;  ///< the faces that lie on the complex's facets
    std::vector<std::uint32_t> parents;  ///< the complex's facet that each of these is a part of
};

/// The cells with their vertices and neighbours, as a mesh stores them. Throws InputError where those that
/// are neighbours don't have three vertices in common.
volmesh::Column<volmesh::TetMesh::Cell> linked_cells(const ComplexMesh& mesh);

/// Fills every region of the complex with tetrahedra whose edges are about as long as its entry in `sizes`,
/// by region number; places with a negative region stay empty. Points of the complex that are close together
/// give smaller tetrahedra around them. The facets become faces of the mesh as they are; only where TetGen
/// cannot do that, and no facet is frozen, they are split.
///
/// TetGen runs in a process of its own. When it fails, the attempt is repeated in other ways (points shifted
/// by a 1e-10 or 1e-8 of the diagonal and put back afterwards, facets split, no refinement); each attempt
/// that failed is told in `warnings`. What comes back is verified: points bit by bit, orientations exactly,
/// facets complete, regions consistent, their volumes those within their facets.
///
/// Preconditions: facets name existing points, every point is used, the complex does not intersect itself.
/// Throws InputError with all reasons where every attempt failed.
ComplexMesh tetrahedralize(const FacetComplex& complex, std::span<const double> sizes,
                           const TetrahedralizeOptions& options = {},
                           std::vector<std::string>* warnings = nullptr);

/// The mesh of the solid within a closed surface, oriented outwards; its boundary faces are the surface's
/// triangles, its first vertices the surface's vertices, under the same numbers. Throws InputError as above.
volmesh::TetMesh tetrahedralize(const volmesh::TriMesh& surface, double size,
                                const TetrahedralizeOptions& options = {},
                                std::vector<std::string>* warnings = nullptr);

}  // namespace maille::modeler
