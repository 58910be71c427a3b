#pragma once

#include <array>
#include <limits>

#include <Eigen/Core>

/// Shape and size measures of one tetrahedron, pure functions of its four points.
///
/// The measures and their symbols are those of "3D mesh refinement procedure using the bisection and Rivara
/// algorithms with mesh quality assessment", section 4, equations (1) to (6). Each is scaled to be 1 for the
/// regular tetrahedron; the constants are worked out anew, as some are misprinted there. With finite points
/// no function here gives NaN: a flat tetrahedron has volume, beta, sigma, kappa, alpha and gamma 0, an
/// inverted one has them negative, with the absolute values of its mirror image; where all four points
/// coincide omega, tau and phi are 0 too. Those that other programs use besides (aspect to mean_ratio) keep
/// to the same: 1 for the regular tetrahedron, 0 for a flat one, negative for an inverted one.
namespace maille::quality {

/// A place, as the mesh has it.
using Point = Eigen::Vector3d;

/// What the measures share, worked out once. Values are in units of `unit`, `unit` squared and `unit` cubed.
struct TetGeometry {
    double unit = 0;    ///< a power of two near the longest edge: the scaled values can't overflow
    double volume = 0;  ///< signed: positive where (b-a)x(c-a).(d-a) is
    std::array<double, 4> areas{};    ///< of the faces opposite a, b, c, d
    std::array<double, 6> lengths{};  ///< of the edges ab ac ad bc bd cd
    double shortest_edge = 0;         ///< Lmin
    double longest_edge = 0;          ///< Lmax
    double mean_edge = 0;             ///< Lavr
    double rms_edge = 0;              ///< Lrms, the root of the mean square
    double inradius = 0;              ///< r = 3 V / sum A, with the volume's sign
    double circumradius = std::numeric_limits<double>::infinity();  ///< R; infinite where the volume is 0
    /// Inner products of the outward face normals, each as long as twice its area, of the two faces at each
    /// edge.
    std::array<double, 6> normal_products{};
};

/// Worked out from the four points. The measures below ask it alone.
TetGeometry tet_geometry(const Point& a, const Point& b, const Point& c, const Point& d);

// ---- with a dimension
// ---------------------------------------------------------------------------------------------
///@{
/// The fields of TetGeometry of the same names, in the unit of the points.
double volume(const TetGeometry& t);
double inradius(const TetGeometry& t);
double circumradius(const TetGeometry& t);
double shortest_edge(const TetGeometry& t);
double longest_edge(const TetGeometry& t);
double mean_edge(const TetGeometry& t);
double rms_edge(const TetGeometry& t);
///@}

// ---- shape
// --------------------------------------------------------------------------------------------------------
/// r / R, at most 1/3.
double radius_ratio(const TetGeometry& t);
/// 3 r / R. Equation (1), after Cavendish et al.
double beta(const TetGeometry& t);
/// 2 sqrt(6) r / Lmax. Equation (2), after Baker.
double sigma(const TetGeometry& t);
/// sqrt(6)/4 Lmax / R. Equation (2), after Baker; printed with .612507 for .612372. It says little alone: its
/// maximum is sqrt(3/2), which slivers reach. Never negative.
double omega(const TetGeometry& t);
/// Lmin / Lmax. Equation (2), after Baker. Never negative.
double tau(const TetGeometry& t);
/// 2187 V^4 / (sum of squared areas)^3. The inverse of equation (3), after Cougny et al., so that 1 is best;
/// printed there as a sum of cubed areas over V^4, which has a dimension.
double kappa(const TetGeometry& t);
/// 6 sqrt(2) V / Lavr^3. Equation (4), after Dannelongue and Tanguy; printed with 8.479670 for 8.485281.
double alpha(const TetGeometry& t);
/// 6 sqrt(2) V / Lrms^3. Equation (5), after Parthasarathy et al.; printed with 8.4779670 for 8.485281.
double gamma(const TetGeometry& t);

///@{
/// The smallest and the largest angle between two faces, in degrees: atan2 of the sine and cosine from the
/// faces' normals, exact also where it is near 0 or 180. A flat or inverted tetrahedron has 0 and 180, the
/// worst there are.
double dihedral_min(const TetGeometry& t);
double dihedral_max(const TetGeometry& t);
///@}

///@{
/// The smallest and the largest solid angle, in steradians (the regular tetrahedron has .551286), after A.
/// van Oosterom, J. Strackee, "The solid angle of a plane triangle", 1983. A flat or inverted tetrahedron has
/// 0 and 2 pi, the worst there are.
double solid_angle_min(const TetGeometry& t);
double solid_angle_max(const TetGeometry& t);
///@}

/// sqrt(3/2) times the least height over Lmax: the inverse of the aspect ratio.
double aspect(const TetGeometry& t);
/// 18 V / sqrt(sum of squared edges, times that of squared areas): 3 over the condition number, in the
/// Frobenius norm, of the map from the regular tetrahedron. After P. M. Knupp, "Algebraic mesh quality
/// metrics", 2001.
double condition(const TetGeometry& t);
/// 12 (3 V)^(2/3) / sum of squared edges, the mean ratio of the same map's singular values. After A. Liu, B.
/// Joe, "Relationship between tetrahedron shape measures", 1994, and Knupp.
double mean_ratio(const TetGeometry& t);
/// sqrt(2) 6 V over the largest product of the three edges at a vertex. After Knupp, as Verdict has it.
double scaled_jacobian(const TetGeometry& t);

// ---- size
// ---------------------------------------------------------------------------------------------------------
/// Lmax / wanted size. Equation (6): its text names the mean edge, but its tables are of the longest one.
/// Precondition: size > 0.
double phi(const TetGeometry& t, double size);

}  // namespace maille::quality
