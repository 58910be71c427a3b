#include "modeler/arrange_cut.hh"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

// Silences its advice to take Constrained_triangulation_plus_2: that keeps a hierarchy which nobody asks for.
#define CGAL_NO_CDT_2_WARNING
#include <CGAL/Constrained_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "modeler/arrange_flat_traits.hh"
#include "modeler/arrange_lines.hh"
#include "modeler/arrange_scene.hh"
#include "volmesh/union_find.hh"

namespace maille::modeler::detail {

namespace {

struct Number {
    std::uint32_t value = none;
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Number, FlatTraits>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<Number, FlatTraits,
                                              CGAL::Constrained_triangulation_face_base_2<FlatTraits>>;
using Triangulation =
    CGAL::Constrained_triangulation_2<FlatTraits, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                      CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Face = Triangulation::Face_handle;

/// A facet whose outline runs along an edge.
struct Rim {
    std::uint32_t facet;
    int side;              ///< 1 if the facet looks along the plane's normal, else -1
    bool is_left_of_rise;  ///< whether it lies on the left on the way from the lower end to the other
};

/// What a part is covered by. Facets that a dissolved edge joins count as one.
using Covers = std::vector<std::pair<std::uint32_t, int>>;

class PlaneCutter {
  public:
    PlaneCutter(const FacetComplex& complex, const ExactPositions& positions, const Contacts& contacts,
                std::span<const std::uint32_t> facets, PlaneCrossings& crossings, PointRegistry& registry)
        : complex_(complex),
          positions_(positions),
          contacts_(contacts),
          facets_(facets),
          crossings_(crossings),
          projection_(corner(facets[0], 0), corner(facets[0], 1), corner(facets[0], 2)),
          lines_(positions, projection_, supporting_plane(), crossings.plane_of(facets[0]), crossings,
                 registry),
          triangulation_(FlatTraits(known_)) {}

    void add_edges(std::span<const std::uint64_t> dissolved) {
        std::vector<int> sides;
        for (const auto f : facets_) sides.push_back(side_of(f));
        std::vector<std::uint64_t> joints;
        const std::vector<std::uint32_t> face_of = join_facets(dissolved, sides, joints);
        for (std::size_t i = 0; i < facets_.size(); ++i) {
            const auto& v = complex_.facets[facets_[i]].vertices;
            const int side = sides[i];
            for (std::size_t k = 0; k < 3; ++k) {
                const auto a = v[k], b = v[(k + 1) % 3];
                corners_.push_back(a);
                if (std::ranges::binary_search(joints, edge_key(a, b))) continue;
                const auto line = lines_.add(a, b);
                if (line == rims_of_line_.size()) {
                    rims_of_line_.emplace_back();
                    for (const auto& [edge, point] : contacts_.points_at(edge_key(a, b)))
                        lines_.put(line, point);
                }
                rims_of_line_[line].push_back({facets_[face_of[i]], side, (side == 1) == (a < b)});
            }
        }
    }

    void add_contacts() {
        const auto n_edges = lines_.size();
        for (const auto f : facets_)
            for (const auto& contact : contacts_.segments[f]) {
                if (contact.carrier != 0) {
                    const auto line = lines_.find(contact.carrier);
                    if (line < n_edges) {
                        for (const auto p : contact.ends) lines_.put(line, p);
                        continue;
                    }
                }
                if (contact.ends[0] == contact.ends[1])
                    corners_.push_back(contact.ends[0]);
                else
                    lines_.add(contact.ends[0], contact.ends[1], crossings_.plane_of(contact.other));
            }
    }

    void triangulate() {
        lines_.cut();
        for (std::uint32_t line = 0; line < lines_.size(); ++line)
            for (const auto p : lines_.points(line)) known_.put(number(p), line);
        for (const auto p : corners_) vertex(p);
        for (std::uint32_t line = 0; line < lines_.size(); ++line) {
            const auto points = lines_.points(line);
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                const auto a = points[i], b = points[i + 1];
                constrain(vertex(a), vertex(b));
                if (line >= rims_of_line_.size()) continue;
                auto& rims = rims_[edge_key(a, b)];
                // The line itself rises from its first point to its last.
                for (Rim rim : rims_of_line_[line]) {
                    rim.is_left_of_rise = rim.is_left_of_rise == (a < b);
                    rims.push_back(rim);
                }
            }
        }
    }

