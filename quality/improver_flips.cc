#include <algorithm>

#include "quality/improver.hh"
#include "volmesh/face_removal.hh"
#include "volmesh/strata.hh"

namespace maille::quality {
namespace {

using volmesh::EdgeRing;
using volmesh::HalffaceHandle;
using volmesh::RingTriangle;
using volmesh::TetMesh;
using volmesh::VertexHandle;

/// Rings of more vertices hardly ever give good cells.
constexpr std::size_t max_ring = 9;
/// A change of connectivity must gain this much.
constexpr double least_gain = 1e-3;

using Triangles = std::vector<RingTriangle>;
using Polygon = std::vector<std::uint32_t>;

/// The triangulation of a polygon of ring vertices whose worst new cell is best (G. T. Klincsek, "Minimal
/// triangulations of polygonal domains", 1980).
class BestTriangulation {
  public:
    BestTriangulation(const TetMesh& mesh, const EdgeRing& ring, Polygon polygon, double floor)
        : mesh_(mesh), ring_(ring), polygon_(std::move(polygon)), floor_(floor) {
        const std::size_t n = polygon_.size();
        for (std::size_t i = 0; i < n; ++i) at(i, (i + 1) % n).quality = best_of_none;
        for (std::size_t width = 2; width < n; ++width)
            for (std::size_t i = 0; i + width < n; ++i) fill(i, i + width);
    }

    /// -infinity where no triangulation is above the floor.
    double quality() { return at(0, polygon_.size() - 1).quality; }
    void append_triangles(Triangles& triangles) { append(0, polygon_.size() - 1, triangles); }

  private:
    static constexpr double best_of_none = std::numeric_limits<double>::infinity();
    struct Part {
        double quality = -best_of_none;
        std::size_t middle = 0;
    };

    Part& at(std::size_t i, std::size_t j) { return parts_[i * max_ring + j]; }

    void fill(std::size_t i, std::size_t j) {
        for (std::size_t k = i + 1; k < j; ++k) {
            const double bound = std::min(i + 1 == k ? best_of_none : at(i, k).quality,
                                          k + 1 == j ? best_of_none : at(k, j).quality);
            if (bound <= std::max(floor_, at(i, j).quality)) continue;
            const double quality =
                std::min(bound, cells_quality(i, k, j, std::max(floor_, at(i, j).quality)));
            if (quality > floor_ && quality > at(i, j).quality) at(i, j) = {quality, k};
        }
    }

    double cells_quality(std::size_t i, std::size_t j, std::size_t k, double enough) const {
        const Point& p = mesh_.point(ring_.vertices[polygon_[i]]);
        const Point& q = mesh_.point(ring_.vertices[polygon_[j]]);
        const Point& r = mesh_.point(ring_.vertices[polygon_[k]]);
        const double one = objective(mesh_.point(ring_.a), p, q, r);
        return one <= enough ? one : std::min(one, objective(p, q, r, mesh_.point(ring_.b)));
    }

    void append(std::size_t i, std::size_t j, Triangles& triangles) {
        if (i + 1 == j) return;
        const std::size_t k = at(i, j).middle;
        RingTriangle t{polygon_[i], polygon_[k], polygon_[j]};
        std::ranges::sort(t);
        triangles.push_back(t);
        append(i, k, triangles);
        append(k, j, triangles);
    }

    const TetMesh& mesh_;
    const EdgeRing& ring_;
    Polygon polygon_;
    double floor_;
    std::array<Part, max_ring * max_ring> parts_;
};

/// The polygons to be filled: the whole ring's, or those on both sides of an interface.
std::vector<Polygon> polygons(const TetMesh& mesh, const EdgeRing& ring) {
    const auto places = interface_places(mesh, ring);
    std::vector<Polygon> result(1);
    const auto n = static_cast<std::uint32_t>(ring.size());
    if (!ring.is_closed || places.empty()) {
        for (std::uint32_t i = 0; i < n; ++i) result[0].push_back(i);
    } else if (places.size() == 2) {
        result.resize(2);
        for (std::uint32_t i = places[0]; i <= places[1]; ++i) result[0].push_back(i);
        for (std::uint32_t i = places[1]; i <= places[0] + n; ++i) result[1].push_back(i % n);
    }
    return result;
}

/// The faces between two vertices a and b whose removal gives the best worst cell, growing from one face over
/// its sides.
class SandwichedFaces {
  public:
    SandwichedFaces(const TetMesh& mesh, HalffaceHandle first) : mesh_(mesh), faces{first} {
        a_ = apex(first);
        b_ = apex(mesh.opposite_halfface_handle(first));
        const auto v = mesh.halfface_vertices(first);
        for (int i = 0; i < 3; ++i) quality = std::min(quality, best_beyond(first, v[i], v[(i + 1) % 3], 0));
    }

