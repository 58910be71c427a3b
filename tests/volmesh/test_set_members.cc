#include <algorithm>
#include <ctime>
#include <functional>
#include <random>
#include <thread>

#include <doctest/doctest.h>

#include "tests/support/kuhn.hh"
#include "tests/support/random_sets.hh"
#include "volmesh/collapse.hh"
#include "volmesh/face_removal.hh"
#include "volmesh/split_inside.hh"

using namespace maille::volmesh;
using maille::test::add_random_sets;
using maille::test::kuhn_cube;
using maille::test::shake;

namespace {

/// What each entity says of itself.
void check_lists(const TetMesh& mesh) {
    for (TetMesh::Index i = 0; i < mesh.n_sets(); ++i) {
        const SetHandle s(i);
        const EntityKind kind = mesh.set_info(s).kind;
        std::vector<VertexHandle> vertices;
        std::vector<CellHandle> cells;
        std::vector<HalffaceHandle> faces;
        std::vector<std::pair<CellHandle, int>> edges;
        for (VertexHandle v : mesh.vertices())
            if (kind == EntityKind::vertex && mesh.contains(s, v)) vertices.push_back(v);
        for (CellHandle c : mesh.cells()) {
            if (kind == EntityKind::cell && mesh.contains(s, c)) cells.push_back(c);
            for (int f = 0; f < 4 && kind == EntityKind::face; ++f) {
                const HalffaceHandle hf = TetMesh::halfface(c, f);
                const HalffaceHandle other = mesh.opposite_halfface_handle(hf);
                if (mesh.contains(s, hf) && (!other.is_valid() || hf < other)) faces.push_back(hf);
            }
            for (int e = 0; e < 6 && kind == EntityKind::edge; ++e)
                if (mesh.contains(s, c, e) && std::ranges::min(mesh.cells_around(c, e)) == c)
                    edges.emplace_back(c, e);
        }
        CHECK(mesh.vertex_members(s) == vertices);
        CHECK(mesh.cell_members(s) == cells);
        CHECK(mesh.face_members(s) == faces);
        CHECK(mesh.edge_members(s) == edges);
        CHECK(mesh.set_size(s) == vertices.size() + cells.size() + faces.size() + edges.size());
    }
}

TetMesh mesh_with_sets(unsigned seed) {
    std::mt19937 random(seed);
    TetMesh mesh = kuhn_cube(3);
    shake(mesh, 0.02, random);
    add_random_sets(mesh, random);
    // One whose members a function chooses.
    mesh.add_set(
        "odd", EntityKind::cell,
        SetRule::custom([](const TetMesh&, auto, auto, auto, VertexHandle m) { return m.idx() % 2 == 1; }));
    for (CellHandle c : mesh.cells()) mesh.insert(mesh.find_set("odd", EntityKind::cell), c);
    return mesh;
}

double processor_seconds(const std::function<void()>& action) {
    const std::clock_t start = std::clock();
    action();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

TEST_CASE("lists of members are those of the mesh as it is, whatever was done since the last list") {
    TetMesh mesh = mesh_with_sets(1);
    check_lists(mesh);
    std::mt19937 random(2);
    const auto any = [&](std::size_t n) { return static_cast<TetMesh::Index>(random() % n); };
    const auto any_cell = [&] {
        CellHandle c(any(mesh.n_cells()));
        while (mesh.is_deleted(c)) c = CellHandle(any(mesh.n_cells()));
        return c;
    };
    int n_flips = 0;
    for (int round = 0; round < 60; ++round) {
        switch (round % 10) {
            case 0:
                mesh.split_edge(any_cell(), static_cast<int>(any(6)));
                break;
            case 1:
                for (int i = 0; i < 40; ++i)
                    if (const HalffaceHandle hf = TetMesh::halfface(any_cell(), static_cast<int>(any(4)));
                        is_flip_23_ok(mesh, hf)) {
                        flip_23(mesh, hf);
                        ++n_flips;
                        break;
                    }
                break;
            case 2:
                mesh.insert(SetHandle(0), any_cell());
                mesh.insert(SetHandle(1), TetMesh::halfface(any_cell(), static_cast<int>(any(4))));
                break;
            case 3:
                mesh.erase(SetHandle(2), any_cell(), static_cast<int>(any(6)));
                mesh.erase(SetHandle(3), VertexHandle(any(mesh.n_vertices())));
                break;
            case 4:
                mesh.delete_cell(any_cell());
                break;
            case 5:
                split_cell(mesh, any_cell());
                break;
            case 6:
                for (int i = 0; i < 200; ++i) {
                    const CellHandle c = any_cell();
                    const VertexHandle gone = mesh.cell_vertex(c, static_cast<int>(any(4)));
                    const VertexHandle heir = mesh.cell_vertex(c, static_cast<int>(any(4)));
                    if (gone != heir && is_collapse_ok(mesh, gone, heir)) {
                        collapse_edge(mesh, gone, heir);
                        break;
                    }
                }
                break;
            case 7: {
                const CellHandle c = any_cell();
                mesh.insert(SetHandle(0), std::array{c, any_cell(), c});
                mesh.insert(SetHandle(3), mesh.cell_vertices(c));
                break;
            }
            case 8:
                mesh.garbage_collection();
                break;
            default: {
                const TetMesh copy = mesh;
                check_lists(copy);
                if (round == 29) mesh.append(mesh_with_sets(3));
            }
        }
        check_lists(mesh);
    }
    CHECK(n_flips > 0);
    mesh = mesh_with_sets(4);
    check_lists(mesh);
    mesh.delete_isolated_vertices();
    const VertexHandle alone = mesh.add_vertex(Point(9, 9, 9));
    mesh.insert(SetHandle(3), alone);
    check_lists(mesh);
    mesh.delete_isolated_vertices();
    check_lists(mesh);
    CHECK(mesh.vertex_members(SetHandle(999)).empty());
}

TEST_CASE("many members at once are as if put in one by one, and of the right kind") {
    TetMesh one = mesh_with_sets(5);
    TetMesh many = one;
    std::vector<CellHandle> cells;
    std::vector<VertexHandle> vertices;
    for (CellHandle c : one.cells())
        if (c.idx() % 3 == 0) cells.push_back(c);
    for (VertexHandle v : one.vertices())
        if (v.idx() % 5 == 2) vertices.push_back(v);
    const SetHandle of_cells(0), of_faces(1), of_vertices(3);
    for (CellHandle c : cells) one.insert(of_cells, c);
    for (VertexHandle v : vertices) one.insert(of_vertices, v);
    many.insert(of_cells, cells);
    many.insert(of_vertices, vertices);
    check_lists(many);
    for (TetMesh::Index s = 0; s < one.n_sets(); ++s) {
        CHECK(one.cell_members(SetHandle(s)) == many.cell_members(SetHandle(s)));
        CHECK(one.vertex_members(SetHandle(s)) == many.vertex_members(SetHandle(s)));
    }
    CHECK_THROWS_AS(many.insert(of_faces, cells), std::invalid_argument);
    CHECK_THROWS_AS(many.insert(of_cells, vertices), std::invalid_argument);
}

TEST_CASE("a list costs what it has, not what the mesh has") {
    TetMesh mesh = kuhn_cube(20);
    const SetHandle cells = mesh.add_set("cells", EntityKind::cell);
    const SetHandle edges = mesh.add_set("edges", EntityKind::edge);
    mesh.insert(cells, CellHandle(7));
    mesh.insert(edges, CellHandle(7), 3);
    std::size_t n = 0;
    const auto ask = [&] { n += mesh.cell_members(cells).size() + mesh.edge_members(edges).size(); };
    ask();
    // A pass over 48,000 cells takes some 50 us.
    CHECK(processor_seconds([&] {
              for (int i = 0; i < 100'000; ++i) ask();
          }) < 1);
    CHECK(n == 200'002);
}

TEST_CASE("threads may ask for members of the same mesh") {
    const TetMesh mesh = mesh_with_sets(6);
    std::vector<std::thread> threads;
    std::array<bool, 4> agree{};
    for (std::size_t t = 0; t < agree.size(); ++t)
        threads.emplace_back([&, t] {
            agree[t] = true;
            for (TetMesh::Index s = 0; s < mesh.n_sets(); ++s) {
                std::size_t n = 0;
                for (CellHandle c : mesh.cells()) n += mesh.contains(SetHandle(s), c) ? 1 : 0;
                if (mesh.set_info(SetHandle(s)).kind == EntityKind::cell)
                    agree[t] = agree[t] && mesh.set_size(SetHandle(s)) == n;
            }
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(std::ranges::all_of(agree, [](bool all) { return all; }));
}