    PlaneCut parts() {
        PlaneCut cut{projection_, {}};
        // The first part is what lies around all facets.
        cut.parts.push_back({{}, flood(triangulation_.infinite_face())});
        for (const auto start : triangulation_.finite_face_handles())
            if (start->info().value == none) cut.parts.push_back({{}, flood(start)});
        cover(cut.parts);
        std::erase_if(cut.parts, [](const PlaneCut::Part& part) { return part.facets.empty(); });
        return cut;
    }

  private:
    const ExactPoint& corner(std::uint32_t facet, std::size_t k) const {
        return positions_.points[complex_.facets[facet].vertices[k]];
    }

    ExactPlane supporting_plane() const {
        const auto known = positions_.plane_of_facet[facets_[0]];
        if (known != none) return positions_.planes[known];
        return {corner(facets_[0], 0), corner(facets_[0], 1), corner(facets_[0], 2)};
    }

    /// 1 where the facet looks along the plane's normal, else -1.
    int side_of(std::uint32_t facet) {
        if (facet == facets_[0]) return 1;
        const auto& [a, b, c] = complex_.facets[facet].vertices;
        return CGAL::orientation(lines_.flat(a), lines_.flat(b), lines_.flat(c)) == CGAL::POSITIVE ? 1 : -1;
    }

    /// For each facet the first of those that dissolved edges join to it, by their places among the facets;
    /// and those edges, rising. Facets that fold back on each other are not joined.
    std::vector<std::uint32_t> join_facets(std::span<const std::uint64_t> dissolved,
                                           std::span<const int> sides,
                                           std::vector<std::uint64_t>& joints) const {
        volmesh::UnionFind joined(facets_.size());
        std::unordered_map<std::uint64_t, std::uint32_t> first_at;
        for (std::uint32_t i = 0; i < facets_.size(); ++i) {
            const auto& v = complex_.facets[facets_[i]].vertices;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto edge = edge_key(v[k], v[(k + 1) % 3]);
                if (!std::ranges::binary_search(dissolved, edge)) continue;
                const auto [at, is_first] = first_at.try_emplace(edge, i);
                if (is_first || sides[at->second] != sides[i]) continue;
                joined.unite(at->second, i);
                joints.push_back(edge);
            }
        }
        std::ranges::sort(joints);
        std::vector<std::uint32_t> result(facets_.size());
        for (std::uint32_t i = 0; i < result.size(); ++i) result[i] = joined.find(i);
        return result;
    }

    /// The point's number in the triangulation.
    std::uint32_t number(std::uint32_t point) {
        const auto [at, is_new] = numbers_.try_emplace(point, static_cast<std::uint32_t>(vertices_.size()));
        if (is_new) {
            vertices_.emplace_back();
            known_.add_point();
        }
        return at->second;
    }

    Triangulation::Vertex_handle vertex(std::uint32_t point) {
        const std::uint32_t n = number(point);
        if (vertices_[n] == Triangulation::Vertex_handle()) {
            const Face hint = latest_ == Triangulation::Vertex_handle() ? Face() : latest_->face();
            vertices_[n] = triangulation_.insert(FlatPoint(lines_.flat(point), n), hint);
            if (vertices_[n]->info().value != none)
                throw std::logic_error("two points of the arrangement are at one place");
            vertices_[n]->info().value = point;
        }
        latest_ = vertices_[n];
        return latest_;
    }

    /// Spares the general way where there is that edge already.
    void constrain(Triangulation::Vertex_handle a, Triangulation::Vertex_handle b) {
        Face face;
        int k = 0;
        if (!triangulation_.is_edge(a, b, face, k)) return triangulation_.insert_constraint(a, b);
        const Face beyond = face->neighbor(k);
        beyond->set_constraint(triangulation_.mirror_index(face, k), true);
        face->set_constraint(k, true);
    }