  private:
    static constexpr int max_depth = 4;

    VertexHandle apex(HalffaceHandle hf) const {
        return mesh_.cell_vertex(TetMesh::incident_cell(hf), TetMesh::local_face(hf));
    }

    /// The face of a's cell beyond the side u-w of a face, if b is on its other side too.
    HalffaceHandle next_face(HalffaceHandle hf, VertexHandle u, VertexHandle w) const {
        const auto c = TetMesh::incident_cell(hf);
        const int third = 6 - TetMesh::local_face(hf) - mesh_.local_vertex(c, u) - mesh_.local_vertex(c, w);
        const HalffaceHandle wall = TetMesh::halfface(c, third);
        const HalffaceHandle beyond = mesh_.opposite_halfface_handle(wall);
        if (!beyond.is_valid() || volmesh::is_interface(mesh_, wall)) return {};
        const auto d = TetMesh::incident_cell(beyond);
        const HalffaceHandle next = TetMesh::halfface(d, mesh_.local_vertex(d, a_));
        const HalffaceHandle other = mesh_.opposite_halfface_handle(next);
        return other.is_valid() && apex(other) == b_ ? next : HalffaceHandle();
    }

    double best_beyond(HalffaceHandle hf, VertexHandle u, VertexHandle w, int depth) {
        const double direct = objective(mesh_.point(a_), mesh_.point(b_), mesh_.point(u), mesh_.point(w));
        const HalffaceHandle next = depth < max_depth ? next_face(hf, u, w) : HalffaceHandle();
        if (!next.is_valid() || std::ranges::find(faces, next) != faces.end()) return direct;
        const auto c = TetMesh::incident_cell(next);
        const int rest = 6 - TetMesh::local_face(next) - mesh_.local_vertex(c, u) - mesh_.local_vertex(c, w);
        const VertexHandle x = mesh_.cell_vertex(c, rest);
        const std::size_t n_before = faces.size();
        faces.push_back(next);
        double extended = best_beyond(next, u, x, depth + 1);
        if (extended > direct) extended = std::min(extended, best_beyond(next, x, w, depth + 1));
        if (extended > direct) return extended;
        faces.resize(n_before);
        return direct;
    }

    const TetMesh& mesh_;
    VertexHandle a_, b_;

