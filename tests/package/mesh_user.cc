// Uses the mesh alone: splits an edge, writes and reads the result.
#include <cmath>
#include <cstdio>

#include "volmesh/boundary.hh"
#include "volmesh/io/mesh_io.hh"
#include "volmesh/measure.hh"

int main(int, char** arguments) {
    using namespace maille::volmesh;
    TetMesh mesh = TetMesh::from_cells({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}});
    mesh.insert(mesh.add_set("corner", EntityKind::vertex), VertexHandle(0));
    mesh.split_edge(mesh.find_edge(VertexHandle(1), VertexHandle(2)));
    write_mesh(mesh, arguments[1]);
    const TetMesh back = read_mesh(arguments[1]);
    const bool is_right = back.n_cells() == 2 && std::abs(volume(back) - 1.0 / 6) < 1e-15 &&
                          back.set_size(back.find_set("corner", EntityKind::vertex)) == 1 &&
                          boundary(back).surface.n_faces() == 6;
    std::puts(is_right ? "right" : "wrong");
    return is_right ? 0 : 1;
}
