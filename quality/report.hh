#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "quality/measures.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

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

/// How a measure is told: its name in tables and JSON, and the bins of its histogram, equal parts of [low,
/// high]. Values beyond the ends are counted in the first and in the last bin.
struct MeasureInfo {
    Measure measure;
    std::string_view name;
    double low, high;
    std::uint32_t bins;
};

inline constexpr std::array<MeasureInfo, 16> measure_infos{{
    {Measure::beta, "beta", 0, 1, 20},
    {Measure::sigma, "sigma", 0, 1, 20},
    {Measure::omega, "omega", 0, 1.25, 25},
    {Measure::tau, "tau", 0, 1, 20},
    {Measure::kappa, "kappa", 0, 1, 20},
    {Measure::alpha, "alpha", 0, 1, 20},
    {Measure::gamma, "gamma", 0, 1, 20},
    {Measure::phi, "phi", 0, 2, 20},
    {Measure::dihedral_min, "dihedral_min", 0, 180, 36},
    {Measure::dihedral_max, "dihedral_max", 0, 180, 36},
    {Measure::solid_angle_min, "solid_angle_min", 0, 1, 20},
    {Measure::solid_angle_max, "solid_angle_max", 0, 6.4, 32},
    {Measure::aspect, "aspect", 0, 1, 20},
    {Measure::condition, "condition", 0, 1, 20},
    {Measure::mean_ratio, "mean_ratio", 0, 1, 20},
    {Measure::scaled_jacobian, "scaled_jacobian", 0, 1, 20},
}};

/// Minimum, mean and maximum over the cells, equation (7) of the paper that measures.hh names. All 0 without
/// cells.
struct Statistics {
    double min = 0, mean = 0, max = 0;
    std::vector<std::size_t> histogram;  ///< by bin; the sum is the number of cells
};

/// A percentage of the cells, as in tables 2 and 4 of that paper: "r/Lmax<0.4", where r/Lmax stands for
/// sigma.
struct Criterion {
    std::string name;
    double percent = 0;
};

/// One of the worst cells: lowest sigma first.
struct WorstCell {
    volmesh::CellHandle cell;
    double sigma = 0, dihedral_min = 0, dihedral_max = 0;
    Point centroid;
    std::vector<std::string> sets;  ///< the cell sets that it is in
};

struct Report {
    std::size_t cells = 0;
    std::size_t inverted = 0;  ///< cells with no positive volume
    bool has_size = false;     ///< whether a wanted size was given: without one nothing is said about phi
    std::array<Statistics, measure_infos.size()> measures;  ///< by Measure
    std::vector<Criterion> criteria;
    std::vector<WorstCell> worst;  ///< at most ten

    const Statistics& operator[](Measure m) const { return measures[static_cast<std::size_t>(m)]; }
};

/// Wanted edge length at a point.
using WantedSize = std::function<double(const Point&)>;

/// Measures all cells, in parallel; the report doesn't depend on the number of threads.
///
/// `size` is asked at each cell's centroid and must be thread-safe. Throws InputError, naming the cell and
/// the point, where it isn't positive and finite.
Report assess(const volmesh::TetMesh& mesh, const WantedSize* size = nullptr);

/// As a table with histograms drawn in text, the criteria and the worst cells. Percentages are cut after two
/// digits, as the paper does: 0.00 may be a few cells, 100.00 is all of them.
std::string to_text(const Report& report);

/// `cells`, `inverted`, `measures` {name: {min, mean, max, histogram, range}}, `criteria` {name: percent} and
/// `worst`, a list of {cell, sigma, dihedral_min, dihedral_max, centroid, sets}. `phi` is null where no
/// wanted size was given.
nlohmann::ordered_json to_json(const Report& report);

}  // namespace maille::quality
