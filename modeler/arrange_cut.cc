#include "modeler/arrange_cut.hh"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <unordered_map>

// Silences its advice to take Constrained_triangulation_plus_2: that keeps a hierarchy which nobody asks for.
#define CGAL_NO_CDT_2_WARNING
#include <CGAL/Constrained_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "modeler/arrange_scene.hh"

namespace maille::modeler::detail {

namespace {

struct Number {
    std::uint32_t value = none;
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Number, Exact>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<Number, Exact,
                                              CGAL::Constrained_triangulation_face_base_2<Exact>>;
using Triangulation =
    CGAL::Constrained_triangulation_2<Exact, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                      CGAL::Exact_intersections_tag>;
using Point2 = Exact::Point_2;

/// A facet in the plane's image.
struct FlatFacet {
    std::uint32_t facet;
    int side;                       ///< 1 if it runs counter-clockwise
    std::array<Point2, 3> corners;  ///< counter-clockwise
    CGAL::Bbox_2 box;
};

class PlaneCutter {
  public:
    PlaneCutter(const FacetComplex& complex, const ExactPositions& positions,
                std::span<const std::uint32_t> facets, PointRegistry& registry)
        : complex_(complex),
          positions_(positions),
          facets_(facets),
          registry_(registry),
          projection_(corner(facets[0], 0), corner(facets[0], 1), corner(facets[0], 2)) {}

    void insert_facets(std::span<const std::uint64_t> dissolved) {
        for (const auto f : facets_) {
            const auto& v = complex_.facets[f].vertices;
            for (const auto p : v) vertex(p);
            for (std::size_t k = 0; k < 3; ++k) {
                const auto a = v[k], b = v[(k + 1) % 3];
                if (!std::ranges::binary_search(dissolved, edge_key(a, b))) insert({a, b});
            }
        }
    }

    void insert(const Contacts::Segment& segment) {
        const auto a = vertex(segment[0]), b = vertex(segment[1]);
        if (a != b) triangulation_.insert_constraint(a, b);
    }

    /// Numbers the points in which segments cross.
    void register_crossings() {
        std::optional<ExactPlane> plane;
        for (const auto v : triangulation_.finite_vertex_handles()) {
            if (v->info().value != none) continue;
            if (!plane) plane = supporting_plane();
            v->info().value = registry_.add(projection_.lift(v->point(), *plane));
        }
    }

    PlaneCut parts() {
        PlaneCut cut{projection_, {}};
        const std::vector<FlatFacet> flat = flat_facets();
        for (const auto start : triangulation_.finite_face_handles()) {
            if (start->info().value != none) continue;
            PlaneCut::Part part;
            part.triangles = flood(start, static_cast<std::uint32_t>(cut.parts.size()));
            part.facets =
                flat.size() == 1 ? std::vector{std::pair(flat[0].facet, 1)} : facets_at(start, flat);
            cut.parts.push_back(std::move(part));
        }
        std::erase_if(cut.parts, [](const PlaneCut::Part& part) { return part.facets.empty(); });
        return cut;
    }

  private:
    /// Where to start looking for the place of a point.
    Triangulation::Face_handle hint() const {
        return latest_ == Triangulation::Vertex_handle() ? Triangulation::Face_handle() : latest_->face();
    }

    const ExactPoint& corner(std::uint32_t facet, std::size_t k) const {
        return positions_.points[complex_.facets[facet].vertices[k]];
    }

    Triangulation::Vertex_handle vertex(std::uint32_t point) {
        const auto [at, is_new] = vertices_.try_emplace(point);
        if (is_new) {
            at->second = triangulation_.insert(projection_(registry_[point]), hint());
            at->second->info().value = point;
            latest_ = at->second;
        }
        return at->second;
    }

    ExactPlane supporting_plane() const {
        const auto known = positions_.plane_of_facet[facets_[0]];
        if (known != none) return positions_.planes[known];
        return {corner(facets_[0], 0), corner(facets_[0], 1), corner(facets_[0], 2)};
    }

