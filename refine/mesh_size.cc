#include <cmath>

#include <fmt/format.h>

#include "refine/simplex_tree.hh"
#include "refine/size_field.hh"
#include "volmesh/error.hh"
#include "volmesh/measure.hh"

namespace maille::refine {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;
using volmesh::VertexHandle;
using Weights = Eigen::Vector4d;

SimplexTree tree_of_cells(const TetMesh& mesh) {
    std::vector<Simplex> cells;
    for (const auto cell : mesh.cells()) cells.push_back({mesh.cell_points(cell), 4});
    return SimplexTree(std::move(cells));
}

void require_size(double value, const std::string& property, const char* kind, std::uint32_t index,
                  const Point& p) {
    if (value > 0 && std::isfinite(value)) return;
    throw InputError(
        fmt::format("the size \"{}\" is {} at {} {}, ({}, {}, {}); it must be positive and finite", property,
                    value, kind, index, p.x(), p.y(), p.z()));
}

using ValuesAtCorners = std::vector<Weights>;  // by cell

/// Of a value at each vertex.
ValuesAtCorners of_vertices(const TetMesh& mesh, const auto& value) {
    ValuesAtCorners values;
    for (const auto cell : mesh.cells()) {
        Weights& corners = values.emplace_back();
        for (int i = 0; i < 4; ++i) corners[i] = value(mesh.cell_vertex(cell, i));
    }
    return values;
}

ValuesAtCorners of_vertex_property(const TetMesh& mesh, volmesh::VPropHandleT<double> handle,
                                   const std::string& name) {
    return of_vertices(mesh, [&](VertexHandle v) {
        const double value = mesh.property(handle, v);
        require_size(value, name, "vertex", v.idx(), mesh.point(v));
        return value;
    });
}

/// The mean at each vertex of the values of its cells, weighted by their volumes.
ValuesAtCorners averaged(const TetMesh& mesh, const std::vector<double>& by_cell) {
    std::vector<double> sums(mesh.n_vertices()), volumes(mesh.n_vertices());
    for (const CellHandle cell : mesh.cells()) {
        const double volume = volmesh::volume(mesh, cell);
        for (const auto v : mesh.cell_vertices(cell)) {
            sums[v.idx()] += volume * by_cell[cell.idx()];
            volumes[v.idx()] += volume;
        }
    }
    return of_vertices(mesh, [&](VertexHandle v) { return sums[v.idx()] / volumes[v.idx()]; });
}

ValuesAtCorners of_cell_property(const TetMesh& mesh, volmesh::CPropHandleT<double> handle,
                                 const std::string& name, CellValues meaning) {
    ValuesAtCorners constant;
    std::vector<double> by_cell(mesh.n_cells());
    for (const CellHandle cell : mesh.cells()) {
        const double value = mesh.property(handle, cell);
        require_size(value, name, "cell", cell.idx(), mesh.point(mesh.cell_vertex(cell, 0)));
        constant.push_back(Weights::Constant(value));
        by_cell[cell.idx()] = value;
    }
    return meaning == CellValues::constant ? constant : averaged(mesh, by_cell);
}

ValuesAtCorners corner_values(const TetMesh& mesh, const std::string& property, CellValues meaning) {
    volmesh::VPropHandleT<double> at_vertices;
    volmesh::CPropHandleT<double> in_cells;
    if (mesh.get_property_handle(at_vertices, property))
        return of_vertex_property(mesh, at_vertices, property);
    if (mesh.get_property_handle(in_cells, property))
        return of_cell_property(mesh, in_cells, property, meaning);
    throw InputError(
        fmt::format("the mesh has no vertex or cell field of real numbers named \"{}\"", property));
}

}  // namespace

SizeField mesh_size(const TetMesh& mesh, const std::string& property, CellValues cell_values) {
    ValuesAtCorners values = corner_values(mesh, property, cell_values);
    if (values.empty()) throw InputError("a size field needs a mesh with at least one cell");
    const auto corners = std::make_shared<const ValuesAtCorners>(std::move(values));
    const auto value_at = [tree = tree_of_cells(mesh), corners](const Point& p) {
        const SimplexTree::Nearest nearest = tree.nearest(p);
        const Weights& at = (*corners)[nearest.simplex];
        // Written so that equal values give just that value.
        return at[0] + nearest.weights.dot(at - Weights::Constant(at[0]));
    };
    return SizeField(value_at, fmt::format("the size field \"{}\"", property));
}

}  // namespace maille::refine
