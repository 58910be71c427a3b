#include "modeler/tessellate_refine.hh"

#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "modeler/projector_newton.hh"
#include "modeler/tessellate.hh"

namespace maille::modeler {
namespace {

using Mesh = volmesh::TriMesh;
using Vertex = Mesh::VertexHandle;
using Edge = Mesh::EdgeHandle;
using Face = Mesh::FaceHandle;

class Refiner {
  public:
    Refiner(Mesh& mesh, const Shape& shape, const Sizing& sizing, const Eigen::AlignedBox3d& box)
        : mesh_(mesh), shape_(shape), sizing_(sizing), box_(box) {}

    void run() {
        std::vector<Face> faces(mesh_.faces_begin(), mesh_.faces_end());
        while (!faces.empty()) {
            const Face face = faces.back();
            if (!is_too_large(face)) {
                faces.pop_back();
                continue;
            }
            const Vertex added = split(end_of_path(face));
            for (const Face f : mesh_.vf_range(added)) faces.push_back(f);
        }
    }

  private:
    bool is_too_large(Face f) const {
        Eigen::AlignedBox3d around;
        for (const Vertex v : mesh_.fv_range(f)) around.extend(mesh_.point(v));
        return around.intersects(box_) &&
               mesh_.calc_edge_length(longest_edge(f)) > sizing_.at(surface_of(mesh_, f), around.center());
    }

    /// Of edges as long as each other the last, so that paths from longer to longer edges end.
    Edge longest_edge(Face f) const {
        Edge longest;
        double length = -1;
        for (const Edge e : mesh_.fe_range(f)) {
            const double l = mesh_.calc_edge_sqr_length(e);
            if (std::pair(l, e.idx()) > std::pair(length, longest.idx()))
                std::tie(length, longest) = std::tuple(l, e);
        }
        return longest;
    }

    /// The edge that is the longest of both its triangles on the way from one to the next across longest
    /// edges.
    Edge end_of_path(Face f) const {
        for (;;) {
            const Edge e = longest_edge(f);
            const Face other = faces_of(e)[0] == f ? faces_of(e)[1] : faces_of(e)[0];
            if (longest_edge(other) == e) return e;
            f = other;
        }
    }

    std::array<Face, 2> faces_of(Edge e) const {
        return {mesh_.face_handle(mesh_.halfedge_handle(e, 0)),
                mesh_.face_handle(mesh_.halfedge_handle(e, 1))};
    }

    Vertex split(Edge e) {
        const Point middle = mesh_.calc_edge_midpoint(e);
        const auto [first, second] = faces_of(e);
        const std::array on{ShapeFace{&shape_, surface_of(mesh_, first)},
                            ShapeFace{&shape_, surface_of(mesh_, second)}};
        return mesh_.split_copy(e,
                                nearest_common_point(on, middle, mesh_.calc_edge_length(e)).value_or(middle));
    }

    Mesh& mesh_;
    const Shape& shape_;
    const Sizing& sizing_;
    const Eigen::AlignedBox3d& box_;
};

}  // namespace

void refine_within(Mesh& mesh, const Shape& shape, const Sizing& sizing, const Eigen::AlignedBox3d& box) {
    Refiner(mesh, shape, sizing, box).run();
}

}  // namespace maille::modeler
