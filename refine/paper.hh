#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "refine/refine.hh"
#include "refine/size_field.hh"
#include "volmesh/tet_mesh.hh"

/// The numerical examples of "3D mesh refinement procedure using the bisection and Rivara algorithms with
/// mesh quality assessment", section 5, and the figures that its Tables 1 to 4 print.
namespace maille::refine {

/// Of a measure over the cells of a mesh.
struct Spread {
    double min = 0;   ///< least
    double mean = 0;  ///< over the number of cells
    double max = 0;   ///< greatest
};

/// A column of Table 2 or 4.
struct PaperRun {
    Method method = Method::rivara;      ///< the algorithm,
    Order order = Order::none;           ///< and how it sorted the elements
    int iterations = 0;                  ///< passes
    bool ended = true;                   ///< false: the cap on the number of passes was hit
    std::uint32_t cells = 0;             ///< of the refined mesh
    std::uint32_t vertices = 0;          ///< of the refined mesh
    Spread sigma;                        ///< r/Lmax, scaled to 1 for the regular tetrahedron
    Spread tau;                          ///< Lmin/Lmax
    Spread phi;                          ///< L/Lbar, L being the longest edge, as in the printed values
    double sigma_below_0_4_percent = 0;  ///< of the cells
    double sigma_below_0_2_percent = 0;  ///< of the cells
    double tau_below_0_3_percent = 0;    ///< of the cells
    double phi_within_percent = 0;       ///< 2/3 < L/Lbar < 3/2
    double seconds = 0;                  ///< CPU time of the refinement alone
};

/// The quality of a start mesh: Table 1 or 3.
struct PaperStart {
    std::uint32_t cells = 0;     ///< of the start mesh
    std::uint32_t vertices = 0;  ///< of the start mesh
    Spread radius_ratio;         ///< sqrt(6) r/R: what the row "r/R" holds
    Spread sigma;                ///< r/Lmax, scaled to 1 for the regular tetrahedron
    Spread alpha;                ///< 6 sqrt(2) V/Lavr^3
    Spread tau;                  ///< Lmin/Lmax
};

/// One of the two examples, beside what is printed of it.
struct PaperExample {
    std::string title;  ///< what it is, in a line
    ///@{
    /// Of the start mesh: as computed and as printed.
    PaperStart start, printed_start;
    ///@}
    ///@{
    /// Bisection, bisection with sorting, Rivara, Rivara with sorting: as computed and as printed.
    std::vector<PaperRun> runs, printed_runs;
    ///@}
};

/// The start mesh of example 1 (a unit cube of 2x2x2 bricks, 48 tetrahedra) and of example 2 (a hollow cube
/// of edge 5: the 44 bricks that are left of 5x5x5 when a square tunnel of width 3 is cut along each axis,
/// 264 tetrahedra). Coordinates are exact, which keeps the ties between edges.
volmesh::TetMesh paper_mesh(int example);

/// The wanted sizes: 1/6.25 of the edge in example 1; D(r) = h0 + H (1 - exp(-r / tau)) in example 2, where
/// the paper doesn't give h0, H and tau: ours are chosen so that the runs are about as long as the printed
/// ones.
SizeField paper_size(int example);

/// Runs the four algorithms on example 1 or 2. Throws InputError for any other number.
PaperExample paper_example(int example);

}  // namespace maille::refine
