#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "quality/measures.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

/// The measures of a cell, after the functions of measures.hh.
enum class Measure : std::uint8_t {
    beta,
    sigma,
    omega,
    tau,
    kappa,
    alpha,
    gamma,
    phi,
    dihedral_min,
    dihedral_max,
    solid_angle_min,
    solid_angle_max,
    aspect,
    condition,
    mean_ratio,
    scaled_jacobian
};

/// How a measure is told: its name in tables and JSON, the bins of its histogram, equal parts of [low, high],
/// and its value for the regular tetrahedron (for phi: of the wanted size). Values beyond the ends are
/// counted in the first and in the last bin.
struct MeasureInfo {
    Measure measure;        ///< which
    std::string_view name;  ///< that of its function
    double low;             ///< where the first bin begins
    double high;            ///< where the last bin ends
    std::uint32_t bins;     ///< of the histogram
    double best;            ///< for the regular tetrahedron
    std::string_view unit;  ///< of angles; else empty
};

/// By Measure.
inline constexpr std::array<MeasureInfo, 16> measure_infos{{
    {Measure::beta, "beta", 0, 1, 20, 1, ""},
    {Measure::sigma, "sigma", 0, 1, 20, 1, ""},
    {Measure::omega, "omega", 0, 1.25, 25, 1, ""},
    {Measure::tau, "tau", 0, 1, 20, 1, ""},
    {Measure::kappa, "kappa", 0, 1, 20, 1, ""},
    {Measure::alpha, "alpha", 0, 1, 20, 1, ""},
    {Measure::gamma, "gamma", 0, 1, 20, 1, ""},
    {Measure::phi, "phi", 0, 2, 20, 1, ""},
    {Measure::dihedral_min, "dihedral_min", 0, 180, 36, 70.52877936550931, "degrees"},
    {Measure::dihedral_max, "dihedral_max", 0, 180, 36, 70.52877936550931, "degrees"},
    {Measure::solid_angle_min, "solid_angle_min", 0, 1, 20, 0.5512855984325309, "steradians"},
    {Measure::solid_angle_max, "solid_angle_max", 0, 6.4, 32, 0.5512855984325309, "steradians"},
    {Measure::aspect, "aspect", 0, 1, 20, 1, ""},
    {Measure::condition, "condition", 0, 1, 20, 1, ""},
    {Measure::mean_ratio, "mean_ratio", 0, 1, 20, 1, ""},
    {Measure::scaled_jacobian, "scaled_jacobian", 0, 1, 20, 1, ""},
}};

/// The bin of [low, high] that counts the value.
std::uint32_t bin_of(double low, double high, std::uint32_t bins, double value);

/// Wanted edge length at a point.
using WantedSize = std::function<double(const Point&)>;

/// All measures of one cell, by Measure.
using CellMeasures = std::array<double, measure_infos.size()>;
/// One of them.
inline double value_of(const CellMeasures& values, Measure m) {
    return values[static_cast<std::size_t>(m)];
}

/// Where the cell's wanted size is asked.
Point centroid(const volmesh::TetMesh& mesh, volmesh::CellHandle c);
/// For the functions of measures.hh.
TetGeometry cell_geometry(const volmesh::TetMesh& mesh, volmesh::CellHandle c);

/// `size` is asked at the cell's centroid; without one phi is 0. Throws InputError, naming the cell and the
/// point, where it isn't positive and finite. Precondition: `t` is the cell's geometry.
CellMeasures measure_cell(const volmesh::TetMesh& mesh, volmesh::CellHandle c, const TetGeometry& t,
                          const WantedSize* size = nullptr);

/// One measure of every cell, by cell index, in parallel; 0 for deleted cells. `size`, which phi needs, must
/// be thread-safe. Throws as measure_cell does.
std::vector<double> measure_cells(const volmesh::TetMesh& mesh, Measure m, const WantedSize* size = nullptr);

}  // namespace maille::quality
