#include "modeler/arrange_fill.hh"

#include <map>
#include <unordered_map>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace maille::modeler::detail {

namespace {

struct FaceState {
    std::uint32_t group = none;
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Exact>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceState, Exact,
                                              CGAL::Constrained_triangulation_face_base_2<Exact>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Exact,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

class Filler {
  public:
    Filler(const Cluster& cluster, const PointRegistry& registry) : cluster_(cluster), registry_(registry) {}

    Triangulation::Vertex_handle vertex(std::uint32_t point) {
        const auto [at, is_new] = vertices_.try_emplace(point);
        if (is_new) {
            at->second = triangulation_.insert(cluster_.projection(registry_[point]), hint());
            at->second->info() = point;
            latest_ = at->second;
        }
        return at->second;
    }

    void insert(const OutlineEdge& edge) {
        triangulation_.insert_constraint(vertex(edge.from), vertex(edge.to));
        group_left_of_[{edge.from, edge.to}] = edge.group;
    }

    std::vector<FilledTriangle> triangles() {
        std::vector<FilledTriangle> result;
        for (const auto face : triangulation_.finite_face_handles()) {
            const auto group = group_at_edges(face);
            if (group != none && face->info().group == none) flood(face, group);
        }
        for (const auto face : triangulation_.finite_face_handles())
            if (face->info().group != none)
                result.push_back({{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()},
                                  face->info().group});
        return result;
    }

  private:
    /// Where to start looking for the place of a point.
    Triangulation::Face_handle hint() const {
        return latest_ == Triangulation::Vertex_handle() ? Triangulation::Face_handle() : latest_->face();
    }

    std::uint32_t group_at_edges(Triangulation::Face_handle face) const {
        for (int k = 0; k < 3; ++k) {
            const auto at = group_left_of_.find({face->vertex(k)->info(), face->vertex((k + 1) % 3)->info()});
            if (at != group_left_of_.end()) return at->second;
        }
        return none;
    }

    void flood(Triangulation::Face_handle start, std::uint32_t group) {
        std::vector<Triangulation::Face_handle> stack{start};
        start->info().group = group;
        while (!stack.empty()) {
            const auto face = stack.back();
            stack.pop_back();
            for (int k = 0; k < 3; ++k) {
                const auto next = face->neighbor(k);
                if (face->is_constrained(k) || triangulation_.is_infinite(next) || next->info().group != none)
                    continue;
                next->info().group = group;
                stack.push_back(next);
            }
        }
    }

    const Cluster& cluster_;
    const PointRegistry& registry_;
    Triangulation triangulation_;
    Triangulation::Vertex_handle latest_{};
    std::unordered_map<std::uint32_t, Triangulation::Vertex_handle> vertices_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> group_left_of_;
};

}  // namespace

std::vector<FilledTriangle> fill(std::span<const OutlineEdge> outline, std::span<const std::uint32_t> points,
                                 const Cluster& cluster, const PointRegistry& registry) {
    Filler filler(cluster, registry);
    for (const OutlineEdge& edge : outline) filler.insert(edge);
    for (const auto point : points) filler.vertex(point);
    return filler.triangles();
}

}  // namespace maille::modeler::detail
