#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "modeler/arrange_box_tree.hh"
#include "modeler/arrange_classifier.hh"
#include "modeler/merge_interface.hh"
#include "modeler/merge_operand.hh"

namespace maille::modeler {

/// Where an interface touches a mesh.
struct TouchedCells {
    std::vector<volmesh::CellHandle> cells;  ///< those touched, each once
    std::vector<volmesh::CellHandle>
        near;                            ///< those that share a vertex with such a one, which are among them
    std::vector<std::uint8_t> vertices;  ///< by vertex: whether a touched cell has it
    std::vector<volmesh::HalffaceHandle> boundary;  ///< the mesh's, ascending
};

/// Finds the cells of operands that a facet of the interface touches other than as one of the operand's own
/// triangles, or that have a boundary face which is no facet.
///
/// Such a facet belongs to a piece of the interface that hangs together. Where the piece meets the mesh's
/// boundary, a boundary cell is touched; else it lies outside, or inside as a whole, which takes one walk to
/// find. From there on all touched cells hang together by their vertices. So the cost is that of the mesh's
/// surface and of the cells found, but for a byte a cell; all cells are tested only where a walk fails.
class TouchFinder {
  public:
    /// All that is given must outlive the finder.
    TouchFinder(std::span<const Operand> operands, const SolidClassifier& classifier,
                const FacetComplex& interface, const InterfaceTable& table);

    TouchedCells find(std::uint32_t operand) const;

  private:
    /// Facets that hang together.
    struct Piece {
        Eigen::Vector3d point;  ///< one of its
        Eigen::AlignedBox3d box;
        std::vector<std::uint32_t> inside;  ///< operands that have the point inside, ascending
    };
    class Search;

    void find_pieces(const SolidClassifier& classifier);

    std::span<const Operand> operands_;
    const FacetComplex& interface_;
    const InterfaceTable& table_;
    std::vector<Piece> pieces_;
    detail::BoxTree boxes_;
    double margin_;
};

}  // namespace maille::modeler
