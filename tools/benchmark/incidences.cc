#include "tools/benchmark/incidences.hh"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/benchmark/meter.hh"
#include "volmesh/cell_table.hh"

namespace maille::benchmark {
namespace {

using namespace volmesh;

/// What a walk has seen: the number of entities, and a sum over them so that none is left out.
struct Seen {
    std::size_t visits = 0;
    double sum = 0;
};

/// The best of several: others' work on the machine only ever slows a walk.
template <class Walk>
void print_rate(const char* name, int repeats, const Walk& walk) {
    double best = std::numeric_limits<double>::infinity();
    Seen seen;
    for (int i = 0; i < repeats; ++i) {
        const Seconds start = now();
        const Seen again = walk();
        best = std::min(best, (now() - start).cpu);
        if (i > 0 && again.sum != seen.sum) throw std::runtime_error("a walk saw something else");
        seen = again;
    }
    fmt::print("| {} | {:.0f} M visits/s | {} |\n", name, static_cast<double>(seen.visits) / 1e6 / best,
               seen.visits);
}

void print_bytes(const char* name, std::size_t before, const TetMesh& mesh) {
    forget_peak();
    fmt::print("| {} | {:.0f} B/tet | |\n", name,
               static_cast<double>(resident_bytes() - before) / mesh.n_cells());
}

/// Cells seen from each entity of a range.
template <class Range, class Cells>
Seen see_cells(const Range& range, const Cells& cells_of) {
    std::size_t visits = 0;
    std::uint64_t sum = 0;
    for (const auto h : range)
        for (const CellHandle c : cells_of(h)) {
            sum += c.idx();
            ++visits;
        }
    return {visits, static_cast<double>(sum)};
}

Seen see_points(const TetMesh& mesh) {
    Seen seen;
    for (const CellHandle c : mesh.cells())
        for (const VertexHandle v : mesh.cell_vertices(c)) {
            seen.sum += mesh.point(v).x();
            ++seen.visits;
        }
    return seen;
}

TetMesh build(const CellSoup& soup, int repeats) {
    double best = std::numeric_limits<double>::infinity();
    TetMesh mesh;
    for (int i = 0; i < repeats; ++i) {
        auto points = soup.points;
        auto cells = soup.cells;
        const Seconds start = now();
        mesh = TetMesh::from_cells(std::move(points), std::move(cells));
        best = std::min(best, (now() - start).cpu);
    }
    fmt::print("| build | {:.2f} Mtet/s | |\n", mesh.n_cells() / 1e6 / best);
    return mesh;
}

}  // namespace

void measure_incidences(const CellSoup& soup, int repeats) {
    fmt::print("| | | visits |\n|---|---|---|\n");
    forget_peak();
    const std::size_t before = resident_bytes();
    TetMesh mesh = build(soup, repeats);
    print_bytes("stored: cells, vertices and half-faces", before, mesh);
    print_rate("cell -> cells", repeats,
               [&] { return see_cells(mesh.cells(), [&](CellHandle c) { return mesh.cc_range(c); }); });
    print_rate("cell -> vertices and points", repeats, [&] { return see_points(mesh); });
    print_rate("vertex -> cells", repeats,
               [&] { return see_cells(mesh.vertices(), [&](VertexHandle v) { return mesh.vc_range(v); }); });
    mesh.request_edges();
    print_bytes("with edges", before, mesh);
    print_rate("edge -> cells", repeats,
               [&] { return see_cells(mesh.edges(), [&](EdgeHandle e) { return mesh.ec_range(e); }); });
    mesh.request_faces();
    print_bytes("with edges and faces", before, mesh);
    const auto at_vertices = vertex_cells(mesh);
    print_bytes("and a table of the vertices' cells", before, mesh);
    print_rate("vertex -> cells by the table", repeats,
               [&] { return see_cells(mesh.vertices(), [&](VertexHandle v) { return at_vertices[v]; }); });
    const auto at_edges = edge_cells(mesh);
    print_bytes("and one of the edges' cells", before, mesh);
    print_rate("edge -> cells by the table", repeats,
               [&] { return see_cells(mesh.edges(), [&](EdgeHandle e) { return at_edges[e]; }); });
}

}  // namespace maille::benchmark