  public:
    std::vector<HalffaceHandle> faces;
    double quality = std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<Improver::EdgeRemoval> Improver::edge_removal(CellHandle c, int edge, double floor) {
    if (mesh_.combination(c, edge) != 0) return std::nullopt;
    auto ring = volmesh::edge_ring(mesh_, c, edge);
    if (!ring || ring->size() < 3 || ring->size() > max_ring) return std::nullopt;
    EdgeRemoval removal{std::move(*ring), {}, std::numeric_limits<double>::infinity()};
    floor = std::max(floor, quality(removal.ring.cells) + least_gain);
    for (Polygon& polygon : polygons(mesh_, removal.ring)) {
        if (polygon.size() < 3) return std::nullopt;
        BestTriangulation best(mesh_, removal.ring, std::move(polygon), floor);
        removal.quality = std::min(removal.quality, best.quality());
        if (!(removal.quality > floor)) return std::nullopt;
        best.append_triangles(removal.triangles);
    }
    if (!keeps_size(removal) ||
        !volmesh::is_edge_removal_ok(mesh_, removal.ring, removal.triangles, removal_tolerance(removal)))
        return std::nullopt;
    return removal;
}

bool Improver::keeps_size(const EdgeRemoval& removal) const {
    if (!limit_.exists()) return true;
    const double most = excess(removal.ring.cells);
    return std::ranges::all_of(removal.triangles, [&](const RingTriangle& t) {
        std::array<Point, 4> cell;
        for (int i = 0; i < 3; ++i) cell[i] = mesh_.point(removal.ring.vertices[t[i]]);
        cell[3] = mesh_.point(removal.ring.a);
        if (limit_.excess(cell) > most) return false;
        cell[3] = mesh_.point(removal.ring.b);
        return limit_.excess(cell) <= most;
    });
}

// Where the surface is known, as far as the new faces are as near to it as the old ones; else only in a
// plane.
double Improver::removal_tolerance(const EdgeRemoval& removal) {
    const auto& ring = removal.ring;
    const auto places = interface_places(mesh_, ring);
    if (places.size() != 2) return 0;
    const Point& a = mesh_.point(ring.a);
    const Point& b = mesh_.point(ring.b);
    const Point& v = mesh_.point(ring.vertices[places[0]]);
    const Point& w = mesh_.point(ring.vertices[places[1]]);
    const double flat = 1e-10 * (b - a).norm();
    const CellHandle c = ring.cells[places[0]];
    const VertexHandle other = ring.vertices[(places[0] + 1) % ring.size()];
    const Surfaces surfaces = surfaces_of_(TetMesh::halfface(c, mesh_.local_vertex(c, other)));
    if (surfaces.empty()) return flat;
    const auto error = [&](const Point& p, const Point& q, const Point& r) {
        return distance_to(surfaces, (p + q + r) / 3, *projector_);
    };
    const auto middle_error = [&](const Point& p, const Point& q) {
        return distance_to(surfaces, (p + q) / 2, *projector_);
    };
    const double before = std::max({error(a, b, v), error(a, b, w), middle_error(a, b)});
    const double after = std::max({error(a, v, w), error(b, v, w), middle_error(v, w)});
    return after <= before + 1e-12 * projector_->model_size ? std::numeric_limits<double>::infinity() : flat;
}

std::optional<Improver::FaceRemoval> Improver::face_removal(CellHandle c, int face, double floor) {
    const HalffaceHandle hf = TetMesh::halfface(c, face);
    if (volmesh::is_interface(mesh_, hf)) return std::nullopt;
    const SandwichedFaces best(mesh_, hf);
    if (!(best.quality > floor)) return std::nullopt;
    CellList cells;
    for (HalffaceHandle side : best.faces) {
        cells.push_back(TetMesh::incident_cell(side));
        cells.push_back(TetMesh::incident_cell(mesh_.opposite_halfface_handle(side)));
    }
    if (!(best.quality > quality(cells) + least_gain) || !volmesh::is_face_removal_ok(mesh_, best.faces))
        return std::nullopt;
    if (limit_.exists()) {
        const Point a = mesh_.point(mesh_.cell_vertex(c, face));
        const HalffaceHandle beyond = mesh_.opposite_halfface_handle(hf);
        const Point b =
            mesh_.point(mesh_.cell_vertex(TetMesh::incident_cell(beyond), TetMesh::local_face(beyond)));
        const double most = excess(cells);
        for (HalffaceHandle side : best.faces) {
            const auto v = mesh_.halfface_vertices(side);
            for (int i = 0; i < 3; ++i)
                if (limit_.excess({a, b, mesh_.point(v[i]), mesh_.point(v[(i + 1) % 3])}) > most)
                    return std::nullopt;
        }
    }
    return FaceRemoval{best.faces, best.quality};
}

bool Improver::flip(CellHandle c) {
    std::optional<EdgeRemoval> best_edge;
    std::optional<FaceRemoval> best_face;
    double floor = shapes_[c.idx()].objective + least_gain;
    for (int e = 0; e < 6; ++e)
        if (auto found = edge_removal(c, e, floor)) {
            floor = found->quality;
            best_edge = std::move(found);
        }
    for (int f = 0; f < 4; ++f)
        if (auto found = face_removal(c, f, floor)) {
            floor = found->quality;
            best_face = std::move(found);
        }
    const std::uint32_t n_before = mesh_.n_cells();
    if (best_face) {
        CellList cells;
        for (HalffaceHandle side : best_face->faces) {
            cells.push_back(TetMesh::incident_cell(side));
            cells.push_back(TetMesh::incident_cell(mesh_.opposite_halfface_handle(side)));
        }
        volmesh::remove_faces(mesh_, best_face->faces);
        ++result_.face_removals;
        settle(cells, n_before);
    } else if (best_edge) {
        volmesh::remove_edge(mesh_, best_edge->ring, best_edge->triangles);
        ++result_.edge_removals;
        settle(best_edge->ring.cells, n_before);
    }
    return best_edge || best_face;
}

}  // namespace maille::quality
