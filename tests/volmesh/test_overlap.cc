#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "volmesh/measure.hh"
#include "volmesh/orientation.hh"
#include "volmesh/overlap.hh"

using namespace maille;
using namespace maille::volmesh;

namespace {

using Tet = std::array<Point, 4>;

Tet random_tet(std::mt19937& random, double spread) {
    std::uniform_real_distribution<double> place(0, 1);
    const auto any = [&] { return Point(place(random), place(random), place(random)); };
    while (true) {
        const Point center = spread * any();
        Tet tet{center + any(), center + any(), center + any(), center + any()};
        if (tet_volume(tet[0], tet[1], tet[2], tet[3]) < 0) std::swap(tet[2], tet[3]);
        if (tet_volume(tet[0], tet[1], tet[2], tet[3]) > 0.01) return tet;
    }
}

/// Volume that two tetrahedra share, by clipping one's hull with the other's half-spaces: the vertices of the
/// intersection are found among all meetings of three of the eight planes.
bool has_common_inside(const Tet& a, const Tet& b) {
    struct Plane {
        Point normal;
        double offset;
    };
    std::vector<Plane> planes;
    for (const Tet* tet : {&a, &b})
        for (const auto& [i, j, k] : tet::face_vertices) {
            const Point normal =
                ((*tet)[j] - (*tet)[i]).cross((*tet)[k] - (*tet)[i]).normalized();  // outward
            planes.push_back({normal, normal.dot((*tet)[i])});
        }
    std::vector<Point> corners;
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < i; ++j)
            for (int k = 0; k < j; ++k) {
                Eigen::Matrix3d m;
                m << planes[i].normal.transpose(), planes[j].normal.transpose(), planes[k].normal.transpose();
                if (std::abs(m.determinant()) < 1e-9) continue;
                const Point p = m.inverse() * Point(planes[i].offset, planes[j].offset, planes[k].offset);
                if (std::ranges::all_of(planes, [&](const Plane& plane) {
                        return plane.normal.dot(p) <= plane.offset + 1e-9;
                    }))
                    corners.push_back(p);
            }
    // A body where four corners span a volume.
    for (const Point& p : corners)
        for (const Point& q : corners)
            for (const Point& r : corners)
                for (const Point& s : corners)
                    if (std::abs(tet_volume(p, q, r, s)) > 1e-8) return true;
    return false;
}

Tet moved(Tet tet, const Point& by) {
    for (Point& p : tet) p += by;
    return tet;
}

}  // namespace

TEST_CASE("Two tetrahedra overlap where the intersection of their half-spaces has a volume") {
    std::mt19937 random(17);
    int n_overlapping = 0;
    for (int i = 0; i < 150; ++i) {
        CAPTURE(i);
        const Tet a = random_tet(random, 0.8);
        const Tet b = random_tet(random, 0.8);
        const bool wanted = has_common_inside(a, b);
        n_overlapping += wanted;
        CHECK(overlap(a, b) == wanted);
        CHECK(overlap(b, a) == wanted);
    }
    CHECK(n_overlapping > 20);
    CHECK(n_overlapping < 130);
}

TEST_CASE("Touching is not overlapping, to the last bit") {
    const Tet tet{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
    CHECK(overlap(tet, tet));
    CHECK(!overlap(tet, moved(tet, {1, 0, 0})));      // a vertex on a vertex
    CHECK(!overlap(tet, moved(tet, {0.5, 0.5, 0})));  // a vertex on an edge
    CHECK(overlap(tet, moved(tet, {0.5, std::nextafter(0.5, 0), 0})));
    const Tet below{Point(0.1, 0.1, 0), Point(0.2, 0.3, 0), Point(0.3, 0.1, 0), Point(0.2, 0.2, -1)};
    REQUIRE(orientation(below[0], below[1], below[2], below[3]) > 0);
    CHECK(!overlap(tet, below));  // a face within a face
    CHECK(overlap(tet, moved(below, {0, 0, 1e-300})));
    // Two crossing edges, one above the other.
    const Tet upper{Point(0, 0, 0), Point(1, 0, 0), Point(0.5, 1, 1), Point(0.5, -1, 1)};
    const Tet lower{Point(0.5, -1, 0), Point(0.5, 1, 0), Point(0, 0, -1), Point(1, 0, -1)};
    REQUIRE(orientation(upper[0], upper[1], upper[3], upper[2]) != 0);
    CHECK(!overlap(upper, lower));
    CHECK(overlap(upper, moved(lower, {0, 0, 1e-16})));
}

TEST_CASE("find_overlaps names all pairs in a mesh that overlap, and none in a good one") {
    TetMesh mesh = test::kuhn_cube(3);
    CHECK(find_overlaps(mesh).empty());
    TetMesh shifted = test::kuhn_cube(1);
    for (auto v : shifted.vertices()) shifted.set_point(v, v.point() + Point(0.95, 0, 0));
    mesh.append(shifted);
    std::vector<std::pair<CellHandle, CellHandle>> wanted;
    for (auto a : mesh.cells())
        for (auto b : mesh.cells())
            if (a < b && overlap(mesh.cell_points(a), mesh.cell_points(b))) wanted.emplace_back(a, b);
    CHECK(!wanted.empty());
    CHECK(find_overlaps(mesh, 1000) == wanted);
    CHECK(find_overlaps(mesh, 2).size() == 2);
}

TEST_CASE("add_cell refuses a cell that overlaps one at its vertices, however they touch") {
    TetMesh mesh = TetMesh::from_cells({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}});
    const auto v = [](std::uint32_t i) { return VertexHandle(i); };
    // Through vertex 0 only, and through the edge 0-1 only, into the cell.
    const auto a = mesh.add_vertex({0.5, 0.4, 0.5});
    const auto b = mesh.add_vertex({0.4, 0.5, 0.5});
    const auto c = mesh.add_vertex({0.5, 0.5, 0.6});
    const auto d = mesh.add_vertex({0, -1, 0.2});
    const auto e = mesh.add_vertex({0, -1, -1});
    const bool turns = orientation(mesh.point(v(0)), mesh.point(a), mesh.point(b), mesh.point(c)) > 0;
    CHECK_THROWS_WITH_AS(turns ? mesh.add_cell(v(0), a, b, c) : mesh.add_cell(v(0), b, a, c),
                         doctest::Contains("overlaps cell 0"), std::invalid_argument);
    CHECK_THROWS_WITH_AS(orientation(mesh.point(v(0)), mesh.point(v(1)), mesh.point(a), mesh.point(b)) > 0
                             ? mesh.add_cell(v(0), v(1), a, b)
                             : mesh.add_cell(v(0), v(1), b, a),
                         doctest::Contains("overlaps cell 0"), std::invalid_argument);
    CHECK(mesh.n_cells() == 1);
    // Away from it at the same edge all is well.
    REQUIRE(orientation(mesh.point(v(0)), mesh.point(v(1)), mesh.point(d), mesh.point(e)) != 0);
    orientation(mesh.point(v(0)), mesh.point(v(1)), mesh.point(d), mesh.point(e)) > 0
        ? mesh.add_cell(v(0), v(1), d, e)
        : mesh.add_cell(v(0), v(1), e, d);
    CHECK(mesh.n_cells() == 2);
}
