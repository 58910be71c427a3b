#include "quality/surface_error.hh"

#include <algorithm>
#include <limits>

#include "volmesh/strata.hh"

namespace maille::quality {

using volmesh::CellHandle;
using volmesh::HalffaceHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

SurfacePieces::SurfacePieces(const TetMesh& mesh, VertexHandle v, const volmesh::CellList& cells,
                             volmesh::FaceSurfaces& surfaces_of) {
    std::vector<Piece> edges;
    for (CellHandle c : cells) {
        const int at = mesh.local_vertex(c, v);
        for (int i = 0; i < 4; ++i) {
            const HalffaceHandle hf = TetMesh::halfface(c, i);
            const HalffaceHandle beyond = mesh.opposite_halfface_handle(hf);
            if (i == at || (beyond.is_valid() && beyond < hf) || !volmesh::is_interface(mesh, hf)) continue;
            Piece piece{{}, {}, surfaces_of(hf)};
            if (piece.surfaces.empty()) continue;
            for (VertexHandle w : mesh.halfface_vertices(hf)) {
                if (w == v) continue;
                piece.others.push_back(w);
                piece.corners.push_back(mesh.point(w));
                const auto known =
                    std::ranges::find_if(edges, [&](const Piece& edge) { return edge.others[0] == w; });
                if (known == edges.end())
                    edges.push_back({{w}, {mesh.point(w)}, piece.surfaces});
                else
                    volmesh::add(known->surfaces, piece.surfaces);
            }
            pieces_.push_back(std::move(piece));
        }
    }
    for (Piece& edge : edges)
        if (edge.surfaces.size() > 1) pieces_.push_back(std::move(edge));
}

double SurfacePieces::error(const Point& p, const volmesh::Projector& projector, VertexHandle without) const {
    double worst = 0;
    for (const Piece& piece : pieces_) {
        if (std::ranges::find(piece.others, without) != piece.others.end()) continue;
        Point middle = p;
        for (const Point& q : piece.corners) middle += q;
        middle /= static_cast<double>(piece.corners.size() + 1);
        worst = std::max(worst, distance_to(piece.surfaces, middle, projector));
    }
    return worst;
}

double distance_to(const Surfaces& surfaces, const Point& p, const volmesh::Projector& projector) {
    const auto there = projector.project({surfaces.data(), surfaces.size()}, p);
    return there ? (*there - p).norm() : std::numeric_limits<double>::infinity();
}

}  // namespace maille::quality
