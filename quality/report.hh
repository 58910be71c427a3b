#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "quality/cell_measures.hh"
#include "volmesh/tet_mesh.hh"

namespace maille::quality {

/// Minimum, mean and maximum over the cells, equation (7) of the paper that measures.hh names. All 0 without
/// cells.
struct Statistics {
    double min = 0;                      ///< least
    double mean = 0;                     ///< over the number of cells
    double max = 0;                      ///< greatest
    std::vector<std::size_t> histogram;  ///< by bin; the sum is the number of cells
};

/// A percentage of the cells, as in tables 2 and 4 of that paper: "r/Lmax<0.4", where r/Lmax stands for
/// sigma.
struct Criterion {
    std::string name;    ///< what the cells satisfy
    double percent = 0;  ///< of all cells
};

/// Whether that paper (section 5) calls the shape bad: sigma < 0.2, or sigma < 0.4 and tau < 0.3.
bool is_badly_shaped(const CellMeasures& values);

/// One of the worst cells.
struct WorstCell {
    volmesh::CellHandle cell;          ///< which
    double sigma = 0;                  ///< after measures.hh
    double dihedral_min = 0;           ///< in degrees
    double dihedral_max = 0;           ///< in degrees
    double error = 0;                  ///< 0 where no errors were given
    Point centroid;                    ///< where it is
    std::vector<std::string> sets;     ///< the cell sets that it is in
    std::vector<std::string> touches;  ///< the face sets that its faces are in
};

/// Badly shaped cells whose estimated error is above the mean one: section 4 of that paper.
struct Critical {
    double mean_error = 0;         ///< over all cells
    std::size_t cells = 0;         ///< number of critical ones
    std::vector<WorstCell> worst;  ///< the largest error first
};

/// What assess finds.
struct Report {
    std::size_t cells = 0;         ///< not deleted
    std::size_t inverted = 0;      ///< cells with no positive volume
    std::size_t badly_shaped = 0;  ///< by is_badly_shaped; none: the paper's "good shape quality"
    bool has_size = false;         ///< whether a wanted size was given: without one nothing is said about phi
    std::array<Statistics, measure_infos.size()> measures;  ///< by Measure
    std::vector<Criterion> criteria;                        ///< those of the paper's tables
    std::vector<WorstCell> worst;                           ///< the lowest sigma first
    std::optional<Critical> critical;                       ///< where errors were given

    /// Of one measure.
    const Statistics& operator[](Measure m) const { return measures[static_cast<std::size_t>(m)]; }
};

/// What else a report is to tell of.
struct AssessOptions {
    /// An estimated error of each cell, by cell index: not negative. Empty: none is known.
    std::span<const double> errors{};
    std::size_t n_worst = 10;  ///< how many of the worst and of the critical cells are listed
};

/// Measures all cells, in parallel; the report doesn't depend on the number of threads.
///
/// `size` is asked at each cell's centroid and must be thread-safe. Throws InputError, naming the cell, where
/// it isn't positive and finite, or an error is negative or not finite. Precondition: as many errors as
/// cells, deleted ones included, or none.
Report assess(const volmesh::TetMesh& mesh, const WantedSize* size = nullptr,
              const AssessOptions& options = {});

/// As a table with histograms drawn in text, the criteria, the worst and the critical cells. Percentages are
/// cut after two digits, as the paper does: 0.00 may be a few cells, 100.00 is all of them.
std::string to_text(const Report& report);

/// `cells`, `inverted`, `measures` {name: {min, mean, max, histogram, range}}, `criteria` {name: percent},
/// `bad_shape` {cells, percent}, `critical` {cells, percent, mean_error, worst} and `worst`, a list of {cell,
/// sigma, dihedral_min, dihedral_max, centroid, sets, touches}, and error where errors were given. `phi` is
/// null where no wanted size was given, `critical` where no errors were.
nlohmann::ordered_json to_json(const Report& report);

}  // namespace maille::quality
