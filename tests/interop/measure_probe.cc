#include <array>
#include <cstdio>

#include "quality/measures.hh"

// Reads tetrahedra on stdin, twelve doubles each, and writes their measures on stdout, in the order that
// tets.py names, for comparison with other programs.

int main() {
    using namespace maille::quality;
    std::array<double, 12> x;
    while (std::fread(x.data(), sizeof x, 1, stdin) == 1) {
        const TetGeometry t =
            tet_geometry({x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}, {x[9], x[10], x[11]});
        const std::array measures{volume(t),       beta(t),         sigma(t),           omega(t),
                                  tau(t),          kappa(t),        alpha(t),           gamma(t),
                                  dihedral_min(t), dihedral_max(t), solid_angle_min(t), solid_angle_max(t),
                                  aspect(t),       condition(t),    mean_ratio(t),      scaled_jacobian(t)};
        std::fwrite(measures.data(), sizeof measures, 1, stdout);
    }
}
