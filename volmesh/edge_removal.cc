#include "volmesh/edge_removal.hh"

#include <algorithm>
#include <map>
#include <stdexcept>

#include <Eigen/Geometry>

#include "volmesh/orientation.hh"
#include "volmesh/retriangulation.hh"
#include "volmesh/strata.hh"

namespace maille::volmesh {
namespace {

/// Whether the local numbers are an even permutation of 0 1 2 3.
bool is_even(int i, int j, int k, int l) {
    return ((i > j) + (i > k) + (i > l) + (j > k) + (j > l) + (k > l)) % 2 == 0;
}

/// The half-face with the edge and ring vertex `place`.
HalffaceHandle ring_face(const TetMesh& mesh, const EdgeRing& ring, std::size_t place) {
    const bool is_after_last = place == ring.cells.size();
    const CellHandle c = ring.cells[is_after_last ? place - 1 : place];
    const VertexHandle apex = ring.vertices[is_after_last ? place - 1 : (place + 1) % ring.size()];
    return TetMesh::halfface(c, mesh.local_vertex(c, apex));
}

/// Whether the triangles fill the polygon: each side is once theirs, each other edge twice.
bool is_triangulation(std::span<const RingTriangle> triangles, std::uint32_t n) {
    if (n < 3 || triangles.size() != n - 2) return false;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    for (const auto& [i, j, k] : triangles) {
        if (!(i < j && j < k && k < n)) return false;
        ++count[{i, j}];
        ++count[{j, k}];
        ++count[{i, k}];
    }
    std::size_t n_sides = 0;
    for (const auto& [edge, times] : count) {
        const bool is_side = edge.second - edge.first == 1 || edge.second - edge.first == n - 1;
        if (times != (is_side ? 1 : 2)) return false;
        n_sides += is_side;
    }
    return n_sides == n;
}

/// How far the lines a-b and c-d are apart.
double distance_of_lines(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point normal = (b - a).cross(d - c);
    const double length = normal.norm();
    return length > 0 ? std::abs(normal.dot(c - a)) / length : 0;
}

bool has_edge(const TetMesh& mesh, VertexHandle v, VertexHandle w) {
    return std::ranges::any_of(mesh.vc_range(v), [&](CellHandle c) { return mesh.local_vertex(c, w) >= 0; });
}

bool is_on_side(const RingTriangle& t, std::uint32_t first, std::uint32_t last) {
    return t[0] >= first && t[2] <= last;
}

/// What interfaces at the edge ask for.
bool are_interfaces_ok(const TetMesh& mesh, const EdgeRing& ring, std::span<const RingTriangle> triangles,
                       double tolerance) {
    const auto places = interface_places(mesh, ring);
    if (places.empty()) return true;
    if (places.size() != 2) return false;
    const auto [first, second] = std::pair(places[0], places[1]);
    if (!is_same_patch(mesh, ring_face(mesh, ring, first), ring_face(mesh, ring, second))) return false;
    const VertexHandle v = ring.vertices[first];
    const VertexHandle w = ring.vertices[second];
    if (!(distance_of_lines(mesh.point(ring.a), mesh.point(ring.b), mesh.point(v), mesh.point(w)) <=
          tolerance))
        return false;
    if (!ring.is_closed) return !has_edge(mesh, v, w);
    return second - first > 1 && first + ring.size() - second > 1 &&
           std::ranges::all_of(triangles, [&](const RingTriangle& t) {
               return is_on_side(t, first, second) ||
                      std::ranges::all_of(t, [&](auto i) { return i <= first || i >= second; });
           });
}

EdgeRing ring_of(const TetMesh& mesh, CellHandle c, int local_edge) {
    auto ring = edge_ring(mesh, c, local_edge);
    if (!ring) throw std::invalid_argument("the boundary isn't manifold at this edge");
    return std::move(*ring);
}

constexpr std::array<RingTriangle, 1> only_triangle{{{0, 1, 2}}};

std::array<RingTriangle, 2> triangles_at(Diagonal diagonal) {
    if (diagonal == Diagonal::first) return {{{0, 1, 2}, {0, 2, 3}}};
    return {{{0, 1, 3}, {1, 2, 3}}};
}

}  // namespace

std::optional<EdgeRing> edge_ring(const TetMesh& mesh, CellHandle c, int local_edge) {
    const auto [i, j] = tet::edge_vertices[local_edge];
    EdgeRing ring{mesh.cell_vertex(c, i), mesh.cell_vertex(c, j), mesh.cells_around(c, local_edge), {}};
    const auto ends = [&](CellHandle cell) {
        const int a = mesh.local_vertex(cell, ring.a);
        const int b = mesh.local_vertex(cell, ring.b);
        const auto [k, l] = tet::edge_vertices[tet::opposite_edge(tet::edge_between[a][b])];
        return is_even(a, b, k, l) ? std::pair(mesh.cell_vertex(cell, k), mesh.cell_vertex(cell, l))
                                   : std::pair(mesh.cell_vertex(cell, l), mesh.cell_vertex(cell, k));
    };
    const std::size_t n = ring.cells.size();
    if (n > 1 && ends(ring.cells[0]).second != ends(ring.cells[1]).first)
        std::reverse(ring.cells.begin(), ring.cells.end());
    for (CellHandle cell : ring.cells) ring.vertices.push_back(ends(cell).first);
    for (std::size_t at = 0; at + 1 < n; ++at)
        if (ends(ring.cells[at]).second != ring.vertices[at + 1]) return std::nullopt;
    const VertexHandle last = ends(ring.cells.back()).second;
    ring.is_closed = last == ring.vertices.front();
    if (!ring.is_closed) ring.vertices.push_back(last);
    return ring;
}

boost::container::small_vector<std::uint32_t, 4> interface_places(const TetMesh& mesh, const EdgeRing& ring) {
    boost::container::small_vector<std::uint32_t, 4> places;
    for (std::uint32_t i = 0; i < ring.size(); ++i)
        if (is_interface(mesh, ring_face(mesh, ring, i))) places.push_back(i);
    return places;
}

bool is_edge_removal_ok(const TetMesh& mesh, const EdgeRing& ring, std::span<const RingTriangle> triangles,
                        double tolerance) {
    const CellHandle c = ring.cells.front();
    if (mesh.combination(c, mesh.local_edge(c, ring.a, ring.b)) != 0) return false;
    if (!is_triangulation(triangles, static_cast<std::uint32_t>(ring.size()))) return false;
    if (!are_interfaces_ok(mesh, ring, triangles, tolerance)) return false;
    const Point& a = mesh.point(ring.a);
    const Point& b = mesh.point(ring.b);
    return std::ranges::all_of(triangles, [&](const RingTriangle& t) {
        const Point& p = mesh.point(ring.vertices[t[0]]);
        const Point& q = mesh.point(ring.vertices[t[1]]);
        const Point& r = mesh.point(ring.vertices[t[2]]);
        return orientation(a, p, q, r) > 0 && orientation(p, q, r, b) > 0;
    });
}

void remove_edge(TetMesh& mesh, const EdgeRing& ring, std::span<const RingTriangle> triangles) {
    Retriangulation change{.old_cells = ring.cells, .new_cells = {}};
    const auto places = interface_places(mesh, ring);
    for (const RingTriangle& t : triangles) {
        // Cell t[0] lies on the triangle's side of the interface, unless that is the side with the ring's
        // end.
        const bool is_beyond = !places.empty() && !is_on_side(t, places[0], places[1]);
        const CellHandle parent = ring.cells[is_beyond ? t[2] : t[0]];
        const VertexHandle p = ring.vertices[t[0]];
        const VertexHandle q = ring.vertices[t[1]];
        const VertexHandle r = ring.vertices[t[2]];
        change.new_cells.push_back({{ring.a, p, q, r}, parent});
        change.new_cells.push_back({{p, q, r, ring.b}, parent});
    }
    if (!places.empty()) {
        const VertexHandle v = ring.vertices[places[0]];
        const VertexHandle w = ring.vertices[places[1]];
        change.new_faces.push_back({{ring.a, v, w}, ring_face(mesh, ring, places[0])});
        change.new_faces.push_back({{ring.b, v, w}, ring_face(mesh, ring, places[1])});
    }
    mesh.replace_cells(change);
}

bool is_flip_32_ok(const TetMesh& mesh, CellHandle c, int local_edge) {
    const auto ring = edge_ring(mesh, c, local_edge);
    return ring && ring->is_closed && ring->size() == 3 && is_edge_removal_ok(mesh, *ring, only_triangle);
}

void flip_32(TetMesh& mesh, CellHandle c, int local_edge) {
    remove_edge(mesh, ring_of(mesh, c, local_edge), only_triangle);
}

bool is_flip_44_ok(const TetMesh& mesh, CellHandle c, int local_edge, Diagonal diagonal, double tolerance) {
    const auto ring = edge_ring(mesh, c, local_edge);
    return ring && ring->is_closed && ring->size() == 4 &&
           is_edge_removal_ok(mesh, *ring, triangles_at(diagonal), tolerance);
}

void flip_44(TetMesh& mesh, CellHandle c, int local_edge, Diagonal diagonal) {
    remove_edge(mesh, ring_of(mesh, c, local_edge), triangles_at(diagonal));
}

}  // namespace maille::volmesh