    /// The triangles that are reached without crossing a segment.
    std::vector<std::array<std::uint32_t, 3>> flood(Triangulation::Face_handle start, std::uint32_t number) {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::vector<Triangulation::Face_handle> stack{start};
        start->info().value = number;
        while (!stack.empty()) {
            const auto face = stack.back();
            stack.pop_back();
            triangles.push_back({face->vertex(0)->info().value, face->vertex(1)->info().value,
                                 face->vertex(2)->info().value});
            for (int k = 0; k < 3; ++k) {
                const auto next = face->neighbor(k);
                if (face->is_constrained(k) || triangulation_.is_infinite(next) || next->info().value != none)
                    continue;
                next->info().value = number;
                stack.push_back(next);
            }
        }
        return triangles;
    }

    std::vector<FlatFacet> flat_facets() const {
        std::vector<FlatFacet> result;
        for (const auto f : facets_) {
            FlatFacet flat{
                f, 1, {projection_(corner(f, 0)), projection_(corner(f, 1)), projection_(corner(f, 2))}, {}};
            if (facets_.size() > 1 &&
                CGAL::orientation(flat.corners[0], flat.corners[1], flat.corners[2]) == CGAL::NEGATIVE) {
                flat.side = -1;
                std::swap(flat.corners[1], flat.corners[2]);
            }
            flat.box = flat.corners[0].bbox() + flat.corners[1].bbox() + flat.corners[2].bbox();
            result.push_back(flat);
        }
        return result;
    }

    /// The facets that hold a triangle, found by a point inside that is on no edge of any of them.
    static std::vector<std::pair<std::uint32_t, int>> facets_at(Triangulation::Face_handle face,
                                                                const std::vector<FlatFacet>& flat) {
        for (int attempt = 0; attempt < 100; ++attempt) {
            const double u = 5 + attempt, v = 7 + 3 * attempt, w = 11 + 2 * attempt;
            const Point2 sample =
                CGAL::barycenter(face->vertex(0)->point(), Exact::FT(u), face->vertex(1)->point(),
                                 Exact::FT(v), face->vertex(2)->point(), Exact::FT(w));
            if (auto found = facets_at(sample, flat)) return *found;
        }
        throw std::logic_error("the arrangement found no point inside a part of a plane");
    }

    static std::optional<std::vector<std::pair<std::uint32_t, int>>> facets_at(
        const Point2& sample, const std::vector<FlatFacet>& flat) {
        std::vector<std::pair<std::uint32_t, int>> result;
        const CGAL::Bbox_2 box = sample.bbox();
        for (const FlatFacet& f : flat) {
            if (!CGAL::do_overlap(f.box, box)) continue;
            bool is_inside = true;
            for (std::size_t k = 0; k < 3 && is_inside; ++k) {
                const auto side = CGAL::orientation(f.corners[k], f.corners[(k + 1) % 3], sample);
                if (side == CGAL::ZERO) return std::nullopt;
                is_inside = side == CGAL::POSITIVE;
            }
            if (is_inside) result.emplace_back(f.facet, f.side);
        }
        return result;
    }

    const FacetComplex& complex_;
    const ExactPositions& positions_;
    std::span<const std::uint32_t> facets_;
    PointRegistry& registry_;
    Projection projection_;
    Triangulation triangulation_;
    Triangulation::Vertex_handle latest_{};
    std::unordered_map<std::uint32_t, Triangulation::Vertex_handle> vertices_;
};

}  // namespace

PlaneCut cut_plane(const FacetComplex& complex, const ExactPositions& positions, const Contacts& contacts,
                   std::span<const std::uint32_t> facets, std::span<const std::uint64_t> dissolved,
                   PointRegistry& registry) {
    PlaneCutter cutter(complex, positions, facets, registry);
    cutter.insert_facets(dissolved);
    for (const auto f : facets)
        for (const auto& segment : contacts.segments[f]) cutter.insert(segment);
    cutter.register_crossings();
    return cutter.parts();
}

}  // namespace maille::modeler::detail