    /// The triangles that are reached without crossing a segment: the next part.
    std::vector<std::array<std::uint32_t, 3>> flood(Face start) {
        const auto number = static_cast<std::uint32_t>(borders_.size());
        auto& border = borders_.emplace_back();
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::vector<Face> stack{start};
        start->info().value = number;
        while (!stack.empty()) {
            const auto face = stack.back();
            stack.pop_back();
            if (!triangulation_.is_infinite(face))
                triangles.push_back({face->vertex(0)->info().value, face->vertex(1)->info().value,
                                     face->vertex(2)->info().value});
            for (int k = 0; k < 3; ++k) {
                const auto next = face->neighbor(k);
                if (face->is_constrained(k)) border.emplace_back(face, k);
                if (face->is_constrained(k) || next->info().value != none) continue;
                next->info().value = number;
                stack.push_back(next);
            }
        }
        return triangles;
    }

    /// Goes from part to part, beginning outside: what covers a part is what covers the one beside it, but
    /// for the facets that end at the edge between them.
    void cover(std::vector<PlaneCut::Part>& parts) const {
        std::vector<bool> is_known(parts.size(), false);
        std::vector<std::uint32_t> known{0};
        is_known[0] = true;
        for (std::size_t i = 0; i < known.size(); ++i)
            for (const auto& [face, k] : borders_[known[i]]) {
                const auto next = face->neighbor(k)->info().value;
                if (is_known[next]) continue;
                parts[next].facets = covers_beyond(parts[known[i]].facets, face, k);
                is_known[next] = true;
                known.push_back(next);
            }
    }

    Covers covers_beyond(Covers covers, Face face, int k) const {
        const auto from = face->vertex(Triangulation::ccw(k))->info().value,
                   to = face->vertex(Triangulation::cw(k))->info().value;
        const auto at = rims_.find(edge_key(from, to));
        if (at == rims_.end()) return covers;
        for (const Rim& rim : at->second) {
            const std::pair cover(rim.facet, rim.side);
            // This face is on the left of the edge, what lies beyond is on the right.
            if (rim.is_left_of_rise == (to < from)) {
                covers.push_back(cover);
                continue;
            }
            const auto ended = std::ranges::find(covers, cover);
            if (ended == covers.end())
                throw std::logic_error("a facet of the arrangement ends where it is not");
            covers.erase(ended);
        }
        return covers;
    }

    const FacetComplex& complex_;
    const ExactPositions& positions_;
    const Contacts& contacts_;
    std::span<const std::uint32_t> facets_;
    const PlaneCrossings& crossings_;
    Projection projection_;
    FlatLines lines_;
    std::vector<std::uint32_t> corners_;          ///< of facets, and points where others touch them
    std::vector<std::vector<Rim>> rims_of_line_;  ///< of the first lines, those that are edges
    std::unordered_map<std::uint64_t, std::vector<Rim>> rims_;
    KnownLines known_;
    Triangulation triangulation_;
    Triangulation::Vertex_handle latest_{};
    std::vector<std::vector<std::pair<Face, int>>>
        borders_;  ///< of the parts: constrained sides of triangles
    std::unordered_map<std::uint32_t, std::uint32_t> numbers_;  ///< of points of the registry, here
    std::vector<Triangulation::Vertex_handle> vertices_;
};

}  // namespace

PlaneCut cut_plane(const FacetComplex& complex, const ExactPositions& positions, const Contacts& contacts,
                   std::span<const std::uint32_t> facets, std::span<const std::uint64_t> dissolved,
                   PlaneCrossings& crossings, PointRegistry& registry) {
    PlaneCutter cutter(complex, positions, contacts, facets, crossings, registry);
    cutter.add_edges(dissolved);
    cutter.add_contacts();
    cutter.triangulate();
    return cutter.parts();
}

}  // namespace maille::modeler::detail
