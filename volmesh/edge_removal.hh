#pragma once

#include <array>
#include <optional>
#include <span>

#include "volmesh/tet_mesh.hh"

namespace maille::volmesh {

/// The cells round an edge: cell i has the ends and ring vertices i and i + 1, and (a, b, v[i], v[i + 1]) is
/// positively oriented. Closed inside the mesh, where vertex 0 follows the last one; open on the boundary.
struct EdgeRing {
    VertexHandle a;         ///< one end of the edge
    VertexHandle b;         ///< the other
    CellList cells;         ///< as many as there are vertices, one less where the ring is open
    VertexList vertices;    ///< of the ring
    bool is_closed = true;  ///< whether the edge is inside the mesh

    std::size_t size() const { return vertices.size(); }  ///< number of ring vertices
};

/// Nothing where the boundary isn't manifold at the edge.
std::optional<EdgeRing> edge_ring(const TetMesh& mesh, CellHandle c, int local_edge);

/// The places in the ring whose faces with the edge are interfaces (strata.hh): ascending.
boost::container::small_vector<std::uint32_t, 4> interface_places(const TetMesh& mesh, const EdgeRing& ring);

/// A triangle between ring vertices, ascending.
using RingTriangle = std::array<std::uint32_t, 3>;

/// Whether the edge can be removed, the polygon of its ring being filled with these triangles: they fill it,
/// every new cell is positively oriented (exactly), the edge is in no edge set, and interfaces at it are one
/// patch that goes on straight: its two faces are exchanged for the two on the other diagonal of their
/// quadrangle, the diagonals of which are at most `tolerance` apart.
bool is_edge_removal_ok(const TetMesh& mesh, const EdgeRing& ring, std::span<const RingTriangle> triangles,
                        double tolerance = 0);

/// Removes the edge: a ring of n vertices becomes 2 (n - 2) cells. n = 3 inside the mesh is the 3-2 flip, n =
/// 4 the 4-4 flip; n = 3 on the boundary the 2-2 flip. Sets and values pass on as retriangulation.hh says.
/// Precondition: is_edge_removal_ok. (The operation is due to E. Briere de L'Isle, P.-L. George,
/// "Optimization of tetrahedral meshes", 1995.)
void remove_edge(TetMesh& mesh, const EdgeRing& ring, std::span<const RingTriangle> triangles);

///@{
/// The 3-2 flip of an edge that has three cells round it.
bool is_flip_32_ok(const TetMesh& mesh, CellHandle c, int local_edge);
void flip_32(TetMesh& mesh, CellHandle c, int local_edge);
///@}

/// Which ring vertices the new edge of a 4-4 flip joins: 0 and 2, or 1 and 3.
enum class Diagonal : std::uint8_t { first, second };
///@{
/// The 4-4 flip of an edge with four cells.
bool is_flip_44_ok(const TetMesh& mesh, CellHandle c, int local_edge, Diagonal diagonal,
                   double tolerance = 0);
void flip_44(TetMesh& mesh, CellHandle c, int local_edge, Diagonal diagonal);
///@}

}  // namespace maille::volmesh
