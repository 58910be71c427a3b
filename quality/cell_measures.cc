#include "quality/cell_measures.hh"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "volmesh/error.hh"

namespace maille::quality {
namespace {

using volmesh::CellHandle;
using volmesh::TetMesh;

double wanted_size(const WantedSize& size, const Point& p, std::uint32_t cell) {
    const double wanted = size(p);
    if (!(wanted > 0) || !std::isfinite(wanted))
        throw InputError(fmt::format("the wanted size is {} at ({}, {}, {}), in cell {}: it must be positive",
                                     wanted, p.x(), p.y(), p.z(), cell));
    return wanted;
}

/// By Measure; phi needs more than the tetrahedron.
constexpr std::array<double (*)(const TetGeometry&), measure_infos.size()> functions{
    beta,         sigma,        omega,           tau,
    kappa,        alpha,        gamma,           nullptr,
    dihedral_min, dihedral_max, solid_angle_min, solid_angle_max,
    aspect,       condition,    mean_ratio,      scaled_jacobian};

double evaluate(const TetMesh& mesh, CellHandle c, const TetGeometry& t, Measure m, const WantedSize* size) {
    if (m == Measure::phi) return size ? phi(t, wanted_size(*size, centroid(mesh, c), c.idx())) : 0;
    return functions[static_cast<std::size_t>(m)](t);
}

}  // namespace

std::uint32_t bin_of(double low, double high, std::uint32_t bins, double value) {
    const double place = (value - low) / (high - low) * bins;
    return static_cast<std::uint32_t>(std::clamp(place, 0.0, bins - 1.0));
}

Point centroid(const TetMesh& mesh, CellHandle c) {
    const auto p = mesh.cell_points(c);
    return (p[0] + p[1] + p[2] + p[3]) / 4;
}

TetGeometry cell_geometry(const TetMesh& mesh, CellHandle c) {
    const auto p = mesh.cell_points(c);
    return tet_geometry(p[0], p[1], p[2], p[3]);
}

CellMeasures measure_cell(const TetMesh& mesh, CellHandle c, const TetGeometry& t, const WantedSize* size) {
    CellMeasures values;
    for (const MeasureInfo& info : measure_infos)
        values[static_cast<std::size_t>(info.measure)] = evaluate(mesh, c, t, info.measure, size);
    return values;
}

std::vector<double> measure_cells(const TetMesh& mesh, Measure m, const WantedSize* size) {
    std::vector<double> values(mesh.n_cells());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mesh.n_cells(), 1024), [&](const auto& range) {
        for (std::uint32_t i = range.begin(); i != range.end(); ++i)
            if (!mesh.is_deleted(CellHandle(i)))
                values[i] = evaluate(mesh, CellHandle(i), cell_geometry(mesh, CellHandle(i)), m, size);
    });
    return values;
}

}  // namespace maille::quality
