#include "volmesh/overlap.hh"

#include <algorithm>

#include <Eigen/Geometry>

#include "volmesh/orientation.hh"
#include "volmesh/tet_topology.hh"

namespace maille::volmesh {
namespace {

using Tet = std::array<Point, 4>;
using Box = Eigen::AlignedBox3d;

/// On which sides of a plane a tetrahedron's vertices are.
struct Sides {
    bool has_positive = false, has_negative = false;

    Sides(const Point& p, const Point& q, const Point& r, const Tet& tet) {
        for (const Point& corner : tet) {
            if (corner == p || corner == q || corner == r) continue;  // exact arithmetic would tell
            const int side = orientation(p, q, r, corner);
            has_positive |= side > 0;
            has_negative |= side < 0;
            if (has_positive && has_negative) return;
        }
    }
    bool are_both() const { return has_positive && has_negative; }
    bool is_flat() const { return !has_positive && !has_negative; }
};

bool separates(const Point& p, const Point& q, const Point& r, const Tet& a, const Tet& b) {
    const Sides of_a(p, q, r, a);
    // Flat: the three points are on one line, and there is no plane.
    if (of_a.are_both() || of_a.is_flat()) return false;
    const Sides of_b(p, q, r, b);
    return !of_b.are_both() && of_a.has_positive != of_b.has_positive;
}

Box box_of(const Tet& tet) {
    Box box;
    for (const Point& p : tet) box.extend(p);
    return box;
}

}  // namespace

// Where two convex bodies with vertices don't overlap, one of the planes between them goes through three of
// the vertices (an extreme ray of the cone of all such planes): three of one's, or two of one's and one of
// the other's.
bool overlap(const Tet& a, const Tet& b) {
    if ((box_of(a).min().array() >= box_of(b).max().array()).any() ||
        (box_of(b).min().array() >= box_of(a).max().array()).any())
        return false;
    for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
        for (const auto& [i, j, k] : tet::face_vertices)
            if (separates((*one)[i], (*one)[j], (*one)[k], a, b)) return false;
    for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
        for (const auto& [i, j] : tet::edge_vertices)
            for (const Point& corner : *other)
                if (separates((*one)[i], (*one)[j], corner, a, b)) return false;
    return true;
}

std::vector<std::pair<CellHandle, CellHandle>> find_overlaps(const TetMesh& mesh, std::size_t most) {
    struct Entry {
        Box box;
        CellHandle cell;
    };
    std::vector<Entry> entries;
    for (const CellHandle c : mesh.cells()) entries.push_back({box_of(mesh.cell_points(c)), c});
    // Sorted along the axis on which the boxes are spread most, for their size.
    Box all;
    Point widths = Point::Zero();
    for (const Entry& entry : entries) {
        all.extend(entry.box);
        widths += entry.box.sizes();
    }
    int axis = 0;
    if (!entries.empty()) (all.sizes().array() / widths.array().max(1e-300)).maxCoeff(&axis);
    std::ranges::sort(entries, {}, [&](const Entry& e) { return std::pair(e.box.min()[axis], e.cell); });

    std::vector<std::pair<CellHandle, CellHandle>> found;
    std::vector<const Entry*> open;  // may reach on to what is yet to come
    for (const Entry& entry : entries) {
        std::erase_if(open, [&](const Entry* e) { return e->box.max()[axis] <= entry.box.min()[axis]; });
        for (const Entry* e : open)
            if (overlap(mesh.cell_points(e->cell), mesh.cell_points(entry.cell)))
                found.push_back(std::minmax(e->cell, entry.cell));
        open.push_back(&entry);
    }
    std::ranges::sort(found);
    if (found.size() > most) found.resize(most);
    return found;
}

}  // namespace maille::volmesh
