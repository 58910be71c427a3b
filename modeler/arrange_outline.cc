#include "modeler/arrange_outline.hh"

#include <map>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "modeler/arrange_kernel.hh"

namespace maille::modeler::detail {

namespace {

struct FaceState {
    std::uint32_t region = none;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceState, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Face = Triangulation::Face_handle;

class Triangulator {
  public:
    void insert_points(std::span<const Eigen::Vector2d> points) {
        Face hint;
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            const auto vertex = triangulation_.insert({points[i].x(), points[i].y()}, hint);
            if (triangulation_.number_of_vertices() == i) coincide_ = true;
            vertex->info() = i;
            vertices_.push_back(vertex);
            hint = vertex->face();
        }
    }

    void insert_segment(std::uint32_t from, std::uint32_t to) {
        triangulation_.insert_constraint(vertices_[from], vertices_[to]);
    }

    void insert_outline(std::span<const FlatEdge> outline) {
        for (const FlatEdge& edge : outline) {
            insert_segment(edge.from, edge.to);
            outline_[{edge.from, edge.to}] = edge.region;
        }
    }

    std::optional<std::vector<FlatTriangle>> triangles() {
        if (coincide_) return std::nullopt;
        std::size_t n_met = 0;
        for (const Face face : triangulation_.finite_face_handles())
            for (int k = 0; k < 3; ++k)
                if (const auto at = outline_.find(edge(face, k)); at != outline_.end()) {
                    ++n_met;
                    if (!flood(face, at->second)) return std::nullopt;
                }
        if (n_met != outline_.size()) return std::nullopt;
        std::vector<FlatTriangle> result;
        for (const Face face : triangulation_.finite_face_handles())
            if (face->info().region != none)
                result.push_back({{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()},
                                  face->info().region});
        return result;
    }

  private:
    using Edge = std::pair<std::uint32_t, std::uint32_t>;

    /// The side of a face across from its vertex k, with the face on its left.
    static Edge edge(Face face, int k) {
        return {face->vertex((k + 1) % 3)->info(), face->vertex((k + 2) % 3)->info()};
    }

    /// Gives what hangs together without crossing an outline to the region. Says whether that is a
    /// contradiction.
    bool flood(Face start, std::uint32_t region) {
        if (start->info().region != none) return start->info().region == region;
        std::vector<Face> stack{start};
        start->info().region = region;
        while (!stack.empty()) {
            const Face face = stack.back();
            stack.pop_back();
            for (int k = 0; k < 3; ++k) {
                const auto [from, to] = edge(face, k);
                if (outline_.contains({from, to})) continue;
                const Face next = face->neighbor(k);
                if (triangulation_.is_infinite(next) || outline_.contains({to, from})) return false;
                if (next->info().region == region) continue;
                if (next->info().region != none) return false;
                next->info().region = region;
                stack.push_back(next);
            }
        }
        return true;
    }

    Triangulation triangulation_;
    std::vector<Triangulation::Vertex_handle> vertices_;
    std::map<Edge, std::uint32_t> outline_;  ///< by its ends: the region on its left
    bool coincide_ = false;
};

}  // namespace

std::optional<std::vector<FlatTriangle>> triangulate(std::span<const Eigen::Vector2d> points,
                                                     std::span<const FlatEdge> outline,
                                                     std::span<const std::array<std::uint32_t, 2>> kept) {
    Triangulator triangulator;
    try {
        triangulator.insert_points(points);
        triangulator.insert_outline(outline);
        for (const auto& [from, to] : kept) triangulator.insert_segment(from, to);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
        return std::nullopt;
    }
    return triangulator.triangles();
}

}  // namespace maille::modeler::detail
